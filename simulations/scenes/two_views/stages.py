"""The stages of the two views: a square with blocks, as each camera sees it."""

import math
from collections.abc import Mapping

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.color.srgb import encode_srgb_table
from simulations.models.projection.level_ground import pose_above_ground
from simulations.models.projection.pinhole import intrinsics
from simulations.pictures.tiled_floor import Box, tiled_floor, with_box
from simulations.scenes.two_views.settings import Settings
from simulations.scenes.two_views.view import EYE_M, HALF_HEIGHT_PX, HALF_WIDTH_PX

COARSE = "coarse"
"""The draft while the focal length moves, on which both pictures depend."""
RED, TEAL, OCHRE, BLUE = (
    (0.42, 0.10, 0.055),
    (0.075, 0.20, 0.21),
    (0.52, 0.31, 0.12),
    (0.10, 0.16, 0.34),
)
BLOCKS = (
    Box(3.2, 18.0, 2.0, 4.6, OCHRE),
    Box(-2.6, 14.0, 1.5, 3.4, BLUE),
    Box(5.0, 10.0, 1.5, 3.2, RED),
    Box(-4.2, 8.0, 1.2, 2.6, OCHRE),
    Box(2.6, 5.5, 0.8, 1.9, TEAL),
    Box(-1.7, 4.0, 0.7, 1.1, RED),
)
"""What stands on the square, farthest first: the nearer, the more it moves between the pictures."""
SAMPLES, COARSE_SAMPLES = 1.6, 1.1
"""Drawn pixels per pixel of the pictures, each way."""


def parameters(_settings: Settings, tier: str) -> Mapping[str, Value]:
    """Further parameters of the stages."""
    return {"samples": COARSE_SAMPLES if tier == COARSE else SAMPLES}


def _left(focal_length: float, samples: float) -> Raster:
    return _square(focal_length, 0.0, 0.0, samples)


def _right(focal_length: float, baseline: float, toe_in: float, samples: float) -> Raster:
    return _square(focal_length, baseline, math.radians(toe_in), samples)


def _square(focal_px: float, right_m: float, turned_in_rad: float, samples: float) -> Raster:
    pose = pose_above_ground(EYE_M, -turned_in_rad, 0.0)
    pose[:3, 3] -= pose[:3, :3] @ [right_m, 0.0, 0.0]
    columns, rows = round(2 * samples * HALF_WIDTH_PX), round(2 * samples * HALF_HEIGHT_PX)
    K = intrinsics(samples * focal_px, (0.5 * (columns - 1), 0.5 * (rows - 1)))
    picture = tiled_floor(pose, K, columns, rows)
    for block in BLOCKS:
        picture = with_box(picture, pose, K, block)
    return to_rgba8(np.asarray(encode_srgb_table(picture)))


STAGES = (Stage("left", _left), Stage("right", _right))
