"""Projective maps, cameras, lines and planes do not change when multiplied by a nonzero number."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from simulations.models.arrays import Floats, Mask
from simulations.models.geometry import homography_algebra, lines_and_planes
from simulations.models.geometry.preserved_properties import measure_preservation
from simulations.models.geometry.transforms import apply_homography, clip_to_visible
from simulations.models.projection import pinhole

factors = st.sampled_from([-1.0, -3e-200, 7e-9, -0.3, 2.0, -1e12, 1e100])
entries = st.floats(-2, 2).map(lambda value: round(value, 3))
RNG = np.random.default_rng(12)
POINTS = RNG.uniform(-3, 3, (60, 2))
SPACE = RNG.uniform(-3, 3, (60, 3))
SQUARE = np.array([(-2.0, -1.0), (2.0, -1.0), (2.0, 1.0), (-2.0, 1.0)])
P = pinhole.camera_matrix(
    pinhole.intrinsics(500.0, (320.0, 240.0)),
    pinhole.look_at((0.5, 1.0, -4.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
)


def assert_agree(found: tuple[Floats, Mask], expected: tuple[Floats, Mask]) -> None:
    (values, valid), (other_values, other_valid) = found, expected
    np.testing.assert_array_equal(valid, other_valid)
    np.testing.assert_allclose(values, other_values, rtol=1e-9, atol=1e-12)


@given(st.lists(entries, min_size=9, max_size=9), factors)
def test_scaled_homography_maps_points_alike(h: list[float], factor: float) -> None:
    H = np.reshape(h, (3, 3))
    assert_agree(apply_homography(factor * H, POINTS), apply_homography(H, POINTS))


@given(st.lists(entries, min_size=9, max_size=9), factors)
def test_scaled_homography_clips_and_changes_figures_alike(h: list[float], factor: float) -> None:
    H = np.reshape(h, (3, 3)) + 3.0 * np.eye(3)
    kept = clip_to_visible(H, SQUARE)
    np.testing.assert_allclose(clip_to_visible(factor * H, SQUARE), kept, rtol=1e-9, atol=1e-12)
    sides = np.stack((SQUARE, np.roll(SQUARE, -1, axis=0)), axis=1)
    assume(homography_algebra.condition_number(H) < 1e6 and len(kept) == 4)
    found, expected = (measure_preservation(c * H, sides) for c in (factor, 1.0))
    for name in found.__slots__:
        assert getattr(found, name) == pytest.approx(getattr(expected, name), abs=1e-9)


@given(factors)
def test_scaled_camera_projects_alike(factor: float) -> None:
    points = np.column_stack((RNG.uniform(-9, 9, (60, 3)), RNG.choice([0.0, 1.0, -2.0], 60)))
    expected = pinhole.project_homogeneous(points, P)
    assert 0.2 < expected[1].mean() < 0.9
    assert_agree(pinhole.project_homogeneous(points, factor * P), expected)


@given(factors, factors)
def test_scaled_lines_and_planes_intersect_alike(factor: float, other: float) -> None:
    line, second = np.array([0.6, -2.0, 0.5]), np.array([1.0, 1.0, 3.0])
    assert_agree(
        lines_and_planes.intersection(factor * line, other * second),
        lines_and_planes.intersection(line, second),
    )
    for points, flat in ((POINTS, line), (SPACE, np.array([0.3, 1.0, -2.0, 0.7]))):
        found = lines_and_planes.signed_distance(points, factor * flat)
        expected = np.sign(factor) * lines_and_planes.signed_distance(points, flat)
        np.testing.assert_allclose(found, expected, rtol=1e-12)
