"""The complete camera, stage by stage: from rays through the lens to the bytes of a photograph."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from simulations.engine.controls import Value, Values
from simulations.engine.stages import Stage
from simulations.models.lens.aperture import fibonacci_disc
from simulations.models.lens.depth_of_field import blur_by_depth, blur_layer, composite
from simulations.models.lens.disc_blur import Planes
from simulations.models.lens.disc_pyramid import double
from simulations.pictures.still_life import light as still_life_light
from simulations.pictures.still_life import surfaces
from simulations.pictures.still_life import things as still_life
from simulations.pictures.still_life.light import LitScene
from simulations.pictures.still_life.surfaces import Surface
from simulations.scenes.camera import lens, sensor
from simulations.scenes.camera.lens import Rays, blur_px, largest_blur_px, margin_px

TIERS: Mapping[str, Mapping[str, int]] = {
    "draft": {"reduction": 2, "bent_rays": 0, "lens_rays": 0},
    "layers": {"reduction": 1, "bent_rays": 0, "lens_rays": 0},
    "bent-rays": {"reduction": 1, "bent_rays": 1, "lens_rays": 0},
    "aperture-rays": {"reduction": 1, "bent_rays": 1, "lens_rays": 12},
}
"""Tier to the parameters that it sets: pixels per ray each way, whether the lens bends rays (1) or
the finished picture (0), and rays through the lens's opening in place of a blur (0: blur)."""


def parameters(values: Values, tier: str) -> Mapping[str, Value]:
    """What the stages read besides the controls: set by the tier, or worked out."""
    set_by_tier = TIERS[tier]
    across, down = (0, 0) if set_by_tier["bent_rays"] else margin_px(values)
    return {**set_by_tier, "margin_columns": across, "margin_rows": down}


def _surfaces(rays: Rays) -> tuple[Surface, ...]:
    return surfaces.surfaces(still_life.view(rays.directions, rays.valid))


def _light(parts: tuple[Surface, ...], light_angle: float) -> LitScene:
    return still_life_light.light(parts, light_angle)


def _defocus(
    lit: LitScene, focal_length: float, aperture: float, focus: float, reduction: int
) -> LitScene:
    per_radius = 2 * reduction
    discs = blur_px(focal_length, aperture, focus, lit.base_depth)
    base = blur_by_depth(lit.base, discs / per_radius)
    radii = (blur_px(focal_length, aperture, focus, depth) / per_radius for depth in lit.depths)
    layers = tuple(
        blur_layer(replace(layer, radius_px=float(radius)))
        for layer, radius in zip(lit.layers, radii, strict=True)
    )
    return replace(lit, base=base, layers=layers)


def _overlay(lit: LitScene) -> Planes:
    return composite(lit.base, lit.layers)


def through_lens(
    rays: Rays,
    at: tuple[float, float],
    light_angle: float,
    focal_length: float,
    aperture: float,
    focus: float,
) -> Planes:
    """The picture seen through one point of the lens: ``at`` = (right, down) in the unit disc."""
    radius = focal_length / aperture / 2000.0  # metres
    place = (radius * at[0], radius * at[1])
    seen = still_life.view_through(rays.directions, rays.valid, place, focus)
    return _overlay(_light(surfaces.surfaces(seen), light_angle))


def _aperture_rays(
    rays: Rays,
    light_angle: float,
    focal_length: float,
    aperture: float,
    focus: float,
    lens_rays: int,
) -> Planes:
    """The mean over the lens's opening: edges that hide less than they seem to, and no layers."""
    setting = (light_angle, focal_length, aperture, focus)
    total = np.zeros((3, *rays.valid.shape), np.float32)
    for right, down in fibonacci_disc(lens_rays):
        total += through_lens(rays, (float(right), float(down)), *setting)
    return np.asarray(total / np.float32(lens_rays), np.float32)


def _enlarge(overlaid: Planes, reduction: int) -> Planes:
    for _ in range(reduction.bit_length() - 1):
        overlaid = double(overlaid)
    return overlaid


def _in_focus(values: Values) -> str:
    largest = largest_blur_px(values)
    return "every circle of confusion is under a pixel" if largest <= 1.0 else ""


def _no_rays(values: Values) -> str:
    return _in_focus(values) or ("" if values["lens_rays"] else "the blur stands in for rays")


def _no_bending(values: Values) -> str:
    if values.number("k1") == 0:
        return "k₁ = 0 bends no ray"
    return "" if values["bent_rays"] else "the finished picture is bent instead"


def _no_warp(values: Values) -> str:
    if values.number("k1") == 0:
        return "k₁ = 0 bends nothing"
    return "the rays are bent already" if values["bent_rays"] else ""


def _no_trim(values: Values) -> str:
    if values["bent_rays"]:
        return "the picture has no margin"
    return "" if values.number("k1") == 0 else "the lens has fetched what the sensor holds"


STAGES = (
    Stage(
        "pinhole rays",
        lens.pinhole_rays,
    ),
    Stage("bent rays", lens.bend_rays, ("pinhole rays",), _no_bending),
    Stage("surfaces", _surfaces, ("bent rays",)),
    Stage("light", _light, ("surfaces",)),
    Stage(
        "defocus",
        _defocus,
        ("light",),
        _in_focus,
    ),
    Stage("overlay", _overlay, ("defocus",)),
    Stage(
        "aperture rays",
        _aperture_rays,
        ("bent rays",),
        _no_rays,
        hands_on="overlay",
    ),
    Stage(
        "enlargement",
        _enlarge,
        ("aperture rays",),
        lambda values: "" if values["reduction"] != 1 else "each pixel has its own ray",
    ),
    Stage(
        "lens map",
        lens.lens_map,
        ("pinhole rays",),
        _no_warp,
    ),
    Stage("lens distortion", lens.distort_picture, ("enlargement", "lens map"), _no_warp),
    Stage(
        "trimming",
        lens.trim,
        ("lens distortion",),
        _no_trim,
    ),
    Stage("vignetting", sensor.vignette, ("trimming",)),
    Stage("exposure", sensor.expose, ("vignetting",)),
    Stage("grain", sensor.draw_grain),
    Stage(
        "shot noise",
        sensor.count,
        ("exposure", "grain"),
        lambda values: "" if values.toggle("shot_noise") else "shot noise is switched off",
    ),
    Stage(
        "read noise",
        sensor.read,
        ("shot noise", "grain"),
        lambda values: "σ = 0 adds nothing" if values.number("noise_sigma") == 0 else "",
    ),
    Stage("quantisation", sensor.quantise, ("read noise",)),
    Stage("sRGB", sensor.encode, ("quantisation",)),
    Stage("noiseless picture", sensor.develop_ideal, ("exposure",)),
)
"""The whole camera, in the order of the light."""
