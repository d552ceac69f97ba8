"""Blending across cells is linear, exact at corners, and errs with the square of the cell."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import RegularGridInterpolator

from simulations.models.arrays import Floats
from simulations.models.light.cell_blending import blend_cells, blend_normals

sizes = st.integers(2, 9)


def grid(rows: int, columns: int, channels: int = 3) -> Floats:
    return np.random.default_rng(rows * 100 + columns).standard_normal((rows, columns, channels))


@given(sizes, sizes, sizes, sizes)
def test_it_is_scipys_linear_interpolation_between_corners(
    rows: int, columns: int, height: int, width: int
) -> None:
    corners = grid(rows, columns)
    axes = np.arange(rows), np.arange(columns)
    y, x = np.linspace(0, rows - 1, height), np.linspace(0, columns - 1, width)
    oracle = RegularGridInterpolator(axes, corners)(np.stack(np.meshgrid(y, x, indexing="ij"), -1))
    np.testing.assert_allclose(blend_cells(corners, height, width), oracle, atol=1e-12)


@pytest.mark.parametrize("trailing", [(), (1,), (2, 3)])
def test_whatever_stands_at_a_corner_is_blended_entry_by_entry(trailing: tuple[int, ...]) -> None:
    corners = grid(3, 4, int(np.prod(trailing))).reshape(3, 4, *trailing)
    blended = blend_cells(corners, 5, 7)
    assert blended.shape == (5, 7, *trailing)
    # Halfway between two rows of corners, on a column of them.
    np.testing.assert_allclose(blended[1, 2], (corners[0, 1] + corners[1, 1]) / 2, atol=1e-15)


def test_blended_normals_have_length_one_and_halve_the_angle_between_two() -> None:
    tilt = np.radians(40)
    corners = np.array([[[0, 0, 1.0], [np.sin(tilt), 0, np.cos(tilt)]]] * 2)
    blended = blend_normals(corners, 2, 5)
    np.testing.assert_allclose(np.linalg.norm(blended, axis=-1), 1, atol=1e-15)
    np.testing.assert_allclose(blended[0, 2], [np.sin(tilt / 2), 0, np.cos(tilt / 2)], atol=1e-15)
    np.testing.assert_allclose(blended[:, [0, -1]], corners, atol=1e-15)


@pytest.mark.parametrize("wild", [np.inf, np.nan, 1e308])
def test_a_wild_corner_stays_in_its_own_cells(wild: float) -> None:
    corners = np.ones((3, 3))
    corners[0, 0] = wild
    corners[0, 1] = -1e308
    picture = blend_cells(corners, 5, 5)
    np.testing.assert_array_equal(picture[2:, :], 1.0)
