"""What the calibration keeps of the reader's photographs."""

import json

import numpy as np
import pytest
from support.boards import facing_board

from simulations.engine.photograph import Photograph
from simulations.engine.reading import UnfitError
from simulations.models.chequerboard.board import Board
from simulations.pictures.chequerboard import Look, photograph_of, true_corners
from simulations.scenes.calibration.reading import read

BOARD = Board(8, 6, 25.0)
VIEW = facing_board(BOARD, 480, 360, focal_px=420.0, tilt=(0.2, -0.3, 0.1), distance_mm=330.0)


def test_corners_their_numbers_and_the_facts_of_the_file_are_kept_as_json() -> None:
    grey = photograph_of(BOARD, VIEW, Look(noise_codes=1.0))
    facts: dict[str, float | str] = {"focal_mm": 4.2, "model": "Box", "full_width": 480.0}
    photograph = Photograph(7, np.repeat(grey[..., None], 3, axis=2), "a.jpg", facts)
    kept = json.loads(json.dumps(read(photograph)))
    assert (kept["width"], kept["height"], kept["columns"], kept["rows"]) == (480, 360, 7, 5)
    assert kept["facts"] == facts
    place = {
        tuple(index): corner for index, corner in zip(kept["indices"], kept["corners"], strict=True)
    }
    ours = np.array([place[column, row] for column, row in BOARD.indices.astype(int).tolist()])
    turned = ours[::-1]  # its ends are alike
    truth = true_corners(BOARD, VIEW)
    assert min(np.abs(found - truth).max() for found in (ours, turned)) < 0.05


def test_a_photograph_without_a_board_is_refused_in_a_sentence() -> None:
    with pytest.raises(UnfitError, match=r"^No chequerboard found; .*\.$"):
        read(Photograph(1, np.full((40, 30, 3), 200, np.uint8)))
