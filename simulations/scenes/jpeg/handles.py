"""Handles of the JPEG figure: the dividing line, the block, and the last coefficient in use."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.models.compression.blocks import BLOCK
from simulations.models.compression.zigzag import RANK
from simulations.scenes._wipe.wipe import wipe_handle
from simulations.scenes.jpeg.drawing import HEIGHT, SIDE, WIDTH, cell_at, knob
from simulations.scenes.jpeg.settings import Settings


def _block(settings: Settings, _outputs: Outputs) -> Point:
    return ((settings.column - 0.5) * SIDE, (settings.row - 0.5) * SIDE)


def _block_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"column": place[0] / SIDE + 0.5, "row": place[1] / SIDE + 0.5}


def _last(settings: Settings, _outputs: Outputs) -> Point:
    return knob(settings.first)


def _last_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    """Count of coefficients up to the cell at the place, or the nearest one."""
    row, column = (min(max(index, 0), BLOCK - 1) for index in cell_at(place))
    return {"first": int(RANK[row, column]) + 1}


HANDLES: tuple[Handle[Settings], ...] = (
    wipe_handle("picture", "original", WIDTH, HEIGHT),
    Handle(
        "block",
        "picture",
        "Block",
        ("column", "row"),
        _block,
        _block_pulled,
        "press",
        "image",
        reversed=("row",),
    ),
    Handle(
        "last", "codes", "Last coefficient used", ("first",), _last, _last_pulled, "press", "ray"
    ),
)
