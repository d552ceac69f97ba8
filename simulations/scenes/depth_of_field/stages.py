"""The blur of the depth-of-field figure: one picture, and as many ways as there are tiers to it.

The still life and its light are the camera simulator's; its sensor is left out, so that nothing
but the lens can soften the picture.
"""

import math
from collections.abc import Callable, Container, Iterator, Mapping
from dataclasses import replace
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
from simulations.scenes.camera import stages as camera_stages
from simulations.scenes.camera.lens import Rays, blur_px, largest_blur_px
from simulations.scenes.camera.stages import SCALED, enlarge, in_focus, overlay, through_lens

TIERS = ("pinhole", "discs", "layered", "binned", "gather", "fibonacci-16")
"""Rungs of the ladder `depth-of-field`; its random rays are left out, and 64 would take seconds."""
COARSE = "coarse"
"""The draft of a moving focal length: a ray for four pixels."""
LAYERED = ("layered", COARSE, SCALED)
"""Those that blur each layer by itself."""
FILTERS: Mapping[str, Callable[[Planes, Floats, Floats], Planes]] = {
    "discs": lambda sharp, radius, _depth: blur_by_depth(sharp, radius),
    "binned": lambda sharp, radius, _depth: binned_gaussian(sharp, radius),
    "gather": gather_discs,
}
"""Those that blur a finished picture (3, H, W), by the radius (H, W) of its discs and its depth."""
SPIRALS: Mapping[str, Floats] = {"fibonacci-16": fibonacci_disc(16)}
"""Those that look through points (n, 2) spread over the lens."""
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
    """The widest disc in the picture of this lens, which keeps straight lines straight."""
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


def _overlay(lit: LitScene, enlarged: float, reduction: int) -> Planes:
    return enlarge(overlay(lit, enlarged), reduction)


def _filter(
    sharp: Planes, lit: LitScene, focal_length: float, aperture: float, focus: float, tier: str
) -> Planes:
    """The finished picture, blurred by what the depth of each pixel deserves."""
    depth = depth_of(lit)
    return FILTERS[tier](sharp, blur_px(focal_length, aperture, focus, depth) / 2, depth)


def _rays(
    rays: Rays, light_angle: float, focal_length: float, aperture: float, focus: float, tier: str
) -> Planes:
    """The mean of pictures through points spread over the lens."""
    points = SPIRALS[tier]
    setting = (light_angle, focal_length, aperture, focus)
    total = np.zeros((3, *rays.valid.shape), np.float32)
    for right, down in points.tolist():
        total += through_lens(rays, (right, down), *setting)
    return np.asarray(total / np.float32(len(points)), np.float32)


def encode(light: Planes) -> Raster:
    """Canvas bytes of linear light (3, H, W)."""
    return to_rgba8(encode_srgb_table(light.transpose(1, 2, 0)))


def _unless(tiers: Container[str], otherwise: str, tier: str) -> str:
    """Why a stage of ``tiers`` would change nothing."""
    return "" if tier in tiers else otherwise


def _unless_sharp(tiers: Container[str], otherwise: str, largest_blur: float, tier: str) -> str:
    """Why a blur of ``tiers`` would change nothing; rays do without it, however narrow the lens."""
    return in_focus(largest_blur) or _unless(tiers, otherwise, tier)


CAMERA = {stage.name: stage for stage in camera_stages.STAGES}
STAGES = (
    CAMERA["pinhole rays"],
    replace(CAMERA["surfaces"], after=("pinhole rays",)),
    CAMERA["light"],
    replace(
        CAMERA["defocus"], neutral=partial(_unless_sharp, LAYERED, "no layer is blurred by itself")
    ),
    replace(CAMERA["overlay"], compute=_overlay),
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
        hands_on="filter",
    ),
    Stage("encoded", encode, ("rays through the lens",)),
)


def judge(
    picture: Raster, rays: Rays, focal_length: float, aperture: float, focus: float
) -> Iterator[Readout]:
    """RMS against a picture whose every pixel looks through the whole lens, one ray more each step.

    The rays stand on a grid that no tier uses, the finer the wider the widest disc.
    """
    shown = picture[..., :3].astype(np.float32)
    across = math.ceil(1.5 * widest_px(focal_length, aperture, focus))
    points = aperture_grid(min(max(across, FEWEST_ACROSS), MOST_ACROSS))
    total = np.zeros((3, *shown.shape[:2]), np.float32)
    for count, at in enumerate(points, start=1):
        total += through_lens(rays, at, LIGHT_ANGLE_DEG, focal_length, aperture, focus)
        off = shown - encode(np.asarray(total / count, np.float32))[..., :3]
        codes = format_number(root_mean_square(off), 2)
        label = f"RMS error against {count} of {len(points)} rays through the lens"
        yield Readout("error", label, codes, "codes of 255", "error")
