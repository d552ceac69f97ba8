"""Chapter 10: speed and accuracy. Its results are measured; a few are worked out."""

import numpy as np
from support.worked_numbers import CONTENT, Says

from simulations.engine.ladder import pareto_front
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
from site_builder.benchmarks.measurements import Measurements, read_measurements
from site_builder.files.text import Sources

CHAPTER = "10-speed-and-accuracy"


def measurements() -> Measurements:
    return read_measurements(Sources(CONTENT.parent))


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


def a_corner_of_the_pincushion() -> Says:
    work = inverse_strong.prepare()[inverse_strong.PINCUSHION]
    lens = work.lens
    corner, _ = undistort([2.0, 0.0], lens)
    yield f"with $k_1 = {lens.k1:g}$ a corner that belongs at $r = {corner[0]:.2f}$ is drawn"
    assert np.isclose(np.hypot(*np.moveaxis(work.seen, -1, 0)).max(), 2.0, rtol=0.01)
    there = lens.k1 * corner[0] ** 2
    yield f"where $k_1r^2 = 1$, and the pincushion's corner lies beyond, at {there:.1f}"


def how_near_the_fold_the_barrel_is_seen() -> Says:
    work = inverse_strong.prepare()[inverse_strong.BARREL]
    share = np.hypot(*work.seen.T).max() / largest_distorted_radius(work.lens)
    yield f"to {100 * share:.1f} % of the largest distorted radius there is"


def samples_of_a_box() -> Says:
    yield f"A box of 16 × 16 samples a pixel has {16**2} times the work"
    yield f"every pixel of a blurred layer is a sum of {round(np.pi * 24**2, -2):.0f} terms"
    yield f"For a figure of 320 × 240 pixels that is {round(33e6 / (320 * 240), -1):.0f} ns"


def a_front_of_four() -> Says:
    """The four methods of the first question."""
    times, errors = (2.0, 3.0, 9.0, 12.0), (0.1, 0.1, 0.001, 0.002)
    front = pareto_front(list(zip(times, errors, strict=True)))
    told = [
        f"{name} takes {time:g} ms and errs by {error:g} px"
        for name, time, error in zip("ABCD", times, errors, strict=True)
    ]
    yield f"Method {', '.join(told)}."
    yield " and ".join(name for name, on in zip("ABCD", front, strict=True) if on) + ", for nothing"
    assert pareto_front([(1.0, 1.0), (1.0, 1.0)]) == (True, True)
    yield "at least as quick and at least as accurate, and better in one of the two"


def what_the_opening_says() -> Says:
    tiers = measurements().find("inverse-distortion").tiers
    assert len(tiers) >= 9
    yield "at least nine ways"
    times = {item.tier.id: item.times["browser"].ms for item in tiers}
    assert min(times, key=times.__getitem__) == "first-order"
    yield "The quickest puts a corner"
    worst = measurements().find("inverse-distortion")["newton-bracketed"].errors["worst"]
    assert worst is not None
    assert worst < 1e-9
    yield "The most careful is right to the last rounding"


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
