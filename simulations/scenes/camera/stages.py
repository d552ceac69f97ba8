"""The complete camera, stage by stage: from rays through the lens to the bytes of a photograph."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.stages import Stage
from simulations.models.arrays import Planes
from simulations.models.lens.aperture import fibonacci_disc
from simulations.models.lens.depth_of_field import blur_by_depth, blur_layer, composite
from simulations.models.lens.disc_pyramid import double
from simulations.models.sampling.magnification import magnify
from simulations.pictures.still_life import light as still_life_light
from simulations.pictures.still_life import surfaces
from simulations.pictures.still_life import things as still_life
from simulations.pictures.still_life.light import LitScene
from simulations.pictures.still_life.surfaces import Surface
from simulations.scenes.camera import lens, sensor
from simulations.scenes.camera.lens import Rays, blur_px


@dataclass(frozen=True, slots=True)
class Accuracy:
    """What a tier sets: parameters that the stages read by these names."""

    reduction: int = 1
    """Pixels per ray each way."""
    bent_rays: bool = False
    """Whether the lens bends the rays, or else the finished picture."""
    lens_rays: int = 0
    """Rays through the lens's opening, in place of a blur; 0 where there is a blur."""


TIERS: Mapping[str, Accuracy] = {
    "draft": Accuracy(reduction=2),
    "layers": Accuracy(),
    "bent-rays": Accuracy(bent_rays=True),
    "aperture-rays": Accuracy(bent_rays=True, lens_rays=12),
}


FARTHEST_M = 10.0
"""Where the draft `SCALED` is drawn in focus: at the end of the slider, so that all other pictures
are part of this one, enlarged."""
SCALED = "scaled"
"""The draft of a moving focus: one picture, drawn sharp, is blurred anew and enlarged as the lens
breathes. A coarser one would look out of focus everywhere."""


BOWED = "bowed"
"""The draft of a moving k₁: one straight picture, drawn with the widest margin that any k₁ of the
slider needs, is bent anew. At rest the margin is that of the lens's own k₁."""


def drawing_of(draft: bool, focal_length: float, focus: float) -> dict[str, Value]:
    """At which focus the picture is drawn, and how much larger it is shown."""
    drawn = max(FARTHEST_M, focus) if draft else focus
    larger = lens.principal_mm(focal_length, focus) / lens.principal_mm(focal_length, drawn)
    return {"drawn_focus": drawn, "enlarged": larger}


def _surfaces(rays: Rays, back: float) -> tuple[Surface, ...]:
    return surfaces.surfaces(still_life.view(rays.directions, rays.valid, back))


def _light(parts: tuple[Surface, ...], light_angle: float) -> LitScene:
    return still_life_light.light(parts, light_angle)


def _defocus(
    lit: LitScene,
    focal_length: float,
    aperture: float,
    focus: float,
    reduction: int,
    enlarged: float,
) -> LitScene:
    per_radius = 2 * reduction * enlarged
    discs = blur_px(focal_length, aperture, focus, lit.base_depth)
    base = blur_by_depth(lit.base, discs / per_radius)
    radii = (blur_px(focal_length, aperture, focus, depth) / per_radius for depth in lit.depths)
    layers = tuple(
        blur_layer(replace(layer, radius_px=float(radius)))
        for layer, radius in zip(lit.layers, radii, strict=True)
    )
    return replace(lit, base=base, layers=layers)


def overlay(lit: LitScene, enlarged: float) -> Planes:
    """All layers as one picture (3, H, W), so much larger."""
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
    return overlay(_light(surfaces.surfaces(seen), light_angle), 1.0)


def _aperture_rays(
    rays: Rays,
    light_angle: float,
    focal_length: float,
    aperture: float,
    focus: float,
    back: float,
    lens_rays: int,
) -> Planes:
    """The mean over the lens's opening: edges that hide less than they seem to, and no layers."""
    setting = (light_angle, focal_length, aperture, focus, back)
    total = np.zeros((3, *rays.valid.shape), np.float32)
    for right, down in fibonacci_disc(lens_rays):
        total += through_lens(rays, (float(right), float(down)), *setting)
    return np.asarray(total / np.float32(lens_rays), np.float32)


def enlarge(overlaid: Planes, reduction: int) -> Planes:
    """A picture (3, h, w) of so many pixels per ray each way, with all its pixels."""
    for _ in range(reduction.bit_length() - 1):
        overlaid = double(overlaid)
    return overlaid


SHARP_PX = 0.3
"""Width of the widest disc of confusion of a picture that is not blurred. Against 37 rays through
the lens such a picture is off by half a code of 255 RMS at most, measured at four lenses and
distances. At a widest disc of one pixel it would be up to 2.1 codes. Tiers that send rays through
the lens never leave them out."""


def in_focus(largest_blur: float) -> str:
    """Why a picture is not blurred, of a lens whose widest disc is so many pixels wide."""
    return f"no disc is wider than {SHARP_PX} px" if largest_blur <= SHARP_PX else ""


def _no_rays(lens_rays: int) -> str:
    return "" if lens_rays else "the blur stands in for rays"


def _no_bending(k1: float, bent_rays: bool) -> str:
    if k1 == 0:
        return "k₁ = 0 bends no ray"
    return "" if bent_rays else "the finished picture is bent instead"


def _no_warp(k1: float, bent_rays: bool) -> str:
    if k1 == 0:
        return "k₁ = 0 bends nothing"
    return "the rays are bent already" if bent_rays else ""


def _no_trim(k1: float, bent_rays: bool) -> str:
    if bent_rays:
        return "the picture has no margin"
    return "" if k1 == 0 else "the lens has fetched what the sensor holds"


def _own_rays(reduction: int) -> str:
    return "each pixel has its own ray" if reduction == 1 else ""


def _no_shot_noise(shot_noise: bool) -> str:
    return "" if shot_noise else "shot noise is switched off"


def _no_read_noise(noise_sigma: float) -> str:
    return "σ = 0 adds nothing" if noise_sigma == 0 else ""


STAGES = (
    Stage("pinhole rays", lens.pinhole_rays),
    Stage("bent rays", lens.bend_rays, ("pinhole rays",), _no_bending),
    Stage("surfaces", _surfaces, ("bent rays",)),
    Stage("light", _light, ("surfaces",)),
    Stage("defocus", _defocus, ("light",), in_focus),
    Stage("overlay", overlay, ("defocus",)),
    Stage("aperture rays", _aperture_rays, ("bent rays",), _no_rays, hands_on="overlay"),
    Stage("enlargement", enlarge, ("aperture rays",), _own_rays),
    Stage("lens map", lens.lens_map, ("pinhole rays",), _no_warp),
    Stage("lens distortion", lens.distort_picture, ("enlargement", "lens map"), _no_warp),
    Stage("trimming", lens.trim, ("lens distortion",), _no_trim),
    Stage("vignetting", sensor.vignette, ("trimming",)),
    Stage("exposure", sensor.expose, ("vignetting",)),
    Stage("grain", sensor.draw_grain),
    Stage("shot noise", sensor.count, ("exposure", "grain"), _no_shot_noise),
    Stage("read noise", sensor.read, ("shot noise", "grain"), _no_read_noise),
    Stage("quantisation", sensor.quantise, ("read noise",)),
    Stage("sRGB", sensor.encode, ("quantisation",)),
    Stage("noiseless picture", sensor.develop_ideal, ("exposure",)),
)
"""The whole camera, in the order of the light."""
