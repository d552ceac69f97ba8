"""The complete camera, stage by stage: from rays through the lens to the bytes of a photograph."""

from collections.abc import Mapping
from dataclasses import dataclass

from simulations.engine.stages import Stage
from simulations.models.arrays import Planes
from simulations.models.lens.aperture import fibonacci_disc
from simulations.scenes._still_life_camera.picture import (
    defocus,
    enlarge,
    find_surfaces,
    in_focus,
    light_surfaces,
    mean_through_lens,
    overlay,
)
from simulations.scenes._still_life_camera.rays import Rays, pinhole_rays
from simulations.scenes.camera import lens, sensor


@dataclass(frozen=True, slots=True)
class Accuracy:
    """The parameters of the stages that a tier sets."""

    reduction: int = 1
    """Pixels per ray each way."""
    bent_rays: bool = False
    """Whether the rays are bent, or the finished picture."""
    lens_rays: int = 0
    """Rays through the lens's opening instead of a blur; 0 for a blur."""


TIERS: Mapping[str, Accuracy] = {
    "draft": Accuracy(reduction=2),
    "layers": Accuracy(),
    "bent-rays": Accuracy(bent_rays=True),
    "aperture-rays": Accuracy(bent_rays=True, lens_rays=12),
}


BOWED = "bowed"
"""The draft while k₁ moves: one straight picture, drawn with the widest margin that any k₁ of the
slider needs, is bent anew. At rest the margin is that of the present k₁."""


def _aperture_rays(
    rays: Rays,
    light_angle: float,
    focal_length: float,
    aperture: float,
    focus: float,
    back: float,
    lens_rays: int,
) -> Planes:
    """The mean over ``lens_rays`` points of the lens's opening."""
    points = fibonacci_disc(lens_rays)
    return mean_through_lens(rays, points, light_angle, focal_length, aperture, focus, back)


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
    Stage("pinhole rays", pinhole_rays),
    Stage("bent rays", lens.bend_rays, ("pinhole rays",), _no_bending),
    Stage("surfaces", find_surfaces, ("bent rays",)),
    Stage("light", light_surfaces, ("surfaces",)),
    Stage("defocus", defocus, ("light",), in_focus),
    Stage("overlay", overlay, ("defocus",)),
    Stage("aperture rays", _aperture_rays, ("bent rays",), _no_rays, passes_on="overlay"),
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
