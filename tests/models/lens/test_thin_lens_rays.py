"""Rays traced through a thin lens, one by one: where they meet, and what a sensor there sees.

All that a thin lens does to a ray is to change its slope by height / f. Nothing here asks where
the image lies: the sensor is put where traced rays of the point in focus cross.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simulations.models.arrays import Floats
from simulations.models.lens.thin_lens import (
    circle_of_confusion_mm,
    principal_distance_mm,
    working_f_number,
)
from simulations.models.projection.pinhole import intrinsics, project

ACROSS = np.linspace(-1.0, 1.0, 11)
"""Where rays pass the opening, in radii; the middle one is the chief ray."""

FOCAL_MM = st.floats(8.0, 400.0)
F_NUMBER = st.floats(0.8, 32.0)
FOCUS = st.floats(1.2, 2000.0)
"""In focal lengths."""
DEPTH = st.floats(1.1, 5000.0)
SIDEWAYS = st.floats(-0.8, 0.8)
"""Of the depth."""


def behind_lens(x_mm: float, depth_mm: float, heights_mm: Floats, focal_mm: float) -> Floats:
    """Slopes behind the lens of the rays from a point to these heights on the lens."""
    return (heights_mm - x_mm) / depth_mm - heights_mm / focal_mm


def crossing_mm(focal_mm: float, focus_mm: float) -> float:
    """Distance behind the lens at which two rays of a point on the axis meet."""
    up, down = behind_lens(0.0, focus_mm, np.array([1.0, -1.0]), focal_mm)
    return 2.0 / (down - up)


def seen_by_sensor(
    focal_mm: float, f_number: float, focus_mm: float, depth_mm: float, x_mm: float
) -> tuple[Floats, float]:
    """Where rays of one point meet the sensor, turned about the axis so that it is upright."""
    heights = ACROSS * focal_mm / f_number / 2
    sensor = crossing_mm(focal_mm, focus_mm)
    return -(heights + sensor * behind_lens(x_mm, depth_mm, heights, focal_mm)), sensor


@settings(deadline=None, max_examples=300)
@given(FOCAL_MM, F_NUMBER, FOCUS, DEPTH, SIDEWAYS)
def test_a_point_is_seen_where_projection_with_the_sensor_s_distance_puts_it(
    focal: float, f_number: float, focus: float, depth: float, aside: float
) -> None:
    focus, depth = focus * focal, depth * focal
    hits, sensor = seen_by_sensor(focal, f_number, focus, depth, aside * depth)
    z = principal_distance_mm(focal, focus)
    assert z == pytest.approx(sensor, rel=1e-9)
    (x, _), _ = project([aside * depth, 0.0, depth], intrinsics(z, (0.0, 0.0)))
    blur = float(circle_of_confusion_mm(focal, f_number, focus, depth))
    assert hits[len(hits) // 2] == pytest.approx(x, abs=1e-9 * z)
    assert hits.mean() == pytest.approx(x, abs=1e-9 * (z + blur))
    assert np.ptp(hits) == pytest.approx(blur, abs=1e-9 * (z + blur))


@pytest.mark.parametrize(("focal", "focus"), [(50.0, 3200.0), (135.0, 1000.0), (60.0, 120.0)])
@pytest.mark.parametrize("f_number", [1.4, 8.0])
def test_the_light_of_a_wide_scene_falls_with_the_square_of_the_working_f_number(
    focal: float, f_number: float, focus: float
) -> None:
    """A pixel on the axis gathers the share of directions in which it sees the opening."""
    sensor = crossing_mm(focal, focus)
    at_infinity, focused = (
        _light_through_opening(focal / f_number / 2, distance) for distance in (focal, sensor)
    )
    marked, working = f_number, working_f_number(focal, f_number, focus)
    assert working == pytest.approx(f_number * sensor / focal, rel=1e-12)
    # The square holds for small openings; at f/1.4 a twentieth is lost to their slant.
    slant = 1 + (0.5 / f_number) ** 2
    assert focused / at_infinity == pytest.approx((marked / working) ** 2, rel=slant - 1)


def _light_through_opening(radius_mm: float, distance_mm: float) -> float:
    """Irradiance on the axis per radiance: cos⁴ over distance², summed over rings of the opening.

    The cosines of both ends of each ray, and the longer way of slanted ones, are in it.
    """
    edges = np.linspace(0.0, radius_mm, 2001)
    middle = (edges[1:] + edges[:-1]) / 2
    areas = np.pi * np.diff(edges**2)
    return float(np.sum(areas * distance_mm**2 / (distance_mm**2 + middle**2) ** 2))
