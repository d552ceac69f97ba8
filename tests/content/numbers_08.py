"""Chapter 8: the whole camera."""

from math import inf, isclose, pi

from numpy import arange, interp
from scipy.special import j1
from support.worked_numbers import Phrases

from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.lens.thin_lens import circle_of_confusion_mm, principal_distance_mm
from simulations.scenes.depth_of_field.stages import sharpness
from simulations.world.still_life import OBJECTS, WALL_DISTANCE, object_depth
from simulations.world.still_life_camera import COLUMNS, ROWS, bend_rays, sensor_rays

CHAPTER = "08-full-camera-model"
PIXEL_MM = 36 / 264


ASIDE = 0.30 / 1.90
"""Tangent to the optical axis of the point that the text follows."""
LENS = Distortion(k1=-0.2)


def the_same_place_in_the_simulator() -> Phrases:
    """The simulator's ray through the text's pixel points at the text's point."""
    sensor = principal_distance_mm(50, 3200)
    column = (COLUMNS - 1) / 2 + sensor / PIXEL_MM * float(distort([ASIDE, 0], LENS)[0])
    rays = bend_rays(sensor_rays(50.0, 3.2), LENS.k1).directions
    row = (rays[ROWS // 2 - 1] + rays[ROWS // 2]) / 2
    assert isclose(float(interp(column, arange(COLUMNS), row[:, 0])), ASIDE, rel_tol=1e-4)
    yield "This is the principal distance"


def contrast_of_the_finest_stripes_under_a_disc() -> Phrases:
    near = float(circle_of_confusion_mm(50, 5.6, 3200, 1850)) / PIXEL_MM
    nyquist = pi * near * 0.5
    yield f"takes away {100 * (1 - 2 * j1(nyquist) / nyquist):.0f} %"


def how_far_the_lens_must_be_stopped_down() -> Phrases:
    def sharp_from_2_m_on(aperture: float) -> bool:
        at = (sharpness(50, aperture, focus) for focus in arange(3, 6, 0.05))
        return any(one.near_limit_m <= 2 and one.far_limit_m == inf for one in at)

    assert not sharp_from_2_m_on(4.6)
    assert sharp_from_2_m_on(4.7)
    yield "stopped down to f/4.7 at least"


def the_still_life() -> Phrases:
    depths = [object_depth(thing) for thing in OBJECTS]
    assert len(depths) == 6
    assert 1.8 < min(depths) < 2
    assert round(max(depths), 1) == 6.5
    yield "Six things stand on a chequered floor, from under two metres to six and a half"
    yield f"a test chart hangs on the wall at {'eight' if WALL_DISTANCE == 8 else WALL_DISTANCE}"


def softening_of_the_striped_ball() -> Phrases:
    ball = object_depth(next(thing for thing in OBJECTS if thing.name == "striped ball"))
    yield f"The striped ball, {ball:.1f} m away, gets softer"
    near, far = (
        float(circle_of_confusion_mm(135, 22, focus, 1000 * ball)) / PIXEL_MM
        for focus in (1000, 10_000)
    )
    assert near > 3 * far
