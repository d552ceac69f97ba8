"""The file of the board to print."""

import xml.etree.ElementTree as ET

from simulations.scenes.chequerboard import SCENE


def test_the_file_has_the_squares_of_the_settings_in_millimetres() -> None:
    (export,) = SCENE.exports
    drawn = ET.fromstring(export.make(SCENE.check({"side": 20, "across": 5, "down": 4}), {}))
    assert drawn.get("width") == "140mm"
    squares = next(path for path in drawn if path.get("fill") == "#000")
    assert (squares.get("d") or "").count("z") == 10
