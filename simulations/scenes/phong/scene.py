"""A glazed vase: matte colour plus a highlight, by Phong's model or Blinn's variant of it.

The matte part has the vase's colour and the highlight the lamp's, so only the red part of a pixel
has both in full. Light, camera and the probed point are in the horizontal plane through the vase's
widest circle, at angles from the camera's direction.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.accuracy import Accuracy
from simulations.engine.frame import Frame, Panel, Readout, readout
from simulations.engine.handles import Handle
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.light.reflectance import blinn_phong, lambert, phong
from simulations.scenes import _ball
from simulations.scenes._ball import HEIGHT, WIDTH, Body, light_direction, true_cosine
from simulations.scenes.phong import drawing

ALBEDO = np.array([0.60, 0.06, 0.05], np.float32)
"""Linear RGB of the vase's glaze; the plot and the readouts follow red, the first."""
VIEW = np.array([0.0, 0.0, 1.0])
"""Unit vector towards the camera, which is far away: the same for every point."""


@dataclass(frozen=True, slots=True)
class Model:
    """A model of a highlight as a power of a cosine."""

    name: str
    cosine: str  # the cosine, in the letters of the plot
    light: Callable[..., Floats]
    turn: float  # turn of the camera per increase of the cosine's angle
    true_cosine: Callable[[Body, float], Floats]
    """Computes the cosine (h, w) in float64, for the angle of a light."""


def mirrored_camera(body: Body, light_angle: float) -> Floats:
    """r · v, with the camera mirrored in place of the light."""
    normals = _ball.true_normals(body)
    return (2 * normals[..., 2:] * normals - VIEW) @ light_direction(light_angle)


MODELS: Mapping[str, Model] = {
    "phong": Model("Phong", "r · v", phong, 1, mirrored_camera),
    "blinn_phong": Model(  # h is at half the light's angle
        "Blinn–Phong", "n · h", blinn_phong, 2, lambda body, angle: true_cosine(body, angle / 2)
    ),
}


@dataclass(frozen=True, slots=True)
class Settings:
    light_angle: float = slider("Light angle", 60, -180, 180, 1, unit="°", arrival=-60)
    probe: float = slider("Probed point", 20, -90, 90, 1, unit="°")
    shininess: float = slider("Shininess α", 20, 1, 500, 1)
    specular: float = slider("Specular strength kₛ", 0.6, 0, 1, 0.05)
    model: str = choice(
        "Model", {name: f"{model.name} ({model.cosine})" for name, model in MODELS.items()}
    )


def highlight(
    normals: Floats, light_angle: float, view: Floats, model: str, shininess: float
) -> Floats:
    """The second term of the model alone, for a strength of 1."""
    return MODELS[model].light(
        normals, light_direction(light_angle), view, 0.0, specular=1.0, shininess=shininess
    )


def matte_light(normals: Floats, body: Body, light_angle: float) -> Floats:
    """(3, h, w) linear light of the vase without its highlight."""
    cosines = _ball.light_of_pixels(lambert(normals, light_direction(light_angle)), body)
    return np.multiply.outer(ALBEDO, cosines)


def shine(normals: Floats, body: Body, light_angle: float, shininess: float, model: str) -> Floats:
    """(h, w) the highlight, for a strength of 1."""
    return _ball.light_of_pixels(highlight(normals, light_angle, VIEW, model, shininess), body)


def add(matte: Floats, shine: Floats, specular: float) -> Floats:
    """(3, h, w) linear light of both."""
    return matte + np.float32(specular) * shine


def no_highlight(specular: float, light_angle: float) -> str:
    """Why the vase has no highlight, if it has none."""
    if specular == 0:
        return "a highlight of strength 0 adds nothing"
    opposed = abs(light_angle) == 180
    return "from exactly behind, the light makes no highlight" if opposed else ""


STAGES = (
    Stage("body", _ball.build_vase),
    Stage("normals", _ball.lit_normals, ("body",)),
    Stage("matte", matte_light, ("normals", "body")),
    # If it is skipped, so is the sum, and its output is not used.
    Stage("highlight", shine, ("normals", "body"), neutral=no_highlight),
    Stage("light", add, ("matte", "highlight"), neutral=no_highlight),
    Stage("picture", _ball.paint, ("body", "light")),
)


def true_light(
    body: Body, light_angle: float, model: str, shininess: float, specular: float
) -> NDArray[np.float64]:
    """Red light (h, w) in float64.

    If light and camera are exactly opposed, no visible point is lit.
    """
    n_dot_l = true_cosine(body, light_angle)
    cosine = MODELS[model].true_cosine(body, light_angle)
    red = float(ALBEDO[0]) * n_dot_l + specular * np.maximum(cosine, 0.0) ** shininess
    return np.where((n_dot_l > 0) & (abs(light_angle) < 180), red, 0.0)


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """Error of the red light of this picture against the chosen formula in float64."""
    body, model = outputs["body"], settings.model
    truth = true_light(body, settings.light_angle, model, settings.shininess, settings.specular)
    yield _ball.rms_error(body, outputs["light"][0], truth)


def half_width_rad(model: str, shininess: float) -> float:
    """Turn of the camera, in the plane of n and l, that halves the highlight.

    A turn of the camera turns ``h`` by only half as much, so that Blinn's lobe is twice as wide:
    at a shininess of 1, the least that there is here, 120°.
    """
    return MODELS[model].turn * math.acos(2 ** (-1 / shininess))


def fading(model: str, shininess: float, turn_rad: Floats) -> Floats:
    """The highlight (...) as a share of its middle, to a camera that turns away in the plane of n
    and l, by less than a right angle."""
    return np.cos(turn_rad / MODELS[model].turn) ** shininess


def lobe(light: float, model: str, shininess: float, specular: float) -> Floats:
    """Brightness (181,) that cameras at −90°…90° from the normal would see at a point.

    ``light`` is its angle from the normal, too.
    """
    around = np.radians(np.arange(-90.0, 91.0))
    cameras = np.stack([np.sin(around), np.zeros_like(around), np.cos(around)], axis=-1)
    normals = np.broadcast_to(VIEW, cameras.shape)
    shine = highlight(normals, light, cameras, model, shininess)
    matte = float(ALBEDO[0]) * max(0.0, math.cos(math.radians(light)))
    return matte + specular * shine


def cosines_at(light_angle: float, probe: float) -> tuple[float, float, float]:
    """n · l, r · v and n · h at the probed point, none of them clamped. All directions are in one
    plane, so that each cosine is that of a difference of angles. The last is nan if light and
    camera are exactly opposed, without a halfway direction."""
    light_rad, normal_rad = math.radians(light_angle), math.radians(probe)
    halfway = math.remainder(light_rad, 2 * math.pi) / 2
    return (
        math.cos(light_rad - normal_rad),
        math.cos(2 * normal_rad - light_rad),
        math.nan if abs(light_angle) == 180 else math.cos(normal_rad - halfway),
    )


def half_place(settings: Settings, _outputs: Outputs) -> tuple[float, float] | None:
    """The place in the plot at which the highlight has half its strength; None if it is wider."""
    half_deg = math.degrees(half_width_rad(settings.model, settings.shininess))
    return drawing.PLOT.at(half_deg, 0.5) if half_deg <= drawing.PLOT.x.high else None


def draw(settings: Settings, outputs: Outputs) -> Frame:
    light_angle, probe, shininess = settings.light_angle, settings.probe, settings.shininess
    light_rad, probe_rad = math.radians(light_angle), math.radians(probe)
    n_dot_l, r_dot_v, n_dot_h = cosines_at(light_angle, probe)
    # Matte part and highlight of the probed point, in red light.
    normal, model = light_direction(probe), settings.model
    matte = float(lambert(normal, light_direction(light_angle), ALBEDO[0]))
    shine = settings.specular * float(highlight(normal, light_angle, VIEW, model, shininess))
    chosen, other = sorted(MODELS, key=lambda name: name != model)
    lobes = (
        lobe(light_angle - probe, chosen, shininess, settings.specular),
        lobe(light_angle - probe, other, shininess, settings.specular),
    )
    turns = np.radians(drawing.DEGREES)
    fadings = fading(chosen, shininess, turns), fading(other, shininess, turns)
    names = MODELS[chosen].name, MODELS[other].name
    directions = drawing.lobe_plot(light_rad - probe_rad, -probe_rad, lobes, matte, names)
    widths = drawing.width_plot(names, fadings, half_place(settings, outputs))
    width_deg = math.degrees(half_width_rad(model, shininess))
    return Frame(
        (
            _ball.camera_panel(outputs["picture"], drawing.over_vase(light_rad, probe_rad)),
            Panel("lobe", "Brightness by direction", WIDTH, HEIGHT, overlay=directions),
            Panel("width", "Width of the highlight", WIDTH, HEIGHT, overlay=widths),
        ),
        (
            readout("n_dot_l", "n · l", n_dot_l, digits=3, role="light"),
            readout("r_dot_v", "r · v", r_dot_v, digits=3, role="ray"),
            readout("n_dot_h", "n · h", n_dot_h, digits=3),
            readout("matte", "Matte part", matte, digits=3, role="world"),
            readout("highlight", "Highlight", shine, digits=3, role="ray"),
            readout("brightness", "Brightness I (red)", matte + shine, digits=3, role="image"),
            readout("half_width", "Half-width of the lobe", width_deg, "°", digits=1, role="ray"),
        ),
        describe(settings, matte, shine, width_deg),
    )


def describe(settings: Settings, matte: float, shine: float, width_deg: float) -> str:
    angle = settings.light_angle
    if abs(angle) == 180:
        return "A red vase is lit exactly from behind: it is black and has no highlight."
    side = "right" if angle > 0 else "left"
    lamp = f"from {abs(angle):.0f}° to the {side}" if angle else "from the camera"
    where = f"{abs(angle) / 2:.0f}° to the {side}" if angle else "at the middle"
    spot = (
        f"its {MODELS[settings.model].name} highlight lies {where} and has a half-width of "
        f"{width_deg:.0f}°"
        if settings.specular > 0
        else "it has no highlight, since the strength is 0"
    )
    return (
        f"A red vase is lit {lamp}; {spot}. The probed point shows {matte:.2f} of matte light "
        f"and {shine:.2f} of highlight."
    )


def highlight_at(settings: Settings, _outputs: Outputs) -> tuple[float, float] | None:
    opposed = abs(settings.light_angle) == 180
    return None if opposed else drawing.highlight_grip(math.radians(settings.light_angle))


def lamp_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return drawing.lamp_place(math.radians(settings.light_angle - settings.probe))


def camera_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return drawing.towards(math.radians(-settings.probe), drawing.VECTOR)


LIGHT_ANGLE, PROBE, SHININESS = ("light_angle",), ("probe",), ("shininess",)
HANDLES: tuple[Handle[Settings], ...] = (
    Handle("highlight", "camera", "Highlight", LIGHT_ANGLE, highlight_at, role="ray"),
    _ball.probe_on_ball("world"),
    Handle("lamp", "lobe", "Lamp", LIGHT_ANGLE, lamp_at, role="light"),
    Handle(  # the camera is fixed; the point turns with its normal
        "camera", "lobe", "Camera", drives=PROBE, at=camera_at, role="camera", reversed=PROBE
    ),
    Handle(
        "width",
        "width",
        "Width of the highlight",
        drives=SHININESS,
        at=half_place,
        role="ray",
        reversed=SHININESS,
    ),
)
SCENE = Scene(
    "phong",
    "Phong Reflection",
    Settings,
    draw,
    STAGES,
    HANDLES,
    accuracy=Accuracy(
        levels=_ball.LEVELS, default=_ball.DEFAULT_TIER, ladder="shading", estimate=estimate
    ),
    formula=phong,
)
