"""Chapter 10: speed and accuracy. Its results are measured; these few are worked out."""

import numpy as np
from support.worked_numbers import Says

from simulations.ladders.inverse_distortion import LADDER
from simulations.models import radial_profile

CHAPTER = "10-speed-and-accuracy"
GIVEN = "0.001 0.1 2.2 100 255"


def the_slope_of_the_fixed_point_s_map() -> Says:
    """How much one step leaves of an error: r g'(r) / g(r), at its worst over the workload."""
    work = LADDER.prepare()
    profile = work.lens.radial
    ideal = np.hypot(*np.moveaxis(LADDER.reference(work), -1, 0))
    scale, slope = radial_profile.scale_and_slope(profile, ideal**2)
    worst = float(np.abs(2 * ideal**2 * slope / scale).max())
    yield f"which for this lens is {worst:.2f} at worst"


def samples_of_a_box() -> Says:
    yield f"A box of 16 × 16 samples a pixel has {16**2} times the work"
    yield f"or about {16**2}?"


WORKED = (the_slope_of_the_fixed_point_s_map, samples_of_a_box)
