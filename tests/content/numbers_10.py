"""Chapter 10: speed and accuracy. Its results are measured; a few are worked out."""

import numpy as np
from support.worked_numbers import Says

from simulations.ladders import depth_of_field, inverse_strong, wide_discs
from simulations.ladders.depth_of_field import radius_px
from simulations.ladders.inverse_distortion import LADDER
from simulations.models.distortion import radial_profile, radial_table
from simulations.models.distortion.lens_model import (
    largest_distorted_radius,
    undistort,
)
from simulations.models.light.raycasting import Sphere
from simulations.pictures.still_life.things import THINGS, thing_depth
from simulations.scenes._still_life_camera import PITCH_MM
from simulations.scenes.camera import scene as camera

CHAPTER = "10-speed-and-accuracy"


def the_slope_of_the_fixed_point_s_map() -> Says:
    """How much one step leaves of an error: r g'(r) / g(r), at its worst over the workload."""
    work = LADDER.prepare()
    profile = work.lens.radial
    ideal = np.hypot(*np.moveaxis(undistort(work.seen, work.lens)[0], -1, 0))
    scale, slope = radial_profile.scale_and_slope(profile, ideal**2)
    worst = float(np.abs(2 * ideal**2 * slope / scale).max())
    yield f"which for this lens is {worst:.2f} at worst"


def the_places_of_a_checked_table() -> Says:
    work = LADDER.prepare()
    table = radial_table.inverse_table(work.lens.radial, 1.0)
    yield f"lays short polynomials through {table.coefficients.size} places"


def how_near_the_fold_the_barrel_is_seen() -> Says:
    work = inverse_strong.prepare()[inverse_strong.BARREL]
    share = np.hypot(*work.seen.T).max() / largest_distorted_radius(work.lens)
    yield f"to {100 * share:.1f} % of the largest distorted radius there is"


def how_round_the_outlines_of_the_book_are() -> Says:
    """The smallest ball, through the widest lens, focused at infinity."""
    balls = [(it.solid, thing_depth(it)) for it in THINGS if isinstance(it.solid, Sphere)]
    widest = camera.SCENE.clamp({"focal_length": 0}).focal_length
    focal_px = widest / PITCH_MM
    smallest = min(focal_px * ball.radius / depth for ball, depth in balls)
    yield f"with radii of {int(smallest)} pixels or more"


def what_is_said_of_wide_discs() -> Says:
    near, wall = (2 * float(radius_px(wide_discs.prepare(), z)) for z in (1.6, 8.0))
    assert near > wall
    narrow = 2 * float(radius_px(depth_of_field.prepare(), 1.6))
    yield f"until they are {near:.0f} pixels wide"
    yield f"Such a disc covers {round(np.pi * near**2 / 4, -2):.0f} pixels"
    assert round(near / narrow) == 6
    wide, before = wide_discs.prepare(), depth_of_field.prepare()
    assert round(wide.lens_radius / before.lens_radius) == 3
    assert wide.seen.shape == (2 * before.seen.shape[0], 2 * before.seen.shape[1])
    yield "a lens three times as wide, on twice as many pixels each way"
