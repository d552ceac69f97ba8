"""Coverage of a pixel by an edge, and shading blended across cells."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import RegularGridInterpolator

from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import clip_half_plane
from simulations.models.light.cell_blending import blend_cells, blend_normals
from simulations.models.light.edge_coverage import (
    chord_length,
    curved_edge_coverage,
    straight_edge_coverage,
)

ANGLES = st.floats(0, 2 * np.pi)
PIXEL = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])


def normal_at(angle: float) -> Floats:
    return np.array([np.cos(angle), np.sin(angle)])


def area(polygon: Floats) -> float:
    x, y = polygon.T
    return abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2 if len(x) else 0.0


@given(ANGLES, st.floats(-1, 1))
def test_straight_edge_covers_the_area_of_the_clipped_pixel(angle: float, distance: float) -> None:
    n = normal_at(angle)
    inside = clip_half_plane(PIXEL, [n[0], n[1], distance])
    assert straight_edge_coverage(distance, n) == pytest.approx(area(inside), abs=1e-12)


@given(ANGLES, st.floats(-0.7, 0.7))
def test_chord_length_is_the_derivative_of_the_coverage(angle: float, distance: float) -> None:
    n, step = normal_at(angle), 1e-6
    rise = straight_edge_coverage(distance + step, n) - straight_edge_coverage(distance - step, n)
    corners = (abs(n[0]) + abs(n[1])) / 2, abs(abs(n[0]) - abs(n[1])) / 2
    if min(abs(abs(distance) - corner) for corner in corners) > 1e-4:
        assert chord_length(distance, n) == pytest.approx(rise / (2 * step), abs=1e-4)


@pytest.mark.parametrize(
    ("angle", "offset"),
    [(np.pi / 2, 0.3), (np.pi / 2, 0.0), (1.2, 0.0), (2.2, 0.0), (np.pi / 4, -0.2)],
)
def test_curved_edge_covers_the_sum_of_its_columns(angle: float, offset: float) -> None:
    """Where the foot of the normal bisects the chord, the neglected term is of order κ³."""
    radius, n = 200.0, normal_at(angle)
    x_centre, y_centre = -n * (radius - offset)
    x = (np.arange(20_000) + 0.5) / 20_000 - 0.5
    top = y_centre + np.sqrt(radius**2 - (x - x_centre) ** 2)
    exact = np.mean(np.clip(top, -0.5, 0.5) + 0.5)
    bulge = float(chord_length(offset, n)) ** 3 / 24 / radius
    curved = curved_edge_coverage(offset, n, 1 / radius)
    assert curved == pytest.approx(exact, abs=0.02 * bulge)
    assert curved == curved_edge_coverage(offset, n[::-1], 1 / radius)


sizes = st.integers(2, 9)


def grid(rows: int, columns: int, channels: int = 3) -> Floats:
    return np.random.default_rng(rows * 100 + columns).standard_normal((rows, columns, channels))


@given(sizes, sizes, sizes, sizes)
def test_blended_cells_agree_with_scipys_linear_interpolation(
    rows: int, columns: int, height: int, width: int
) -> None:
    corners = grid(rows, columns)
    axes = np.arange(rows), np.arange(columns)
    y, x = np.linspace(0, rows - 1, height), np.linspace(0, columns - 1, width)
    oracle = RegularGridInterpolator(axes, corners)(np.stack(np.meshgrid(y, x, indexing="ij"), -1))
    np.testing.assert_allclose(blend_cells(corners, height, width), oracle, atol=1e-12)


def test_blended_normals_have_unit_length_and_bisect_angles() -> None:
    tilt = np.radians(40)
    corners = np.array([[[0, 0, 1.0], [np.sin(tilt), 0, np.cos(tilt)]]] * 2)
    blended = blend_normals(corners, 2, 5)
    np.testing.assert_allclose(np.linalg.norm(blended, axis=-1), 1, atol=1e-15)
    np.testing.assert_allclose(blended[0, 2], [np.sin(tilt / 2), 0, np.cos(tilt / 2)], atol=1e-15)
    np.testing.assert_allclose(blended[:, [0, -1]], corners, atol=1e-15)
