"""The stages of the depth-of-field figure: one picture, blurred in the way of each tier, and the
sharpness of its ends by the formulas.

The still life and its light are those of the camera simulator. There is no sensor, so that only
the lens softens the picture.
"""

import math
from collections.abc import Callable, Container, Iterator, Mapping
from dataclasses import KW_ONLY, dataclass
from functools import partial

import numpy as np

from simulations.engine.accuracy import Level
from simulations.engine.controls import Value
from simulations.engine.frame import Raster, Readout, format_number
from simulations.engine.raster import of_planes
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats, Planes
from simulations.models.color.srgb import encode_srgb_codes
from simulations.models.error_measures import root_mean_square
from simulations.models.lens import thin_lens
from simulations.models.lens.aperture import aperture_grid, fibonacci_disc
from simulations.models.lens.depth_of_field import blur_by_depth
from simulations.models.lens.screen_blur import binned_gaussian, gather_discs
from simulations.world.layers import LitScene
from simulations.world.still_life import OBJECTS, WALL_DISTANCE, object_depth
from simulations.world.still_life_camera import (
    PITCH_MM,
    SCALED,
    SCALED_LABEL,
    SENSOR_WIDTH_MM,
    Rays,
    blur_px,
    defocus,
    enlarge,
    find_surfaces,
    floor_tangent,
    in_focus,
    largest_blur_px,
    light_surfaces,
    line_on_floor,
    mean_through_lens,
    overlay,
    pinhole_rays,
    principal_mm,
    through_lens,
)

WIDTH, HEIGHT = 420.0, 280.0  # view box of the picture, and of the lens
NEAR_M, FAR_M = object_depth(OBJECTS[0]), WALL_DISTANCE
"""The red ball in front and the wall behind: the two ends of the still life."""
FINE = 0.5  # pixels per ray each way: the picture is shown wider than the sensor has pixels
LEVELS = (
    Level("pinhole", stage_values={"reduction": FINE}),
    Level("discs", stage_values={"reduction": FINE}),
    Level("coarse", "Layers, a ray for four pixels", {"tier": "layered", "reduction": 2.0}),
    Level(SCALED, SCALED_LABEL, {"tier": "layered", "reduction": 1.0}),
    Level("quick", "Layers, a ray a pixel", {"tier": "layered", "reduction": 1.0}),
    Level("layered", stage_values={"reduction": FINE}),
    Level("binned", stage_values={"reduction": FINE}),
    Level("gather", stage_values={"reduction": 1.0}),
    Level("fibonacci-16", stage_values={"reduction": 1.0}),
)
"""Rungs of the ladder `depth-of-field`, without its random rays and without 64 rays, which would
take seconds, and cheaper ways to blur each layer by itself."""
FILTERS: Mapping[str, Callable[[Planes, Floats, Floats], Planes]] = {
    "discs": lambda sharp, radius, _depth: blur_by_depth(sharp, radius),
    "binned": lambda sharp, radius, _depth: binned_gaussian(sharp, radius),
    "gather": gather_discs,
}
"""Tiers that blur a finished picture (3, H, W), by its radii of discs and its depths (H, W)."""
SPIRALS: Mapping[str, Floats] = {"fibonacci-16": fibonacci_disc(16)}
"""Tiers that send rays through points (n, 2) spread over the lens."""
COSTLY = ("gather", *SPIRALS)  # tiers of which each value fills two pixels
LIGHT_ANGLE_DEG = 40.0
FIXED: Mapping[str, Value] = {
    "light_angle": LIGHT_ANGLE_DEG,
    "margin_columns": 0,
    "margin_rows": 0,
    "back": 0.0,
}
"""Parameters of the camera's stages that this figure does not offer."""
FEWEST_ACROSS, MOST_ACROSS = 7, 15
"""Points across the lens of the picture that errors are measured against: 37 to 177 in all."""


@dataclass(frozen=True, slots=True)
class Sharpness:
    """Sharpness and blur of the still life at one setting; lengths in millimetres."""

    aperture_mm: float  # diameter of the opening
    image_mm: float  # distance from the lens to the sensor
    near_blur_mm: float  # disc of the red ball on the sensor
    _: KW_ONLY
    far_blur_mm: float  # disc of the wall
    near_limit_m: float  # nearest distance whose disc is at most a pixel
    far_limit_m: float  # farthest; ∞ from the hyperfocal distance on


def sharpness(focal_mm: float, f_number: float, focus_m: float) -> Sharpness:
    """Raises ValueError for a focus at the focal length or nearer, which has no real image."""
    focus_mm, ends_mm = 1000 * focus_m, np.array([1000 * NEAR_M, 1000 * FAR_M])
    blur = thin_lens.circle_of_confusion_mm(focal_mm, f_number, focus_mm, ends_mm)
    near, far = thin_lens.depth_of_field(focal_mm, f_number, focus_mm, PITCH_MM)
    image_mm = float(thin_lens.thin_lens_image_distance(focal_mm, focus_mm))
    return Sharpness(
        aperture_mm=focal_mm / f_number,
        image_mm=image_mm,
        near_blur_mm=float(blur[0]),
        far_blur_mm=float(blur[1]),
        near_limit_m=near / 1000,
        far_limit_m=far / 1000,
    )


def widest_px(focal_length: float, aperture: float, focus: float) -> float:
    """The widest disc in the picture of this lens, which has no distortion."""
    return largest_blur_px(focal_length, aperture, focus, k1=0.0)


def depth_of(lit: LitScene) -> Floats:
    """Depth (H, W) of the foremost object that covers more than half of the pixel, metres."""
    depth = lit.base_depth.copy()
    height, width = depth.shape
    for layer, layer_depth in zip(lit.layers, lit.depths, strict=True):
        rows, columns = layer.planes.shape[1:]
        top, left = max(layer.top, 0), max(layer.left, 0)
        bottom, right = min(layer.top + rows, height), min(layer.left + columns, width)
        cover = layer.planes[3, top - layer.top :, left - layer.left :]
        covered = cover[: max(bottom - top, 0), : max(right - left, 0)] > 0.5
        depth[top:bottom, left:right][covered] = layer_depth
    return depth


def enlarged_overlay(lit: LitScene, enlarged: float, reduction: float) -> Planes:
    return enlarge(overlay(lit, enlarged), reduction)


def filtered(
    sharp: Planes,
    lit: LitScene,
    focal_length: float,
    aperture: float,
    focus: float,
    reduction: float,
    tier: str,
) -> Planes:
    """The finished picture, each pixel blurred according to its depth."""
    depth = depth_of(lit)
    radius = blur_px(focal_length, aperture, focus, depth) / (2 * reduction)
    return FILTERS[tier](sharp, radius, depth)


def rays_through_lens(
    rays: Rays, light_angle: float, focal_length: float, aperture: float, focus: float, tier: str
) -> Planes:
    """The mean of pictures through points spread over the lens."""
    return mean_through_lens(rays, SPIRALS[tier], light_angle, focal_length, aperture, focus)


def encode(light: Planes) -> Raster:
    """Canvas bytes of linear light (3, H, W)."""
    return of_planes(encode_srgb_codes(light))


def repeated_raster(light: Planes, repeated: int) -> Raster:
    """Canvas bytes, each repeated so many times each way: all tiers show pictures of one size."""
    raster = encode(light)
    return np.ascontiguousarray(raster.repeat(repeated, axis=0).repeat(repeated, axis=1))


def units_per_tangent(focal_length: float, focus: float) -> float:
    """View box units of the picture per tangent of the angle from the axis."""
    return WIDTH * principal_mm(focal_length, focus) / SENSOR_WIDTH_MM


def floor_row(focal_length: float, focus: float) -> float | None:
    """Row of the view box in which the plane of focus cuts the floor; None outside the picture."""
    if focus > WALL_DISTANCE:
        return None
    row = HEIGHT / 2 + floor_tangent(focus) * units_per_tangent(focal_length, focus)
    return row if row < HEIGHT else None


def focus_line(lit: LitScene, focal_length: float, focus: float, enlarged: float) -> str:
    """SVG of the line in which the plane of focus cuts the floor, where no object hides it."""
    row = floor_row(focal_length, focus)
    return "" if row is None else line_on_floor(lit, row, WIDTH, HEIGHT, enlarged)


def neutral_outside(tiers: Container[str], otherwise: str, tier: str) -> str:
    """Why a stage of ``tiers`` would change nothing."""
    return "" if tier in tiers else otherwise


def neutral_without_blur(
    tiers: Container[str], otherwise: str, largest_blur: float, tier: str
) -> str:
    """Why a blur of ``tiers`` would change nothing. Rays through the lens are sent at any blur."""
    return in_focus(largest_blur) or neutral_outside(tiers, otherwise, tier)


NO_LAYER = partial(neutral_without_blur, ("layered",), "no layer is blurred by itself")
NO_FILTER = partial(neutral_without_blur, FILTERS, "the finished picture is not filtered")
ONE_RAY = partial(neutral_outside, SPIRALS, "every pixel has one ray")
LENS_RAYS = "rays through the lens"
STAGES = (
    Stage("pinhole rays", pinhole_rays),
    Stage("surfaces", find_surfaces, ("pinhole rays",)),
    Stage("light", light_surfaces, ("surfaces",)),
    Stage("defocus", defocus, ("light",), neutral=NO_LAYER),
    Stage("overlay", enlarged_overlay, ("defocus",)),
    Stage("filter", filtered, ("overlay", "light"), neutral=NO_FILTER),
    Stage(LENS_RAYS, rays_through_lens, ("pinhole rays",), neutral=ONE_RAY, passes_on="filter"),
    Stage("encoded", repeated_raster, (LENS_RAYS,)),
    Stage("plane of focus", focus_line, ("light",)),
)


def estimates(
    picture: Raster, rays: Rays, focal_length: float, aperture: float, focus: float
) -> Iterator[Readout]:
    """RMS error against rays through the whole lens, after each ray per pixel.

    The rays form a grid that no tier uses; the wider the widest disc, the finer the grid.
    """
    repeated = len(picture) // len(rays.valid)
    measured = picture[::repeated, ::repeated, :3].astype(np.float32)
    across = math.ceil(1.5 * widest_px(focal_length, aperture, focus))
    points = aperture_grid(min(max(across, FEWEST_ACROSS), MOST_ACROSS))
    total = np.zeros((3, *measured.shape[:2]), np.float32)
    for count, at in enumerate(points, start=1):
        total += through_lens(rays, at, LIGHT_ANGLE_DEG, focal_length, aperture, focus)
        off = measured - encode(np.asarray(total / count, np.float32))[..., :3]
        codes = format_number(root_mean_square(off), 2)
        label = f"RMS error against {count} of {len(points)} rays through the lens"
        yield Readout("error", label, codes, "codes of 255", role="error")
