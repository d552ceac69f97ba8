"""The stages of the tiled floor: the camera; the floor; the photograph, with the box."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import Value
from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb_table
from simulations.pictures.tiled_floor import Box, tiled_floor, with_box
from simulations.scenes.tiled_floor.settings import Settings
from simulations.scenes.tiled_floor.view import BOX_WIDTH_M, HEIGHT_PX, WIDTH_PX, Camera, camera

DRAFT = "draft"
"""The picture while the camera or the box moves."""
COLUMNS, DRAFT_COLUMNS = 640, 320
"""Width of the drawn picture, at rest and in the draft."""
WIDER = 3
"""Width of the second panel in widths of the picture ..."""
SMALL_COLUMNS = 160
"""... which is drawn there with so many columns."""


def parameters(_settings: Settings, tier: str) -> Mapping[str, Value]:
    """Further parameters of the stages."""
    return {"columns": DRAFT_COLUMNS if tier == DRAFT else COLUMNS}


def _drawn_intrinsics(view: Camera, columns: int) -> Floats:
    """From the camera's pixels to the drawn ones: x' + ½ = s (x + ½)."""
    s = columns / WIDTH_PX
    shift = 0.5 * (s - 1.0)
    return np.array([[s, 0.0, shift], [0.0, s, shift], [0.0, 0.0, 1.0]]) @ view.K


def _floor(view: Camera, columns: int) -> NDArray[np.float32]:
    rows = columns * HEIGHT_PX // WIDTH_PX
    return tiled_floor(view.pose, _drawn_intrinsics(view, columns), columns, rows)


def _photograph(
    floor: NDArray[np.float32],
    view: Camera,
    box_x: float,
    box_y: float,
    box_height: float,
    columns: int,
) -> Raster:
    box = Box(box_x, box_y, BOX_WIDTH_M, box_height)
    K = _drawn_intrinsics(view, columns)
    return to_rgba8(encode_srgb_table(with_box(floor, view.pose, K, box)))


def _wider(photograph: Raster) -> Raster:
    """The photograph, reduced, in the middle of an otherwise empty image plane."""
    rows, columns, _ = photograph.shape
    step = columns // SMALL_COLUMNS
    height, width = rows // step, SMALL_COLUMNS
    lines = photograph[::step].astype(np.uint16)
    for line in range(1, step):
        lines += photograph[line::step]
    total = sum(lines[:, column::step] for column in range(step))
    plane = np.zeros((WIDER * height, WIDER * width, 4), np.uint8)
    plane[height : 2 * height, width : 2 * width] = (total + step * step // 2) // (step * step)
    return plane


STAGES = (
    Stage("camera", camera),
    Stage("floor", _floor, ("camera",)),
    Stage("picture", _photograph, ("floor", "camera")),
    Stage("wider", _wider, ("picture",)),
)
