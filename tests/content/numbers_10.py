"""Chapter 10: speed and accuracy. Its results are measured; these few are worked out."""

import numpy as np
from support.worked_numbers import Says

from simulations.ladders import inverse_pincushion
from simulations.ladders.inverse_distortion import LADDER
from simulations.models import radial_profile
from simulations.models.distortion import undistort

CHAPTER = "10-speed-and-accuracy"
GIVEN = "0.001 0.1 2.2 100 255"


def the_slope_of_the_fixed_point_s_map() -> Says:
    """How much one step leaves of an error: r g'(r) / g(r), at its worst over the workload."""
    work = LADDER.prepare()
    profile = work.lens.radial
    ideal = np.hypot(*np.moveaxis(undistort(work.seen, work.lens)[0], -1, 0))
    scale, slope = radial_profile.scale_and_slope(profile, ideal**2)
    worst = float(np.abs(2 * ideal**2 * slope / scale).max())
    yield f"which for this lens is {worst:.2f} at worst"


def a_corner_of_the_pincushion() -> Says:
    work = inverse_pincushion.LADDER.prepare()
    lens = work.lens
    corner, _ = undistort([2.0, 0.0], lens)
    yield f"$k_1 = {lens.k1:g}$, so that a corner which belongs at $r = {corner[0]:.2f}$ is drawn"
    assert np.isclose(np.hypot(*np.moveaxis(work.seen, -1, 0)).max(), 2.0, rtol=0.01)
    yield f"where $k_1r^2 = 1$, and the corner lies beyond, at {lens.k1 * corner[0] ** 2:.1f}"


def samples_of_a_box() -> Says:
    yield f"A box of 16 × 16 samples a pixel has {16**2} times the work"
    yield f"or about {16**2}?"


WORKED = (the_slope_of_the_fixed_point_s_map, a_corner_of_the_pincushion, samples_of_a_box)
