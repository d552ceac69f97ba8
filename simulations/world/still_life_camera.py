"""The camera that photographs the still life: its rays, the picture through a thin lens by stages
that several figures share, and the plane of focus.

``focal_length`` is in millimetres and ``focus`` in metres, as on the controls. Lengths on the
sensor are converted to angles by ``principal_mm``, the distance from lens to sensor.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.drawing import cased, path
from simulations.models.arrays import Floats, Mask, Planes, centred
from simulations.models.distortion.lens_model import (
    Distortion,
    largest_distorted_radius,
    undistort_clamped,
)
from simulations.models.lens import thin_lens
from simulations.models.lens.depth_of_field import blur_by_depth, blur_layer, composite
from simulations.models.lens.disc_pyramid import double
from simulations.models.lens.vignetting import vignetting_cos4
from simulations.models.projection import pinhole
from simulations.models.sampling.magnification import magnify
from simulations.world import still_life
from simulations.world.layers import LitScene, light
from simulations.world.surfaces import Surface, surfaces

SENSOR_WIDTH_MM, SENSOR_HEIGHT_MM = 36.0, 24.0
COLUMNS, ROWS = 264, 176
PITCH_MM = SENSOR_WIDTH_MM / COLUMNS
"""A pixel of this picture is as wide as some twenty of a real sensor: coarse enough to be seen."""
SUBJECT_M = still_life.object_depth(
    next(item for item in still_life.OBJECTS if item.name == "striped ball")
)
"""Depth of the object that keeps its size as the camera steps back."""
FARTHEST_M = 10.0
"""Focus of the level `SCALED`, metres: the end of the slider, so that the picture at any other
focus is an enlarged part of this one."""
SCALED = "scaled"
SCALED_LABEL = "One picture, blurred and enlarged"
"""The level at which another focus costs least: one sharp picture is blurred anew and enlarged as
the lens breathes. One of fewer pixels would look out of focus everywhere."""
SHARP_PX = 0.3
"""Blur is skipped if the widest disc of confusion is at most this many pixels wide. The RMS error
against 37 rays through the lens is then at most half a code of 255, measured at four lenses and
distances; at one pixel it would be up to 2.1 codes. Tiers that send rays through the lens always
send them."""
HANDLE_TANGENT = 0.095
"""Column of the line's handle, to the right of the axis: a lane of floor that is free up to the
wall."""
UP = still_life.WORLD_TO_CAMERA[:3, 2]  # the vertical in the camera's frame


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


@lru_cache(maxsize=16)  # called a dozen times a frame
def principal_mm(focal_length: float, focus: float) -> float:
    """Distance from the lens to the sensor, which scales the projection; it is f only at
    infinity."""
    return thin_lens.principal_distance_mm(focal_length, focus * 1000.0)


def step_back(focal_length: float, focus: float, back: float) -> tuple[float, float]:
    """Focal length and focus of the camera ``back`` metres farther away.

    It zooms in, so that one object keeps its size, and stays focused on it.
    """
    if not back:
        return focal_length, focus
    principal = principal_mm(focal_length, focus) * (1 + back / SUBJECT_M)
    return 1.0 / (1.0 / principal + 1.0 / (1000.0 * (focus + back))), focus + back


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
    """Depth of the nearest object or spot of floor that the sensor sees, metres."""
    _, down = ideal_reach(principal, k1)
    falling = still_life.WORLD_TO_CAMERA[:3, 2] @ (0.0, -down, -1.0)
    floor = still_life.eye(back)[2] / falling if falling > 0 else math.inf
    nearest = min(still_life.object_depth(item) for item in still_life.OBJECTS)
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


def bend_rays(rays: Rays, k1: float, k2: float = 0.0) -> Rays:
    """The ray that the lens bends onto each pixel, without resampling."""
    ideal, valid = undistort_clamped(rays.directions[..., :2], Distortion(k1=k1, k2=k2))
    return Rays(np.concatenate((ideal, rays.directions[..., 2:]), axis=-1), valid)


def drawing_of(scaled: bool, focal_length: float, focus: float) -> dict[str, Value]:
    """Parameters of the stages: the focus that the picture is drawn at, and its magnification."""
    drawn = max(FARTHEST_M, focus) if scaled else focus
    larger = principal_mm(focal_length, focus) / principal_mm(focal_length, drawn)
    return {"drawn_focus": drawn, "enlarged": larger}


def find_surfaces(rays: Rays, back: float) -> tuple[Surface, ...]:
    """The surfaces of the still life that the rays meet, seen from ``back`` metres farther away."""
    return surfaces(still_life.view(rays.directions, rays.valid, back))


def light_surfaces(parts: tuple[Surface, ...], light_angle: float) -> LitScene:
    """The surfaces in the light of a lamp at ``light_angle`` degrees."""
    return light(parts, light_angle)


def defocus(
    lit: LitScene,
    focal_length: float,
    aperture: float,
    focus: float,
    reduction: float,
    enlarged: float,
) -> LitScene:
    """Blur each layer, and the background by depth, by the discs of confusion."""
    per_radius = 2 * reduction * enlarged
    return blur_layers(
        lit, lambda depth: blur_px(focal_length, aperture, focus, depth) / per_radius
    )


def blur_layers(lit: LitScene, radius_px: Callable[[Floats | float], Floats]) -> LitScene:
    """Blur each layer, and the background by depth, by discs of the radius at their depth."""
    layers = tuple(
        blur_layer(replace(layer, radius_px=float(radius_px(depth))))
        for layer, depth in zip(lit.layers, lit.depths, strict=True)
    )
    return replace(lit, base=blur_by_depth(lit.base, radius_px(lit.base_depth)), layers=layers)


def overlay(lit: LitScene, enlarged: float) -> Planes:
    """All layers composited to one picture (3, H, W) and magnified ``enlarged`` times."""
    picture = composite(lit.base, lit.layers)
    if enlarged == 1:
        return picture
    # Cubics dip a little below the dark side of an edge, but no light is negative.
    return np.maximum(np.stack([magnify(plane, enlarged) for plane in picture]), 0.0)


def vignette(radiance: Planes, focal_length: float, focus: float) -> Planes:
    """Light (3, H, W) on the whole sensor, relative to that of the same surface on the axis."""
    rows, columns = radiance.shape[1:]
    pitch = SENSOR_WIDTH_MM / columns
    x, y = centred(columns) * pitch, centred(rows) * pitch
    falloff = vignetting_cos4(np.hypot(x, y[:, None]) / principal_mm(focal_length, focus))
    return radiance * falloff.astype(np.float32)


def through_lens(
    rays: Rays,
    at: tuple[float, float],
    light_angle: float,
    focal_length: float,
    aperture: float,
    focus: float,
    back: float = 0.0,
) -> Planes:
    """The picture seen through one point of the lens: ``at`` = (right, down) in the unit disc."""
    radius = focal_length / aperture / 2000.0  # metres
    place = (radius * at[0], radius * at[1])
    view = still_life.view_through(rays.directions, rays.valid, place, focus, back)
    return overlay(light(surfaces(view), light_angle), 1.0)


def mean_through_lens(
    rays: Rays,
    points: Floats,
    light_angle: float,
    focal_length: float,
    aperture: float,
    focus: float,
    back: float = 0.0,
) -> Planes:
    """The mean of the pictures seen through ``points`` (n, 2) of the unit disc."""
    setting = (light_angle, focal_length, aperture, focus, back)
    total = np.zeros((3, *rays.valid.shape), np.float32)
    for right, down in points.tolist():
        total += through_lens(rays, (right, down), *setting)
    return np.asarray(total / np.float32(len(points)), np.float32)


def enlarge(overlaid: Planes, reduction: float) -> Planes:
    """Scale up a picture (3, h, w) drawn with one ray per ``reduction`` pixels each way."""
    for _ in range(int(reduction).bit_length() - 1):
        overlaid = double(overlaid)
    return overlaid


def in_focus(largest_blur: float) -> str:
    """The reason to leave out the blur, if the widest disc is ``largest_blur`` px; else empty."""
    return f"no disc is wider than {SHARP_PX} px" if largest_blur <= SHARP_PX else ""


def floor_tangent(depth: float) -> float:
    """Tangent of the angle from the axis down to the floor ``depth`` metres away."""
    return float(-(still_life.EYE[2] / depth + UP[2]) / UP[1])


def line_on_floor(
    lit: LitScene, row: float, width: float, height: float, enlarged: float = 1.0
) -> str:
    """SVG of the line along a row of a view box, where no object of the picture hides it. The
    picture is magnified ``enlarged`` times about its middle."""
    rows, columns = lit.base_depth.shape
    place = int(((row / height - 0.5) / enlarged + 0.5) * rows)
    hidden = np.zeros(columns, bool)
    for layer in lit.layers:
        _, layer_rows, layer_columns = layer.planes.shape
        if layer.top <= place < layer.top + layer_rows:
            left, right = max(layer.left, 0), min(layer.left + layer_columns, columns)
            cover = layer.planes[3, place - layer.top, left - layer.left : right - layer.left]
            hidden[left:right] |= cover > 0.5
    edges = np.flatnonzero(np.diff(hidden, prepend=True, append=True)) / columns
    ends = np.clip((edges - 0.5) * enlarged + 0.5, 0.0, 1.0) * width
    pieces = [[(start, row), (end, row)] for start, end in ends.reshape(-1, 2) if end > start]
    return cased(path, pieces, style="ray")
