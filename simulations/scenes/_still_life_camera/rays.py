"""The rays of the camera that photographs the still life, and how wide it blurs each depth.

``focal_length`` is in millimetres and ``focus`` in metres, as on the controls. Lengths on the
sensor are converted to angles by ``principal_mm``, the distance from lens to sensor.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.models.distortion.lens_model import (
    Distortion,
    largest_distorted_radius,
    undistort_clamped,
)
from simulations.models.lens import thin_lens
from simulations.models.projection import pinhole
from simulations.pictures.still_life import things as still_life

SENSOR_WIDTH_MM, SENSOR_HEIGHT_MM = 36.0, 24.0
COLUMNS, ROWS = 264, 176
PITCH_MM = SENSOR_WIDTH_MM / COLUMNS
"""A pixel of this picture is as wide as some twenty of a real sensor: coarse enough to be seen."""


@dataclass(frozen=True, slots=True)
class Rays:
    """The rays of the pixels."""

    directions: Floats
    """(rows, columns, 3) in the camera frame, z = 1."""
    valid: Mask
    """(rows, columns) false where the lens sends no ray to the pixel."""


def blur_px(focal_length: float, aperture: float, focus: float, depth_m: Floats | float) -> Floats:
    """Diameter of the disc of confusion, in pixels, of points ``depth_m`` along the axis."""
    depth_mm = np.asarray(depth_m, float) * 1000.0
    disc = thin_lens.circle_of_confusion_mm(focal_length, aperture, focus * 1000.0, depth_mm)
    return disc / PITCH_MM


def principal_mm(focal_length: float, focus: float) -> float:
    """Distance from the lens to the sensor, which scales the projection; it is f only at
    infinity."""
    return thin_lens.principal_distance_mm(focal_length, focus * 1000.0)


@lru_cache(maxsize=4)  # called several times a frame
def ideal_reach(principal: float, k1: float) -> tuple[float, float]:
    """Reach of the sensor's view to the right of the axis and down: the largest x/z and y/z.

    The largest is in the corner, on the fold if that is nearer, or, with pincushion, in the middle
    of a side.
    """
    lens, half = Distortion(k1=k1), np.array([SENSOR_WIDTH_MM, SENSOR_HEIGHT_MM]) / 2 / principal
    farthest = min(math.hypot(*half), largest_distorted_radius(lens))
    ideal, _ = undistort_clamped([(farthest, 0.0), (half[0], 0.0), (half[1], 0.0)], lens)
    across, down = np.maximum(ideal[1:, 0], ideal[0, 0] * np.minimum(half / farthest, 1.0))
    return float(across), float(down)


def nearest_depth(principal: float, k1: float, back: float = 0.0) -> float:
    """Depth of the nearest thing or spot of floor that the sensor sees, metres."""
    _, down = ideal_reach(principal, k1)
    falling = still_life.WORLD_TO_CAMERA[:3, 2] @ (0.0, -down, -1.0)
    floor = still_life.eye(back)[2] / falling if falling > 0 else math.inf
    nearest = min(still_life.thing_depth(thing) for thing in still_life.THINGS)
    return float(min(floor, nearest + back))


def largest_blur_px(
    focal_length: float, aperture: float, focus: float, k1: float, back: float = 0.0
) -> float:
    """The widest disc of confusion in the picture; blur grows to both sides of the focus."""
    nearest = nearest_depth(principal_mm(focal_length, focus), k1, back)
    ends = np.array([nearest, still_life.WALL_DISTANCE + back])
    return float(blur_px(focal_length, aperture, focus, ends).max())


def sensor_rays(focal_length: float, focus: float) -> Rays:
    """Straight rays, one through each pixel of the sensor."""
    return pinhole_rays(focal_length, focus, 1, 0, 0)


def pinhole_rays(
    focal_length: float, drawn_focus: float, reduction: float, margin_columns: int, margin_rows: int
) -> Rays:
    """Straight rays through the sensor and a margin on each of its sides, one for ``reduction``
    pixels each way; below 1, several for each pixel."""
    columns = round((COLUMNS + 2 * margin_columns) / reduction)
    rows = round((ROWS + 2 * margin_rows) / reduction)
    centre = ((columns - 1) / 2, (rows - 1) / 2)
    K = pinhole.intrinsics(principal_mm(focal_length, drawn_focus) / (PITCH_MM * reduction), centre)
    return Rays(pinhole.pixel_rays(K, columns, rows), np.ones((rows, columns), bool))
