"""The stages of the tiled floor: the camera; the floor; the photograph, with the box."""

import numpy as np
from numpy.typing import NDArray

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb_table
from simulations.pictures.tiled_floor import Box, tiled_floor, with_box
from simulations.scenes.tiled_floor.view import BOX_WIDTH_M, WIDTH_PX, Camera, camera

COLUMNS, ROWS = 320, 240
"""Scale of the drawn picture: 4 for 5 pixels, each way."""
WIDER = 3
"""Width of the second panel in widths of the picture; it has half the pixels."""


def _drawn_intrinsics(view: Camera) -> Floats:
    """From the camera's pixels to the drawn ones: x' + ½ = s (x + ½)."""
    s = COLUMNS / WIDTH_PX
    shift = 0.5 * (s - 1.0)
    return np.array([[s, 0.0, shift], [0.0, s, shift], [0.0, 0.0, 1.0]]) @ view.K


def _floor(view: Camera) -> NDArray[np.float32]:
    return tiled_floor(view.pose, _drawn_intrinsics(view), COLUMNS, ROWS)


def _photograph(
    floor: NDArray[np.float32], view: Camera, box_x: float, box_y: float, box_height: float
) -> Raster:
    box = Box(box_x, box_y, BOX_WIDTH_M, box_height)
    return to_rgba8(encode_srgb_table(with_box(floor, view.pose, _drawn_intrinsics(view), box)))


def _wider(photograph: Raster) -> Raster:
    """The photograph at half its size in the middle of an otherwise empty image plane."""
    height, width = ROWS // 2, COLUMNS // 2
    rows = np.add(photograph[::2], photograph[1::2], dtype=np.uint16)
    plane = np.zeros((WIDER * height, WIDER * width, 4), np.uint8)
    plane[height : 2 * height, width : 2 * width] = (rows[:, ::2] + rows[:, 1::2] + 2) >> 2
    return plane


STAGES = (
    Stage("camera", camera),
    Stage("floor", _floor, ("camera",)),
    Stage("picture", _photograph, ("floor", "camera")),
    Stage("wider", _wider, ("picture",)),
)
