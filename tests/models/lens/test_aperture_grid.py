"""The rays of the camera's reference picture cover the lens evenly, from the first few on."""

import numpy as np
import pytest

from simulations.models.lens.aperture_grid import aperture_grid


@pytest.mark.parametrize("across", [1, 2, 3, 7, 20])
def test_each_point_of_the_grid_inside_the_disc_comes_once(across: int) -> None:
    points = aperture_grid(across)
    axis = np.arange(across) * 2.0 / across - (across - 1) / across
    inside = int((axis[:, None] ** 2 + axis**2 <= 1.0).sum())
    assert len(points) == len(set(points)) == inside


def test_any_beginning_is_balanced_about_the_centre() -> None:
    points = np.array(aperture_grid(7))
    for count in range(12, len(points) + 1):
        assert np.linalg.norm(points[:count].mean(axis=0)) < 0.2


@pytest.mark.parametrize("across", [2, 5, 8])
def test_the_points_are_the_centres_of_square_cells_and_x_comes_first(across: int) -> None:
    centres = (np.arange(across) + 0.5) * 2 / across - 1
    assert {round(x, 9) for point in aperture_grid(across) for x in point} <= {
        round(float(c), 9) for c in centres
    }
    first = aperture_grid(across)[0]  # the upper left of those inside: left of the centre, above
    assert first[1] == pytest.approx(centres[0])
    assert first[0] < 0
