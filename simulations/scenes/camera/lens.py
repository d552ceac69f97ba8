"""The settings of the camera, its step back in the dolly zoom, and its lens distortion, as bent
rays or as a bent picture.

``focal_length`` is in millimetres and ``focus`` in metres, as on the controls.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from simulations.engine.settings import action, slider, toggle
from simulations.models.arrays import Floats, Planes
from simulations.models.distortion.lens_model import (
    Distortion,
    largest_distorted_radius,
    undistort_clamped,
)
from simulations.models.sampling.cubic_warp import CubicWarp, cubic_warp, warp
from simulations.world.still_life_camera import (
    COLUMNS,
    PITCH_MM,
    ROWS,
    SENSOR_HEIGHT_MM,
    SENSOR_WIDTH_MM,
    Rays,
    ideal_reach,
    largest_blur_px,
    principal_mm,
    step_back,
)

STRONGEST_BARREL = -0.4  # the lowest k₁ of the slider
MARGINS_PX = (4, 8, 16, 24, 32, 48, 72)
"""Widths of a margin: few, so that most changes of k₁ do not change the straight picture. The least
is drawn for k₁ = 0 too, so that the first change need not redraw it."""
WARP_REACH_PX = 2  # pixels that a cubic reads beyond a place


@dataclass(frozen=True, slots=True)
class Settings:
    focal_length: float = slider("Focal length", 50.0, 24.0, 135.0, 1.0, unit="mm")
    aperture: float = slider("Aperture", 5.6, 1.4, 22.0, 0.1, prefix="f/")
    focus: float = slider("Focus distance", 3.2, 1.0, 10.0, 0.1, unit="m")
    dolly: int = action("Dolly zoom", "Pause", drives="back", effect="play", seconds=10.0)
    back: float = slider("Dolly zoom distance", 0.0, 0.0, 4.0, 0.1, unit="m")
    light_angle: float = slider("Light angle", 40.0, -80.0, 80.0, 1.0, unit="°")
    exposure: float = slider("Exposure", 0.0, -3.0, 3.0, 0.1, unit="EV")
    k1: float = slider("Distortion k₁", 0.0, STRONGEST_BARREL, 0.4, 0.01)
    noise_sigma: float = slider("Read noise σ", 5.0, 0.0, 40.0, 1.0, unit="codes")
    shot_noise: bool = toggle("Photon shot noise", default=True)
    new_noise: int = action(*("Take another photo",) * 8)


def after_step(settings: Settings) -> Settings:
    """The settings with the focal length and the focus that the camera has after its step back.

    The sliders are for the lens and the focus before the step.
    """
    if not settings.back:
        return settings
    focal_length, focus = step_back(settings.focal_length, settings.focus, settings.back)
    return replace(settings, focal_length=focal_length, focus=focus)


def blur_of(settings: Settings) -> float:
    """The widest disc of confusion in the picture, in pixels."""
    focal, aperture, focus = settings.focal_length, settings.aperture, settings.focus
    return largest_blur_px(focal, aperture, focus, settings.k1, settings.back)


def view_of(settings: Settings) -> float:
    """Angle that the sensor sees from left to right, in radians, along the rays that the lens
    bends. Past the fold of a barrel, as far as any ray reaches."""
    edge = SENSOR_WIDTH_MM / 2 / principal_mm(settings.focal_length, settings.focus)
    ideal, _ = undistort_clamped([(edge, 0.0)], Distortion(k1=settings.k1))
    return 2.0 * math.atan(float(ideal[0, 0]))


def margin_px(focal_length: float, focus: float, k1: float) -> tuple[int, int]:
    """Columns and rows by which the straight picture must exceed each side of the sensor."""
    principal = principal_mm(focal_length, focus)
    across, down = (
        next(margin for margin in MARGINS_PX if margin >= needed)
        for needed in (
            reach * principal / PITCH_MM - size / 2 + WARP_REACH_PX
            for reach, size in zip(ideal_reach(principal, k1), (COLUMNS, ROWS), strict=True)
        )
    )
    return across, down


def widest_barrel(focal_length: float, focus: float, strongest: float) -> float:
    """The k₁ from ``strongest`` upwards whose picture needs the widest margin.

    The corner, at radius h, is seen from 3/2 h where the image of the fold, √(−4 / (27 k₁)), lies
    right on it. A stronger barrel shows less of the world, behind a circle.
    """
    half_diagonal = math.hypot(SENSOR_WIDTH_MM, SENSOR_HEIGHT_MM) / 2
    corner = half_diagonal / principal_mm(focal_length, focus)
    return max(strongest, -4 / (27 * corner**2))


@dataclass(frozen=True, slots=True)
class LensMap:
    """The map from the straight picture to the sensor."""

    table: CubicWarp
    """Place in the straight picture of each pixel of the sensor."""
    reached: Planes
    """(rows, columns) share of each pixel that rays reach."""


def lens_map(
    straight: Rays, focal_length: float, focus: float, k1: float, reduction: int
) -> LensMap:
    """Place of each pixel's light in the picture that ``straight`` rays make."""
    rows, columns = (size * reduction for size in straight.valid.shape)
    pitch = PITCH_MM / principal_mm(focal_length, focus)
    x, y = (np.arange(COLUMNS // 2) + 0.5) * pitch, (np.arange(ROWS // 2) + 0.5) * pitch
    distorted = np.stack(np.broadcast_arrays(x, y[:, None]), axis=-1)
    ideal, _ = undistort_clamped(distorted, Distortion(k1=k1))
    table = cubic_warp(
        four_quarters(ideal[..., 0] / pitch, -1, 1) + (columns - 1) / 2,
        four_quarters(ideal[..., 1] / pitch, 1, -1) + (rows - 1) / 2,
        (rows, columns),
    )
    inside = (largest_distorted_radius(Distortion(k1=k1)) - np.hypot(x, y[:, None])) / pitch
    reached = np.clip(inside + 0.5, 0.0, 1.0)
    return LensMap(table, four_quarters(reached, 1, 1).astype(np.float32))


def four_quarters(quarter: Floats, to_the_left: int, upwards: int) -> Floats:
    """A whole picture from its lower right quarter, with the signs of the mirror images."""
    half = np.concatenate((to_the_left * quarter[:, ::-1], quarter), axis=1)
    return np.concatenate((upwards * half[::-1], half), axis=0)


def distort_picture(straight: Planes, lens: LensMap) -> Planes:
    """The straight picture as the lens shows it; black where no ray arrives."""
    # Cubics dip a little below the dark side of an edge, but no light is negative.
    return np.maximum(warp(lens.table, straight), 0.0) * lens.reached


def trim(straight: Planes, margin_columns: int, margin_rows: int) -> Planes:
    """The part of the straight picture on the sensor, for a lens without distortion."""
    rows, columns = straight.shape[1:]
    return straight[:, margin_rows : rows - margin_rows, margin_columns : columns - margin_columns]
