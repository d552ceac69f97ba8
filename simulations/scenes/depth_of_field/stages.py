"""The stages of the depth-of-field figure: one picture, blurred in the way of each tier.

The still life and its light are those of the camera simulator. There is no sensor, so that only
the lens softens the picture.
"""

import math
from collections.abc import Callable, Container, Iterator, Mapping
from functools import partial

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.frame import Raster, Readout, format_number
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats, Planes
from simulations.models.color.srgb import encode_srgb_table
from simulations.models.error_measures import root_mean_square
from simulations.models.lens.aperture import fibonacci_disc
from simulations.models.lens.aperture_grid import aperture_grid
from simulations.models.lens.depth_of_field import blur_by_depth
from simulations.models.lens.screen_blur import binned_gaussian, gather_discs
from simulations.pictures.still_life.light import LitScene
from simulations.scenes._still_life_camera.picture import (
    SCALED,
    defocus,
    enlarge,
    find_surfaces,
    in_focus,
    light_surfaces,
    mean_through_lens,
    overlay,
    through_lens,
)
from simulations.scenes._still_life_camera.rays import Rays, blur_px, largest_blur_px, pinhole_rays
from simulations.scenes.depth_of_field.focus_line import focus_line

TIERS = ("pinhole", "discs", "layered", "binned", "gather", "fibonacci-16")
"""Rungs of the ladder `depth-of-field`, without its random rays and without 64 rays, which would
take seconds."""
COARSE = "coarse"
"""The draft while the focal length moves: a ray for four pixels."""
QUICK = "quick"
"""The draft while the aperture moves: a ray for each pixel."""
LAYERED = ("layered", COARSE, QUICK, SCALED)
"""Tiers that blur each layer by itself."""
FILTERS: Mapping[str, Callable[[Planes, Floats, Floats], Planes]] = {
    "discs": lambda sharp, radius, _depth: blur_by_depth(sharp, radius),
    "binned": lambda sharp, radius, _depth: binned_gaussian(sharp, radius),
    "gather": gather_discs,
}
"""Tiers that blur a finished picture (3, H, W), by its radii of discs and its depths (H, W)."""
SPIRALS: Mapping[str, Floats] = {"fibonacci-16": fibonacci_disc(16)}
"""Tiers that send rays through points (n, 2) spread over the lens."""
COSTLY = ("gather", *SPIRALS)
"""Tiers that are drawn with a ray for each pixel, too."""
REDUCTIONS = {COARSE: 2.0, **dict.fromkeys((QUICK, SCALED, *COSTLY), 1.0)}
"""Pixels per ray each way, by tier and draft."""
FINE = 0.5
"""The same of all others: the picture is shown wider than the sensor has pixels."""
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


def widest_px(focal_length: float, aperture: float, focus: float) -> float:
    """The widest disc in the picture of this lens, which has no distortion."""
    return largest_blur_px(focal_length, aperture, focus, k1=0.0)


def depth_of(lit: LitScene) -> Floats:
    """Depth (H, W) of the foremost thing that covers more than half of the pixel, metres."""
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


def _overlay(lit: LitScene, enlarged: float, reduction: float) -> Planes:
    return enlarge(overlay(lit, enlarged), reduction)


def _filter(
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


def _rays(
    rays: Rays, light_angle: float, focal_length: float, aperture: float, focus: float, tier: str
) -> Planes:
    """The mean of pictures through points spread over the lens."""
    return mean_through_lens(rays, SPIRALS[tier], light_angle, focal_length, aperture, focus)


def encode(light: Planes) -> Raster:
    """Canvas bytes of linear light (3, H, W)."""
    return to_rgba8(encode_srgb_table(light.transpose(1, 2, 0)))


def _shown(light: Planes, repeated: int) -> Raster:
    """Canvas bytes, each repeated so many times each way: all tiers show pictures of one size."""
    raster = encode(light)
    return np.ascontiguousarray(raster.repeat(repeated, axis=0).repeat(repeated, axis=1))


def _unless(tiers: Container[str], otherwise: str, tier: str) -> str:
    """Why a stage of ``tiers`` would change nothing."""
    return "" if tier in tiers else otherwise


def _unless_sharp(tiers: Container[str], otherwise: str, largest_blur: float, tier: str) -> str:
    """Why a blur of ``tiers`` would change nothing. Rays through the lens are sent at any blur."""
    return in_focus(largest_blur) or _unless(tiers, otherwise, tier)


STAGES = (
    Stage("pinhole rays", pinhole_rays),
    Stage("surfaces", find_surfaces, ("pinhole rays",)),
    Stage("light", light_surfaces, ("surfaces",)),
    Stage(
        "defocus",
        defocus,
        ("light",),
        partial(_unless_sharp, LAYERED, "no layer is blurred by itself"),
    ),
    Stage("overlay", _overlay, ("defocus",)),
    Stage(
        "filter",
        _filter,
        ("overlay", "light"),
        partial(_unless_sharp, FILTERS, "the finished picture is not filtered"),
    ),
    Stage(
        "rays through the lens",
        _rays,
        ("pinhole rays",),
        partial(_unless, SPIRALS, "every pixel has one ray"),
        passes_on="filter",
    ),
    Stage("encoded", _shown, ("rays through the lens",)),
    Stage("plane of focus", focus_line, ("light",)),
)


def estimates(
    picture: Raster, rays: Rays, focal_length: float, aperture: float, focus: float
) -> Iterator[Readout]:
    """RMS error against rays through the whole lens, after each ray per pixel.

    The rays form a grid that no tier uses; the wider the widest disc, the finer the grid.
    """
    repeated = len(picture) // len(rays.valid)
    shown = picture[::repeated, ::repeated, :3].astype(np.float32)
    across = math.ceil(1.5 * widest_px(focal_length, aperture, focus))
    points = aperture_grid(min(max(across, FEWEST_ACROSS), MOST_ACROSS))
    total = np.zeros((3, *shown.shape[:2]), np.float32)
    for count, at in enumerate(points, start=1):
        total += through_lens(rays, at, LIGHT_ANGLE_DEG, focal_length, aperture, focus)
        off = shown - encode(np.asarray(total / count, np.float32))[..., :3]
        codes = format_number(root_mean_square(off), 2)
        label = f"RMS error against {count} of {len(points)} rays through the lens"
        yield Readout("error", label, codes, "codes of 255", "error")
