"""Handles of the Bayer figure: the dividing line, the loupe, and the picture under it."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes._wipe.wipe import wipe_handle
from simulations.scenes.bayer_demosaic.drawing import CELL, HEIGHT, PIXEL, WIDTH
from simulations.scenes.bayer_demosaic.settings import COLUMNS, ROWS, Settings


def _loupe(settings: Settings, _outputs: Outputs) -> Point:
    return ((settings.column + COLUMNS / 2) * PIXEL, (settings.row + ROWS / 2) * PIXEL)


def _loupe_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"column": place[0] / PIXEL - COLUMNS / 2, "row": place[1] / PIXEL - ROWS / 2}


def _enlarged(settings: Settings, _outputs: Outputs) -> Point:
    """Place of the picture's first pixel in the enlargement."""
    return (-settings.column * CELL, -settings.row * CELL)


def _enlarged_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"column": -place[0] / CELL, "row": -place[1] / CELL}


HANDLES: tuple[Handle[Settings], ...] = (
    wipe_handle("picture", "split", WIDTH, HEIGHT),
    Handle(
        "loupe-picture",
        "picture",
        "Loupe",
        ("column", "row"),
        _loupe,
        _loupe_pulled,
        "press",
        "camera",
        reversed=("row",),
    ),
    Handle(
        "enlarged",
        "loupe",
        "Picture under the loupe",
        ("column", "row"),
        _enlarged,
        _enlarged_pulled,
        "drag",
        reversed=("column",),
    ),
)
