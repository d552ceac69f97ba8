"""The cells of a lens's table: where they begin and end, and that they lie where they say."""

import math

import numpy as np
import pytest

from simulations.models.distortion.radial_grid import Grid, cell_of, grid_for, image_squared_at
from simulations.models.distortion.radial_profile import RadialProfile, largest_image_radius

BARREL, PINCUSHION, HARDLY = (RadialProfile((k,)) for k in (-1 / 3, 1 / 3, 1e-6))
"""The first folds at f² = 4/9, the inverse of the second bends most at −4/9, the third nowhere."""
CASES = [(BARREL, 1.0), (BARREL, 0.25), (PINCUSHION, 1.0), (PINCUSHION, 64.0), (HARDLY, 2.0)]


def grid_of(profile: RadialProfile, reach: float, cells: int = 256) -> Grid:
    return grid_for(profile, largest_image_radius(profile), reach, cells)


@pytest.mark.parametrize(("reach", "last"), [(1.0, 4 / 9), (0.25, 0.25), (4 / 9, 4 / 9)])
def test_before_a_fold_the_cells_run_inwards_from_it_or_from_the_reach_to_the_axis(
    reach: float, last: float
) -> None:
    ends = image_squared_at(grid_of(BARREL, reach), np.array([0.0, 256.0]))
    np.testing.assert_allclose(ends, [last, 0.0], atol=1e-15)


@pytest.mark.parametrize(("profile", "reach"), CASES[2:])
def test_without_a_fold_the_cells_run_outwards_from_the_axis_to_the_reach(
    profile: RadialProfile, reach: float
) -> None:
    ends = image_squared_at(grid_of(profile, reach), np.array([0.0, 256.0]))
    np.testing.assert_allclose(ends, [0.0, reach], rtol=1e-13, atol=1e-14)


@pytest.mark.parametrize(("profile", "reach"), CASES)
@pytest.mark.parametrize("cells", [1, 256])
def test_each_place_is_found_in_its_cell(profile: RadialProfile, reach: float, cells: int) -> None:
    grid = grid_of(profile, reach, cells)
    places = np.linspace(0.0, cells, 1001)
    np.testing.assert_allclose(cell_of(grid, image_squared_at(grid, places)), places, atol=1e-10)


@pytest.mark.parametrize(("limit", "folds"), [(15.99, True), (16.0, False), (math.inf, False)])
def test_a_fold_counts_if_its_squared_image_is_less_than_64_times_the_reach(
    limit: float, folds: bool
) -> None:
    assert grid_for(HARDLY, limit, 4.0, 256).folds is folds
