"""The board, and each part of the search for it alone."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from scipy.stats import multivariate_normal, norm

from simulations.models.chequerboard import corner_fit
from simulations.models.chequerboard.blurred_corner import blurred_corner
from simulations.models.chequerboard.board import Board, board_svg
from simulations.models.chequerboard.board_search import reduced
from simulations.models.chequerboard.find_board import flat_residuals, numbered
from simulations.models.chequerboard.local_lattice import Lattice, lattice_of, predict
from simulations.models.chequerboard.quadratic_saddle import quadratic_saddle
from simulations.models.chequerboard.saddle_points import find_saddles, smoothed
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


@pytest.mark.parametrize("factor", [1, 2, 3])
def test_a_reduced_picture_has_the_means_of_the_luma(factor: int) -> None:
    codes = np.random.default_rng(0).integers(0, 256, (13, 20, 3), dtype=np.uint8)
    small = reduced(codes, factor)
    assert small.shape == (13 // factor, 20 // factor)
    block = codes[factor : 2 * factor, factor : 2 * factor] @ [0.299, 0.587, 0.114]
    assert small[1, 1] == pytest.approx(block.mean(), abs=1e-3)


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


@pytest.mark.parametrize("correlation", [0.0, 0.3, -0.7, 0.9])
def test_it_is_the_mean_of_the_product_of_two_signs(correlation: float) -> None:
    h, k = np.random.default_rng(0).normal(0.0, 1.5, (2, 40))
    law = multivariate_normal([0, 0], [[1, correlation], [correlation, 1]])
    both = np.array([law.cdf(pair) for pair in zip(h, k, strict=True)])
    oracle = 4 * both - 2 * norm.cdf(h) - 2 * norm.cdf(k) + 1
    assert np.abs(blurred_corner(h, k, correlation) - oracle).max() < 1e-6


def test_corners_are_inside_the_squares_and_count_row_by_row() -> None:
    board = Board(10, 7, 25.0)
    assert board.corners == (9, 6)
    assert board.points_mm[[0, 1, 9, -1]].tolist() == [
        [0, 0, 0],
        [25, 0, 0],
        [0, 25, 0],
        [200, 125, 0],
    ]
    assert np.array_equal(board.indices[9], [0, 1])


def test_the_drawing_is_at_true_scale_with_every_dark_square_and_a_ruler() -> None:
    board = Board(10, 7, 24.5)
    root = ET.fromstring(board_svg(board, "10 x 7 squares"))
    width = float(root.attrib["width"].removesuffix("mm"))
    assert root.attrib["viewBox"] == f"0 0 {width:g} {root.attrib['height'].removesuffix('mm')}"
    assert width == pytest.approx(12 * 24.5)
    squares, ruler = (path.attrib["d"] for path in root.iter("{http://www.w3.org/2000/svg}path"))
    assert squares.count("M") == 35
    assert set(re.findall("[hv](-?[0-9.]+)", squares)) == {"24.5", "-24.5"}
    assert re.search("h100(?![0-9])", ruler)


@pytest.mark.parametrize("sizes", [(2, 7, 25.0), (10, 0, 25.0), (10, 7, 0.0)])
def test_boards_without_corners_are_refused(sizes: tuple[int, int, float]) -> None:
    with pytest.raises(ValueError, match="legal"):
        Board(*sizes)
