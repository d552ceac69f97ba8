"""A matte sphere, a light that circles it, and the brightness of one probed point.

The light and the probed point are in the horizontal plane through the sphere's centre, at angles
from the camera's direction. The picture is ``I = albedo max(0, n . l)`` for every pixel in linear
light, encoded for the screen.
"""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.frame import Frame, Panel, Readout, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.light.reflectance import lambert
from simulations.scenes._ball.ball import (
    DEFAULT_TIER,
    LIT,
    TIER_LABELS,
    Ball,
    build_ball,
    camera_panel,
    light_direction,
    light_of_pixels,
    lit_normals,
    paint,
    rms_error,
    true_cosine,
)
from simulations.scenes._ball.marks import HEIGHT, WIDTH
from simulations.scenes.lambertian_shading.brightness_plot import brightness_plot
from simulations.scenes.lambertian_shading.drawing import from_above, over_sphere
from simulations.scenes.lambertian_shading.handles import HANDLES
from simulations.scenes.lambertian_shading.settings import Settings


def _white(normals: Floats, ball: Ball, light_angle: float) -> Floats:
    """(h, w) linear light of the ball's pixels, were it white."""
    return light_of_pixels(lambert(normals, light_direction(light_angle)), ball)


def _shade(white: Floats, ball: Ball, albedo: float) -> Floats:
    """(h, w) linear light of the ball as painted. Black paint needs no computation."""
    return np.float32(albedo) * white if albedo > 0 else np.zeros_like(ball.inner, np.float32)


def _black(albedo: float) -> str:
    return "black paint returns no light" if albedo == 0 else ""


STAGES = (
    Stage("ball", build_ball),
    Stage("normals", lit_normals, ("ball",)),
    Stage("white", _white, ("normals", "ball"), _black),
    Stage("shade", _shade, ("white", "ball")),
    Stage("picture", paint, ("ball", "shade")),
)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The ball, its plan and the curve."""
    light_angle, probe, albedo = settings.light_angle, settings.probe, settings.albedo
    light_rad, probe_rad = math.radians(light_angle), math.radians(probe)
    theta_rad = abs(math.remainder(light_rad - probe_rad, 2 * math.pi))
    brightness = float(lambert(light_direction(probe), light_direction(light_angle), albedo))
    code = round(255 * float(encode_srgb(brightness)))
    return Frame(
        panels=(
            camera_panel(outputs["picture"], over_sphere(light_rad, probe_rad, settings.normals)),
            Panel(
                "above",
                "The equator from above",
                WIDTH,
                HEIGHT,
                overlay=from_above(light_rad, probe_rad, theta_rad, settings.normals),
            ),
            Panel(
                "curve",
                "Brightness by angle",
                WIDTH,
                HEIGHT,
                overlay=brightness_plot(albedo, theta_rad, brightness),
            ),
        ),
        readouts=(
            readout("theta", "Angle θ", math.degrees(theta_rad), "°", digits=0, role="ray"),
            readout("cosine", "cos θ = n · l", math.cos(theta_rad), digits=3),
            readout("brightness", "Brightness I", brightness, digits=3, role="image"),
            readout("code", "Pixel value (sRGB)", code, "of 255", digits=0, role="image"),
        ),
        description=describe(light_angle, theta_rad, code),
    )


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """Error of the picture against Lambert's law in float64, in one step."""
    ball: Ball = outputs["ball"]
    truth = settings.albedo * np.maximum(true_cosine(ball, settings.light_angle), 0.0)
    yield rms_error(ball, outputs["shade"], truth)


def describe(angle: float, theta_rad: float, code: int) -> str:
    """The picture in one sentence."""
    side = "right" if angle > 0 else "left"
    facing = abs(angle)
    if facing < 5:
        light = "from the camera, so that the whole visible half is lit"
    elif facing > 175:
        light = "from behind, so that the visible half is dark"
    else:
        share = round(50 * (1 + math.cos(math.radians(angle))))
        light = f"from {facing:.0f}° to the {side}, so that {share}\u00a0% of the disc is lit"
    theta = math.degrees(theta_rad)
    point = (
        f"makes {theta:.0f}° with the light, and its pixel value is {code}"
        if theta < 90
        else f"is turned {theta:.0f}° from the light, so that it is black"
    )
    return f"A matte sphere is lit {light}; the normal at the probed point {point}."


SCENE = Scene(
    id="lambertian-shading",
    title="Lambertian Shading",
    settings=Settings,
    draw=draw,
    formula=lambert,
    stages=STAGES,
    handles=HANDLES,
    tiers=tuple(LIT),
    default_tier=DEFAULT_TIER,
    ladder="shading",
    tier_labels=TIER_LABELS,
    estimate=estimate,
)
