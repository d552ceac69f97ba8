"""A glossy ball: matte colour plus a highlight, by Phong's model or Blinn's variant of it.

Light, camera and the probed point lie in the horizontal plane through the ball's centre, at
angles from the camera's direction. The ball returns its own colour from below the skin and the
lamp's colour from the skin itself, so only the red part of a pixel holds both in full.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import Choice, Slider, Values
from simulations.engine.frame import Frame, Panel, Readout, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Stage, StageCache, run
from simulations.models.light.reflectance import blinn_phong, lambert, phong
from simulations.scenes.reflection import phong_drawing as drawing
from simulations.scenes.reflection.ball import (
    DEFAULT_TIER,
    TIER_LABELS,
    TIERS,
    Ball,
    build_ball,
    judge,
    light_direction,
    light_of_pixels,
    lit_normals,
    paint,
    true_cosine,
    true_normals,
)
from simulations.scenes.reflection.lambertian_drawing import HEIGHT, WIDTH

type Floats = NDArray[np.floating]

ALBEDO = np.array([0.60, 0.06, 0.05], np.float32)
"""Linear RGB of the ball's skin; the plot and the readouts follow red, the first."""
VIEW = (0.0, 0.0, 1.0)
"""Towards the camera, the same for every point: it stands far away."""
MODELS = {"phong": phong, "blinn_phong": blinn_phong}
MODEL_LABELS = {"phong": "Phong (r · v)", "blinn_phong": "Blinn–Phong (n · h)"}

CONTROLS = (
    Slider(
        name="light_angle",
        label="Light angle",
        default=60,
        minimum=-180,
        maximum=180,
        step=1,
        unit="°",
    ),
    Slider(
        name="probe", label="Probed point", default=20, minimum=-90, maximum=90, step=1, unit="°"
    ),
    Slider(name="shininess", label="Shininess α", default=20, minimum=1, maximum=500, step=1),
    Slider(
        name="specular", label="Specular strength kₛ", default=0.6, minimum=0, maximum=1, step=0.05
    ),
    Choice(name="model", label="Model", default="phong", options=MODEL_LABELS),
)


@dataclass(frozen=True, slots=True)
class Angles:
    """Cosines at the probed point, none of them clamped."""

    n_dot_l: float
    r_dot_v: float
    n_dot_h: float
    """nan where light and camera are exactly opposed and there is no halfway direction."""


def angles_at(light_angle: float, probe: float) -> Angles:
    """All directions lie in one plane, so that each cosine is that of a difference of angles."""
    light_rad, normal_rad = math.radians(light_angle), math.radians(probe)
    turn = math.remainder(light_rad, 2 * math.pi)
    opposed = abs(light_angle) == 180
    return Angles(
        math.cos(light_rad - normal_rad),
        math.cos(2 * normal_rad - light_rad),
        math.nan if opposed else math.cos(normal_rad - turn / 2),
    )


def highlight(
    normals: Floats, light_angle: float, view: Floats, model: str, shininess: float
) -> Floats:
    """The second term of the model alone, for a strength of 1."""
    return MODELS[model](
        normals, light_direction(light_angle), view, 0.0, specular=1.0, shininess=shininess
    )


def half_width_rad(model: str, shininess: float) -> float:
    """Turn of the camera, in the plane of n and l, that halves the highlight.

    A turn of the camera turns ``h`` by only half as much, so that Blinn's lobe is twice as wide:
    at a shininess of 1, the least that there is here, 120°.
    """
    half = math.acos(2 ** (-1 / shininess))
    return 2 * half if model == "blinn_phong" else half


def _shine(normals: Floats, ball: Ball, light_angle: float, shininess: float, model: str) -> Floats:
    """(h, w) the highlight, for a strength of 1."""
    return light_of_pixels(highlight(normals, light_angle, np.array(VIEW), model, shininess), ball)


def _matte(normals: Floats, ball: Ball, light_angle: float) -> Floats:
    """(h, w, 3) linear light of the ball without its highlight."""
    cosines = light_of_pixels(lambert(normals, light_direction(light_angle)), ball)
    return cosines[..., None] * ALBEDO


def _add(matte: Floats, shine: Floats, specular: float) -> Floats:
    """(h, w, 3) linear light of both."""
    return matte + np.float32(specular) * shine[..., None]


def _dull(values: Values) -> str:
    """Why the ball has no highlight, if it has none."""
    if values.number("specular") == 0:
        return "a highlight of strength 0 adds nothing"
    opposed = abs(values.number("light_angle")) == 180
    return "from exactly behind, the light makes no highlight" if opposed else ""


STAGES = (
    Stage("ball", build_ball),
    Stage("normals", lit_normals, ("ball",)),
    Stage("matte", _matte, ("normals", "ball")),
    # Where it is left out, so is the sum, and nothing looks at what it hands on.
    Stage("highlight", _shine, ("normals", "ball"), _dull),
    Stage("light", _add, ("matte", "highlight"), _dull),
    Stage("picture", paint, ("ball", "light")),
)


def lobe(values: Values, model: str) -> Floats:
    """Brightness (181,) that cameras at −90°…90° from the normal would see at the probed point."""
    around = np.radians(np.arange(-90.0, 91.0))
    cameras = np.stack([np.sin(around), np.zeros_like(around), np.cos(around)], axis=-1)
    normals = np.broadcast_to(np.array(VIEW), cameras.shape)
    light = values.number("light_angle") - values.number("probe")
    shine = highlight(normals, light, cameras, model, values.number("shininess"))
    matte = float(ALBEDO[0]) * max(0.0, math.cos(math.radians(light)))
    brightness: Floats = matte + values.number("specular") * shine
    return brightness


def render(values: Values, tier: str, cache: StageCache) -> Frame:
    """The ball and the lobe; the tier is where light is computed on the ball."""
    done = run(STAGES, values, cache, {"tier": tier or DEFAULT_TIER})
    model = values.choice("model")
    other = next(name for name in MODELS if name != model)
    light_rad = math.radians(values.number("light_angle"))
    probe_rad = math.radians(values.number("probe"))
    at = angles_at(values.number("light_angle"), values.number("probe"))
    matte, shine = brightness_at(values)
    panels = (
        Panel(
            "camera",
            "What the camera sees",
            WIDTH,
            HEIGHT,
            done.outputs["picture"],
            drawing.over_ball(light_rad, probe_rad),
        ),
        Panel(
            "lobe",
            "At the probed point",
            WIDTH,
            HEIGHT,
            overlay=drawing.lobe_plot(
                light_rad - probe_rad, -probe_rad, lobe(values, model), lobe(values, other), matte
            ),
        ),
    )
    readouts = (
        readout("n_dot_l", "n · l", at.n_dot_l, digits=3, role="light"),
        readout("r_dot_v", "r · v", at.r_dot_v, digits=3, role="ray"),
        readout("n_dot_h", "n · h", at.n_dot_h, digits=3),
        readout("matte", "Matte part", matte, digits=3, role="world"),
        readout("highlight", "Highlight", shine, digits=3, role="ray"),
        readout("brightness", "I, red light", matte + shine, digits=3, role="image"),
        _width(model, values.number("shininess")),
    )
    return Frame(panels, readouts, describe(values, matte, shine), done.reports)


def _width(model: str, shininess: float) -> Readout:
    degrees = math.degrees(half_width_rad(model, shininess))
    return readout("half_width", "Lobe’s half-width", degrees, "°", digits=1, role="ray")


def brightness_at(values: Values) -> tuple[float, float]:
    """Matte part and highlight of the probed point, in red light."""
    normal = light_direction(values.number("probe"))
    light_angle = values.number("light_angle")
    shine = highlight(
        normal,
        light_angle,
        np.array(VIEW),
        values.choice("model"),
        values.number("shininess"),
    )
    matte = lambert(normal, light_direction(light_angle), ALBEDO[0])
    return float(matte), values.number("specular") * float(shine)


def error(values: Values, tier: str, cache: StageCache) -> Iterator[Readout]:
    """How far the red light of this picture is from the chosen formula in float64."""
    done = run(STAGES, values, cache, {"tier": tier or DEFAULT_TIER})
    ball: Ball = done.outputs["ball"]
    yield judge(ball, done.outputs["light"][..., 0], true_light(ball, values))


def true_light(ball: Ball, values: Values) -> NDArray[np.float64]:
    """Red light (h, w): Phong's with the camera mirrored in place of the light, Blinn's by half
    the light's angle.

    Light and camera exactly opposed light nothing that the camera sees.
    """
    angle = values.number("light_angle")
    n_dot_l = true_cosine(ball, angle)
    if values.choice("model") == "phong":
        normals = true_normals(ball)
        lobe = (2 * normals[..., 2:] * normals - np.array(VIEW)) @ light_direction(angle)
    else:
        lobe = true_cosine(ball, angle / 2)
    shine = np.maximum(lobe, 0.0) ** values.number("shininess")
    red = float(ALBEDO[0]) * n_dot_l + values.number("specular") * shine
    return np.where((n_dot_l > 0) & (abs(angle) < 180), red, 0.0)


def describe(values: Values, matte: float, shine: float) -> str:
    """The picture in one sentence."""
    angle = values.number("light_angle")
    if abs(angle) == 180:
        return "A red ball is lit exactly from behind: it is black and has no highlight."
    side = "right" if angle > 0 else "left"
    lamp = f"from {abs(angle):.0f}° to the {side}" if angle else "from the camera"
    where = f"{abs(angle) / 2:.0f}° to the {side}" if angle else "at its centre"
    model = {"phong": "Phong", "blinn_phong": "Blinn–Phong"}[values.choice("model")]
    width = math.degrees(half_width_rad(values.choice("model"), values.number("shininess")))
    spot = (
        f"its {model} highlight lies {where} and has a half-width of {width:.0f}°"
        if values.number("specular") > 0
        else "it has no highlight, since the strength is 0"
    )
    return (
        f"A red ball is lit {lamp}; {spot}. The probed point shows {matte:.2f} of matte light "
        f"and {shine:.2f} of highlight."
    )


SCENE = Scene(
    id="phong",
    title="Phong Reflection",
    controls=CONTROLS,
    render=render,
    tiers=TIERS,
    default_tier=DEFAULT_TIER,
    draft_tier="gouraud-64",
    ladder="shading",
    tier_labels=TIER_LABELS,
    error=error,
)
