"""A matte sphere, a light that goes round it, and the brightness of one probed point.

The light and the probed point lie in the horizontal plane through the sphere's centre, at
angles from the camera's direction. The picture holds nothing but ``I = albedo max(0, n . l)``,
computed for every pixel in linear light and then encoded for the screen.
"""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.controls import Slider, Toggle, Values
from simulations.engine.frame import Frame, Panel, Readout, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Stage, StageCache, run
from simulations.models.color.srgb import encode_srgb
from simulations.models.light.reflectance import lambert
from simulations.scenes.reflection import lambertian_drawing as drawing
from simulations.scenes.reflection.ball import (
    DEFAULT_TIER,
    TIER_LABELS,
    TIERS,
    Ball,
    Floats,
    build_ball,
    judge,
    light_direction,
    light_of_pixels,
    lit_normals,
    paint,
    true_cosine,
)

CONTROLS = (
    Slider(
        name="light_angle",
        label="Light angle",
        default=30,
        minimum=-180,
        maximum=180,
        step=1,
        unit="°",
    ),
    Slider(name="albedo", label="Albedo ρ", default=0.8, minimum=0, maximum=1, step=0.01),
    Slider(
        name="probe", label="Probed point", default=0, minimum=-90, maximum=90, step=1, unit="°"
    ),
    Toggle(name="normals", label="Show normals"),
)


def _white(normals: Floats, ball: Ball, light_angle: float) -> Floats:
    """(h, w) linear light of the ball's pixels, were it white."""
    return light_of_pixels(lambert(normals, light_direction(light_angle)), ball)


def _shade(white: Floats, ball: Ball, albedo: float) -> Floats:
    """(h, w) linear light of the ball as painted. Black paint needs no light computed."""
    return np.float32(albedo) * white if albedo > 0 else np.zeros_like(ball.inner, np.float32)


def _black(values: Values) -> str:
    return "black paint returns no light" if values.number("albedo") == 0 else ""


STAGES = (
    Stage("ball", build_ball),
    Stage("normals", lit_normals, ("ball",)),
    Stage("white", _white, ("normals", "ball"), _black),
    Stage("shade", _shade, ("white", "ball")),
    Stage("picture", paint, ("ball", "shade")),
)


def render(values: Values, tier: str, cache: StageCache) -> Frame:
    """The ball, its plan and the curve; the tier is where light is computed on the ball."""
    done = run(STAGES, values, cache, {"tier": tier or DEFAULT_TIER})
    light_rad = math.radians(values.number("light_angle"))
    probe_rad = math.radians(values.number("probe"))
    albedo = values.number("albedo")
    theta_rad = abs(math.remainder(light_rad - probe_rad, 2 * math.pi))
    normal = light_direction(values.number("probe"))
    brightness = float(lambert(normal, light_direction(values.number("light_angle")), albedo))
    code = round(255 * float(encode_srgb(brightness)))
    show_normals = values.toggle("normals")
    overlays = (
        drawing.over_sphere(light_rad, probe_rad, show_normals),
        drawing.from_above(light_rad, probe_rad, theta_rad, show_normals),
        drawing.brightness_plot(albedo, theta_rad, brightness),
    )
    titles = ("What the camera sees", "The equator from above", "Brightness by angle")
    panels = tuple(
        Panel(name, title, drawing.WIDTH, drawing.HEIGHT, raster, overlay)
        for name, title, raster, overlay in zip(
            ("camera", "above", "curve"),
            titles,
            (done.outputs["picture"], None, None),
            overlays,
            strict=True,
        )
    )
    readouts = (
        readout("cosine", "n · l", math.cos(theta_rad), digits=3),
        readout("theta", "Angle θ", math.degrees(theta_rad), "°", digits=0, role="ray"),
        readout("albedo", "Albedo ρ", albedo, role="world"),
        readout("brightness", "I = ρ max(0, n · l)", brightness, digits=3, role="image"),
        readout("code", "Pixel value (sRGB)", code, "of 255", digits=0, role="image"),
    )
    return Frame(panels, readouts, describe(values, theta_rad, code), done.reports)


def error(values: Values, tier: str, cache: StageCache) -> Iterator[Readout]:
    """How far the light of this picture is from Lambert's law in float64; found at once."""
    done = run(STAGES, values, cache, {"tier": tier or DEFAULT_TIER})
    ball: Ball = done.outputs["ball"]
    truth = values.number("albedo") * np.maximum(
        true_cosine(ball, values.number("light_angle")), 0.0
    )
    yield judge(ball, done.outputs["shade"], truth)


def describe(values: Values, theta_rad: float, code: int) -> str:
    """The picture in one sentence."""
    angle = values.number("light_angle")
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
    controls=CONTROLS,
    render=render,
    tiers=TIERS,
    default_tier=DEFAULT_TIER,
    draft_tier=DEFAULT_TIER,
    ladder="shading",
    tier_labels=TIER_LABELS,
    error=error,
)
