"""The picture of the still life through a thin lens, by stages that several figures share."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from simulations.engine.controls import Value
from simulations.models.arrays import Floats, Planes
from simulations.models.lens.depth_of_field import blur_by_depth, blur_layer, composite
from simulations.models.lens.disc_pyramid import double
from simulations.models.sampling.magnification import magnify
from simulations.pictures.still_life import things as still_life
from simulations.pictures.still_life.light import LitScene, light
from simulations.pictures.still_life.surfaces import Surface, surfaces
from simulations.scenes._still_life_camera.rays import Rays, blur_px, principal_mm

FARTHEST_M = 10.0
"""Focus of the draft `SCALED`, metres: the end of the slider, so that the picture at any other
focus is an enlarged part of this one."""
SCALED = "scaled"
"""The draft while the focus moves: one sharp picture is blurred anew and enlarged as the lens
breathes. A draft of fewer pixels would look out of focus everywhere."""


SHARP_PX = 0.3
"""Blur is skipped if the widest disc of confusion is at most this many pixels wide. The RMS error
against 37 rays through the lens is then at most half a code of 255, measured at four lenses and
distances; at one pixel it would be up to 2.1 codes. Tiers that send rays through the lens always
send them."""


def drawing_of(draft: bool, focal_length: float, focus: float) -> dict[str, Value]:
    """Parameters of the stages: the focus that the picture is drawn at, and its magnification."""
    drawn = max(FARTHEST_M, focus) if draft else focus
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
    seen = still_life.view_through(rays.directions, rays.valid, place, focus, back)
    return overlay(light(surfaces(seen), light_angle), 1.0)


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
