"""The chequerboard: its corners, and its drawing at true scale."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from simulations.models.chequerboard.board import Board, board_svg


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


def test_the_ruler_is_no_longer_than_a_small_board() -> None:
    assert (Board(4, 3, 8.0).ruler_mm, Board(10, 7, 25.0).ruler_mm) == (30, 100)
    assert "h30M" in board_svg(Board(4, 3, 8.0))


@pytest.mark.parametrize("sizes", [(2, 7, 25.0), (10, 0, 25.0), (10, 7, 0.0)])
def test_boards_without_corners_are_refused(sizes: tuple[int, int, float]) -> None:
    with pytest.raises(ValueError, match="legal"):
        Board(*sizes)
