"""What the tiled floor computes: the camera; the floor; the photograph, with the box on it."""

import numpy as np
from numpy.typing import NDArray

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.color.srgb import encode_srgb_table
from simulations.pictures.tiled_floor import Box, tiled_floor, with_box
from simulations.scenes.tiled_floor.view import BOX_WIDTH_M, HEIGHT_PX, WIDTH_PX, Camera, camera

WIDER = 3
"""How many times as wide as the picture the second panel is; its pixels are half as many."""


def _floor(view: Camera) -> NDArray[np.float32]:
    return tiled_floor(view.pose, view.K, WIDTH_PX, HEIGHT_PX)


def _photograph(
    floor: NDArray[np.float32], view: Camera, box_x: float, box_y: float, box_height: float
) -> Raster:
    box = Box(box_x, box_y, BOX_WIDTH_M, box_height)
    return to_rgba8(encode_srgb_table(with_box(floor, view.pose, view.K, box)))


def _wider(photograph: Raster) -> Raster:
    """The photograph at half its size in the middle of an image plane that is else empty."""
    height, width = HEIGHT_PX // 2, WIDTH_PX // 2
    quads = photograph.reshape(height, 2, width, 2, 4).astype(np.uint16)
    plane = np.zeros((WIDER * height, WIDER * width, 4), np.uint8)
    plane[height : 2 * height, width : 2 * width] = (quads.sum(axis=(1, 3)) + 2) // 4
    return plane


STAGES = (
    Stage("camera", camera),
    Stage("floor", _floor, ("camera",)),
    Stage("picture", _photograph, ("floor", "camera")),
    Stage("wider", _wider, ("picture",)),
)
