"""Handles of the Bayer figure: the loupe, and the picture under it."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.bayer_demosaic.drawing import CELL, PIXEL
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


def _over(panel: str) -> Handle[Settings]:
    return Handle(
        f"loupe-{panel}",
        panel,
        "Loupe",
        ("column", "row"),
        _loupe,
        _loupe_pulled,
        "press",
        "camera",
        reversed=("row",),
    )


HANDLES: tuple[Handle[Settings], ...] = (
    _over("picture"),
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
    _over("error"),
)
