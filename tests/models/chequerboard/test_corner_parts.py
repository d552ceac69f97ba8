"""The parts of the search for a chequerboard, each alone."""

import numpy as np
import pytest

from simulations.models.chequerboard import corner_fit
from simulations.models.chequerboard.board import Board
from simulations.models.chequerboard.corner_fit import fit_corners
from simulations.models.chequerboard.find_board import numbered
from simulations.models.chequerboard.flatness import flat_residuals
from simulations.models.chequerboard.local_lattice import Lattice, lattice_of, predict
from simulations.models.chequerboard.quadratic_saddle import quadratic_saddle
from simulations.models.chequerboard.reduction import reduced
from simulations.models.chequerboard.saddle_points import find_saddles, sample, smoothed
from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.error_measures import root_mean_square
from simulations.models.geometry.transforms import apply_homography

H = np.array([[30.0, 4.0, 60.0], [-3.0, 26.0, 50.0], [4e-3, 6e-3, 1.0]])
INDICES = Board(9, 7).indices


def test_the_saddle_of_a_parabola_is_found_exactly() -> None:
    y, x = np.mgrid[:30, :40].astype(float)
    picture = 3.0 * (x - 17.3) * (y - 12.8) + (x - 17.3) ** 2 - 0.5 * (y - 12.8) ** 2
    found = quadratic_saddle(picture, np.array([[18.0, 12.0], [16.0, 14.0]]), 4)
    assert np.abs(found - [17.3, 12.8]).max() < 1e-9


@pytest.mark.parametrize(
    "picture", [np.zeros((20, 20)), np.add.outer(np.arange(20.0), np.ones(20))]
)
def test_flat_and_sloping_pictures_have_no_saddle(picture: np.ndarray) -> None:
    assert np.isnan(quadratic_saddle(picture, np.array([[10.0, 10.0]]), 3)).all()


def test_the_slopes_of_the_corner_model_are_those_of_its_value() -> None:
    y, x = np.mgrid[-5:6, -5:6].astype(float).reshape(2, 1, -1)
    state = np.array([[0.2, -0.3, 0.4, 1.7, 0.1]])

    def model(at: np.ndarray) -> corner_fit._Model:
        return corner_fit._model(x - at[:, :1], y - at[:, 1:2], at)

    for number in range(5):
        step = np.zeros(5)
        step[number] = 1e-3
        numeric = (model(state + step).value - model(state - step).value) / 2e-3
        assert np.abs(numeric - model(state).slopes[..., number]).max() < 1e-4


def test_no_corner_is_fitted_where_the_picture_is_blank() -> None:
    edges = np.array([[[1.0, 0.0], [0.0, 1.0]]])
    fit = fit_corners(np.full((30, 30), 90, np.uint8), np.array([[15.0, 15.0]]), edges, 5)
    assert np.isnan(fit.places).all() or fit.contrast[0] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("factor", [1, 2, 3])
def test_a_reduced_picture_has_the_means_of_the_luma(factor: int) -> None:
    codes = np.random.default_rng(0).integers(0, 256, (13, 20, 3), dtype=np.uint8)
    small = reduced(codes, factor)
    assert small.shape == (13 // factor, 20 // factor)
    block = codes[factor : 2 * factor, factor : 2 * factor] @ [0.299, 0.587, 0.114]
    assert small[1, 1] == pytest.approx(block.mean(), abs=1e-3)


def test_samples_lie_between_pixels_and_places_that_are_none_have_none() -> None:
    picture = np.arange(12, dtype=np.float32).reshape(3, 4)
    assert sample(picture, np.array([[1.5, 0.5], [2.0, 1.0]])) == pytest.approx([3.5, 6.0])
    assert np.isnan(sample(picture, np.array([[np.nan, 1.0]]))).all()


def test_a_corner_is_a_saddle_and_an_edge_and_a_t_are_none() -> None:
    y, x = np.mgrid[:40, :40] >= 20
    for picture, count in ((x ^ y, 1), (x, 0), (x & y, 0), (x & y | ~x, 0)):
        smooth = smoothed(100.0 * picture.astype(np.float32))
        assert len(find_saddles(smooth).places) == count


def test_neighbours_tell_a_corner_exactly_through_a_homography() -> None:
    truth, _ = apply_homography(H, INDICES)
    lattice = lattice_of(truth, INDICES.astype(int), light=False)
    seen = predict(lattice, np.argwhere(lattice.known))
    assert np.abs(seen.places - truth).max() < 0.1
    assert np.abs(seen.across[:-1] - np.diff(truth, axis=0))[INDICES[:-1, 0] < 7].max() < 2.0


def test_too_few_neighbours_tell_nothing() -> None:
    truth, _ = apply_homography(H, INDICES[:4])
    lattice = lattice_of(truth, INDICES[:4].astype(int), light=False)
    assert np.isnan(predict(lattice, np.argwhere(lattice.known)).places).all()


def test_a_plane_behind_a_lens_is_flat_and_a_bent_sheet_is_not() -> None:
    plane, _ = apply_homography(H, INDICES)
    middle = np.array([160.0, 120.0])
    seen = 300.0 * distort((plane - middle) / 300.0, Distortion(k1=-0.3, k2=0.1, p1=1e-3)) + middle
    assert root_mean_square(flat_residuals(seen, INDICES, middle)) < 0.01
    bent = seen + [0.0, 1.0] * np.sin(2.0 * INDICES[:, :1])
    assert root_mean_square(flat_residuals(bent, INDICES, middle)) > 0.3


@pytest.mark.parametrize("turns", range(4))
def test_a_grid_that_was_walked_from_any_side_is_numbered_alike(turns: int) -> None:
    """The dark square before corner (0, 0) is light, or behind it, in turned directions."""
    indices = Board(10, 7).indices
    truth, _ = apply_homography(H, indices)
    grid = np.full((8, 11, 2), np.nan)
    grid[1:7, 1:10] = truth.reshape(6, 9, 2)
    turned = np.rot90(grid, turns)
    corner = np.argwhere(np.isclose(turned[..., 0], truth[0, 0]))[0]
    light_there = turns % 2 == 1
    lattice = Lattice(turned, bool(light_there ^ (corner.sum() % 2 == 1)))
    places, numbers = numbered(lattice)
    assert np.abs(places - truth).max() < 1e-9
    assert np.array_equal(numbers, indices)
