"""What the two views compute: the floor, as each camera sees it."""

import math

import numpy as np

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.color.srgb import encode_srgb_table
from simulations.models.projection.level_ground import pose_above_ground
from simulations.models.projection.pinhole import intrinsics
from simulations.pictures.tiled_floor import tiled_floor
from simulations.scenes.two_views.view import EYE_M, HALF_HEIGHT_PX, HALF_WIDTH_PX

SAMPLES = 1.6
"""Pixels drawn to a pixel of the pictures, each way."""
COLUMNS, ROWS = round(2 * SAMPLES * HALF_WIDTH_PX), round(2 * SAMPLES * HALF_HEIGHT_PX)


def _left(focal_length: float) -> Raster:
    return _floor(focal_length, 0.0, 0.0)


def _right(focal_length: float, baseline: float, toe_in: float) -> Raster:
    return _floor(focal_length, baseline, math.radians(toe_in))


def _floor(focal_px: float, right_m: float, turned_in_rad: float) -> Raster:
    pose = pose_above_ground(EYE_M, -turned_in_rad, 0.0)
    pose[:3, 3] -= pose[:3, :3] @ [right_m, 0.0, 0.0]
    K = intrinsics(SAMPLES * focal_px, (0.5 * (COLUMNS - 1), 0.5 * (ROWS - 1)))
    return to_rgba8(np.asarray(encode_srgb_table(tiled_floor(pose, K, COLUMNS, ROWS))))


STAGES = (Stage("left", _left), Stage("right", _right))
