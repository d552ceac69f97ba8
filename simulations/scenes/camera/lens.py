"""The camera's lens: which ray it bends onto each pixel, and how wide it blurs each depth.

As on the controls, ``focal_length`` is in millimetres and ``focus`` in metres. Places on the sensor
are measured in ``principal_mm``, the distance from lens to sensor.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from simulations.models.arrays import Floats, Mask, Planes
from simulations.models.distortion.lens_model import (
    Distortion,
    largest_distorted_radius,
    undistort_clamped,
)
from simulations.models.lens import thin_lens
from simulations.models.projection import pinhole
from simulations.models.sampling.cubic_warp import CubicWarp, cubic_warp, warp
from simulations.pictures.still_life import things as still_life

SENSOR_WIDTH_MM, SENSOR_HEIGHT_MM = 36.0, 24.0
COLUMNS, ROWS = 264, 176
PITCH_MM = SENSOR_WIDTH_MM / COLUMNS
"""A pixel of this picture is as wide as some twenty of a real sensor: coarse enough to be seen."""

MARGINS_PX = (4, 8, 16, 24, 32, 48, 72)
"""Widths of a margin: few, so that most changes of k₁ leave the straight picture as it is. The
least is drawn for k₁ = 0 too, where nothing reads it: so the first touch finds it there."""
WARP_REACH_PX = 2
"""Pixels that a cubic reads beyond the place that is asked for."""


@dataclass(frozen=True, slots=True)
class Rays:
    """What each pixel looks along."""

    directions: Floats
    """(rows, columns, 3) in the camera frame, z = 1."""
    valid: Mask
    """(rows, columns) false where the lens sends no ray to the pixel."""


@dataclass(frozen=True, slots=True)
class LensMap:
    """Where the lens puts the straight picture."""

    table: CubicWarp
    """Place in the straight picture of each pixel of the sensor."""
    reached: Planes
    """(rows, columns) share of each pixel that any ray reaches."""


def blur_px(focal_length: float, aperture: float, focus: float, depth_m: Floats | float) -> Floats:
    """Diameter of the disc of confusion, in pixels, of points ``depth_m`` along the axis."""
    depth_mm = np.asarray(depth_m, float) * 1000.0
    disc = thin_lens.circle_of_confusion_mm(focal_length, aperture, focus * 1000.0, depth_mm)
    return disc / PITCH_MM


def principal_mm(focal_length: float, focus: float) -> float:
    """From the lens to the sensor: what the picture is projected with, and f only at infinity."""
    return thin_lens.principal_distance_mm(focal_length, focus * 1000.0)


@lru_cache(maxsize=4)  # asked for several times a frame
def ideal_reach(principal: float, k1: float) -> tuple[float, float]:
    """How far right and down of the axis the sensor sees: the largest of x/z and of y/z.

    It is found where the picture reaches farthest: in the corner, on the fold where that comes
    first, or, with pincushion, in the middle of a side.
    """
    lens, half = Distortion(k1=k1), np.array([SENSOR_WIDTH_MM, SENSOR_HEIGHT_MM]) / 2 / principal
    farthest = min(math.hypot(*half), largest_distorted_radius(lens))
    ideal, _ = undistort_clamped([(farthest, 0.0), (half[0], 0.0), (half[1], 0.0)], lens)
    across, down = np.maximum(ideal[1:, 0], ideal[0, 0] * np.minimum(half / farthest, 1.0))
    return float(across), float(down)


def half_view_tangent(focal_length: float, focus: float, k1: float) -> float:
    """Tangent of half the angle that the sensor sees from left to right, along the rays that the
    lens bends. Past the fold of a barrel, as far as any ray reaches."""
    edge = SENSOR_WIDTH_MM / 2 / principal_mm(focal_length, focus)
    ideal, _ = undistort_clamped([(edge, 0.0)], Distortion(k1=k1))
    return float(ideal[0, 0])


def margin_px(focal_length: float, focus: float, k1: float) -> tuple[int, int]:
    """Columns and rows by which the straight picture must exceed each side of the sensor."""
    principal = principal_mm(focal_length, focus)
    across, down = ideal_reach(principal, k1)
    return _margin(across * principal, COLUMNS), _margin(down * principal, ROWS)


def _margin(reach_mm: float, size: int) -> int:
    needed = reach_mm / PITCH_MM - size / 2 + WARP_REACH_PX
    return next(margin for margin in MARGINS_PX if margin >= needed)


def widest_barrel(focal_length: float, focus: float, strongest: float) -> float:
    """The k₁ from ``strongest`` upwards whose picture needs the widest margin.

    The corner, at radius h, is seen from 3/2 h where the image of the fold, √(−4 / (27 k₁)), lies
    right on it. A stronger barrel shows less of the world, behind a circle.
    """
    half_diagonal = math.hypot(SENSOR_WIDTH_MM, SENSOR_HEIGHT_MM) / 2
    corner = half_diagonal / principal_mm(focal_length, focus)
    return max(strongest, -4 / (27 * corner**2))


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
    focal_length: float, drawn_focus: float, reduction: int, margin_columns: int, margin_rows: int
) -> Rays:
    """Straight rays through the pixels of the sensor and of a margin on each of its sides."""
    columns = (COLUMNS + 2 * margin_columns) // reduction
    rows = (ROWS + 2 * margin_rows) // reduction
    centre = ((columns - 1) / 2, (rows - 1) / 2)
    K = pinhole.intrinsics(principal_mm(focal_length, drawn_focus) / (PITCH_MM * reduction), centre)
    return Rays(pinhole.pixel_rays(K, columns, rows), np.ones((rows, columns), bool))


def bend_rays(rays: Rays, k1: float) -> Rays:
    """The ray that the lens bends onto each pixel: nothing is resampled, nothing lost."""
    ideal, valid = undistort_clamped(rays.directions[..., :2], Distortion(k1=k1))
    return Rays(np.concatenate((ideal, rays.directions[..., 2:]), axis=-1), valid)


def lens_map(
    straight: Rays, focal_length: float, focus: float, k1: float, reduction: int
) -> LensMap:
    """Where each pixel of the sensor finds its light in the picture that ``straight`` rays make."""
    rows, columns = (size * reduction for size in straight.valid.shape)
    pitch = PITCH_MM / principal_mm(focal_length, focus)
    x, y = (np.arange(COLUMNS // 2) + 0.5) * pitch, (np.arange(ROWS // 2) + 0.5) * pitch
    seen = np.stack(np.broadcast_arrays(x, y[:, None]), axis=-1)
    ideal, _ = undistort_clamped(seen, Distortion(k1=k1))
    table = cubic_warp(
        _four_quarters(ideal[..., 0] / pitch, -1, 1) + (columns - 1) / 2,
        _four_quarters(ideal[..., 1] / pitch, 1, -1) + (rows - 1) / 2,
        (rows, columns),
    )
    inside = (largest_distorted_radius(Distortion(k1=k1)) - np.hypot(x, y[:, None])) / pitch
    reached = np.clip(inside + 0.5, 0.0, 1.0)
    return LensMap(table, _four_quarters(reached, 1, 1).astype(np.float32))


def _four_quarters(quarter: Floats, to_the_left: int, upwards: int) -> Floats:
    """A whole picture from its lower right quarter: the signs are those of the mirror images."""
    half = np.concatenate((to_the_left * quarter[:, ::-1], quarter), axis=1)
    return np.concatenate((upwards * half[::-1], half), axis=0)


def distort_picture(straight: Planes, lens: LensMap) -> Planes:
    """The straight picture as the lens shows it; black where no ray arrives."""
    # Cubics dip a little below the dark side of an edge, but no light is negative.
    return np.maximum(warp(lens.table, straight), 0.0) * lens.reached


def trim(straight: Planes, margin_columns: int, margin_rows: int) -> Planes:
    """What of the straight picture falls on the sensor, where the lens bends nothing."""
    rows, columns = straight.shape[1:]
    return straight[:, margin_rows : rows - margin_rows, margin_columns : columns - margin_columns]
