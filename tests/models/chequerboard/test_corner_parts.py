"""The board, and each part of the search for its corners."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from scipy.stats import multivariate_normal, norm

from simulations.models.chequerboard import corner_fit
from simulations.models.chequerboard.blurred_corner import blurred_corner
from simulations.models.chequerboard.board import Board, board_svg
from simulations.models.chequerboard.saddle_points import find_saddles, smoothed


def test_derivatives_of_the_corner_model_agree_with_differences() -> None:
    y, x = np.mgrid[-5:6, -5:6].astype(float).reshape(2, 1, -1)
    state = np.array([[0.2, -0.3, 0.4, 1.7, 0.1]])

    def model(at: np.ndarray) -> corner_fit._Model:
        return corner_fit._model(x - at[:, :1], y - at[:, 1:2], at)

    for number in range(5):
        step = np.zeros(5)
        step[number] = 1e-3
        numeric = (model(state + step).value - model(state - step).value) / 2e-3
        assert np.abs(numeric - model(state).slopes[..., number]).max() < 1e-4


def test_corner_is_a_saddle_point_but_an_edge_and_a_t_are_not() -> None:
    y, x = np.mgrid[:40, :40] >= 20
    for picture, count in ((x ^ y, 1), (x, 0), (x & y, 0), (x & y | ~x, 0)):
        smooth = smoothed(100.0 * picture.astype(np.float32))
        assert len(find_saddles(smooth).places) == count


@pytest.mark.parametrize("correlation", [0.0, 0.3, -0.7, 0.9])
def test_blurred_corner_is_the_mean_product_of_two_signs(correlation: float) -> None:
    h, k = np.random.default_rng(0).normal(0.0, 1.5, (2, 40))
    law = multivariate_normal([0, 0], [[1, correlation], [correlation, 1]])
    both = np.array([law.cdf(pair) for pair in zip(h, k, strict=True)])
    oracle = 4 * both - 2 * norm.cdf(h) - 2 * norm.cdf(k) + 1
    assert np.abs(blurred_corner(h, k, correlation) - oracle).max() < 1e-6


def test_inner_corners_are_numbered_row_by_row() -> None:
    board = Board(10, 7, 25.0)
    assert board.corners == (9, 6)
    some = board.points_mm[[0, 1, 9, -1]]
    assert some.tolist() == [[0, 0, 0], [25, 0, 0], [0, 25, 0], [200, 125, 0]]
    assert np.array_equal(board.indices[9], [0, 1])


def test_board_is_drawn_to_scale_with_every_dark_square_and_a_ruler() -> None:
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
