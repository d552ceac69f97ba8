"""The board to print: the paper that it takes, and the file."""

import xml.etree.ElementTree as ET

import pytest
from support.frames import frame_of, texts_of

from simulations.engine.stages import StageCache
from simulations.scenes.chequerboard.scene import SCENE


@pytest.mark.parametrize(
    ("side", "across", "down", "paper"),
    [(20, 10, 7, "A4"), (25, 10, 7, "A3"), (26, 10, 7, "A3"), (60, 16, 12, "larger than A1")],
)
def test_the_board_comes_on_the_smallest_paper_with_room_for_it(
    side: int, across: int, down: int, paper: str
) -> None:
    shown = texts_of(frame_of(SCENE, side=side, across=across, down=down))
    assert shown["paper"] == paper
    assert shown["corners"] == f"{across - 1} × {down - 1}"


def test_the_file_has_the_squares_of_the_settings_in_millimetres() -> None:
    settings = SCENE.check({"side": 20, "across": 5, "down": 4})
    outputs = SCENE.run(settings, "", StageCache()).outputs
    (export,) = SCENE.exports
    drawn = ET.fromstring(export.make(settings, outputs))
    assert drawn.get("width") == "140mm"
    squares = next(path for path in drawn if path.get("fill") == "#000")
    assert (squares.get("d") or "").count("z") == 10
