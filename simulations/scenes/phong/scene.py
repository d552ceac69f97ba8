"""A glossy ball: matte colour plus a highlight, by Phong's model or Blinn's variant of it.

The matte part has the ball's colour and the highlight the lamp's, so only the red part of a pixel
has both in full.
"""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.frame import Frame, Panel, Readout, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.light.reflectance import lambert, phong
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
)
from simulations.scenes._ball.marks import HEIGHT, WIDTH
from simulations.scenes.phong.drawing import lobe_plot, over_ball
from simulations.scenes.phong.gloss import (
    ALBEDO,
    MODELS,
    VIEW,
    angles_at,
    brightness_at,
    half_width_rad,
    highlight,
    lobe,
    true_light,
)
from simulations.scenes.phong.handles import HANDLES
from simulations.scenes.phong.settings import Settings
from simulations.scenes.phong.width import width_plot


def _matte(normals: Floats, ball: Ball, light_angle: float) -> Floats:
    """(h, w, 3) linear light of the ball without its highlight."""
    cosines = light_of_pixels(lambert(normals, light_direction(light_angle)), ball)
    return cosines[..., None] * ALBEDO


def _shine(normals: Floats, ball: Ball, light_angle: float, shininess: float, model: str) -> Floats:
    """(h, w) the highlight, for a strength of 1."""
    return light_of_pixels(highlight(normals, light_angle, np.array(VIEW), model, shininess), ball)


def _add(matte: Floats, shine: Floats, specular: float) -> Floats:
    """(h, w, 3) linear light of both."""
    return matte + np.float32(specular) * shine[..., None]


def _dull(specular: float, light_angle: float) -> str:
    """Why the ball has no highlight, if it has none."""
    if specular == 0:
        return "a highlight of strength 0 adds nothing"
    opposed = abs(light_angle) == 180
    return "from exactly behind, the light makes no highlight" if opposed else ""


STAGES = (
    Stage("ball", build_ball),
    Stage("normals", lit_normals, ("ball",)),
    Stage("matte", _matte, ("normals", "ball")),
    # If it is skipped, so is the sum, and its output is not used.
    Stage("highlight", _shine, ("normals", "ball"), _dull),
    Stage("light", _add, ("matte", "highlight"), _dull),
    Stage("picture", paint, ("ball", "light")),
)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The ball, the lobe, and the width of the highlight."""
    light_angle, probe, model = settings.light_angle, settings.probe, settings.model
    shininess, specular = settings.shininess, settings.specular
    at = angles_at(light_angle, probe)
    matte, shine = brightness_at(light_angle, probe, model, shininess, specular)
    width_deg = math.degrees(half_width_rad(model, shininess))
    return Frame(
        panels=(
            camera_panel(
                outputs["picture"], over_ball(math.radians(light_angle), math.radians(probe))
            ),
            Panel(
                "lobe",
                "Brightness by direction",
                WIDTH,
                HEIGHT,
                overlay=lobes(settings, matte),
            ),
            Panel(
                "width",
                "Width of the highlight",
                WIDTH,
                HEIGHT,
                overlay=width_plot(model, shininess),
            ),
        ),
        readouts=(
            readout("n_dot_l", "n · l", at.n_dot_l, digits=3, role="light"),
            readout("r_dot_v", "r · v", at.r_dot_v, digits=3, role="ray"),
            readout("n_dot_h", "n · h", at.n_dot_h, digits=3),
            readout("matte", "Matte part", matte, digits=3, role="world"),
            readout("highlight", "Highlight", shine, digits=3, role="ray"),
            readout("brightness", "Brightness I (red)", matte + shine, digits=3, role="image"),
            readout("half_width", "Half-width of the lobe", width_deg, "°", digits=1, role="ray"),
        ),
        description=describe(settings, matte, shine),
    )


def lobes(settings: Settings, matte: float) -> str:
    """The lobe of the chosen model, and that of the other one."""
    light_rad, probe_rad = math.radians(settings.light_angle), math.radians(settings.probe)
    other = next(name for name in MODELS if name != settings.model)
    chosen, other_lobe = (
        lobe(settings.light_angle - settings.probe, name, settings.shininess, settings.specular)
        for name in (settings.model, other)
    )
    return lobe_plot(light_rad - probe_rad, -probe_rad, chosen, other_lobe, matte, settings.model)


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """Error of the red light of this picture against the chosen formula in float64."""
    ball: Ball = outputs["ball"]
    truth = true_light(
        ball, settings.light_angle, settings.model, settings.shininess, settings.specular
    )
    yield rms_error(ball, outputs["light"][..., 0], truth)


def describe(settings: Settings, matte: float, shine: float) -> str:
    """The picture in one sentence."""
    angle = settings.light_angle
    if abs(angle) == 180:
        return "A red ball is lit exactly from behind: it is black and has no highlight."
    side = "right" if angle > 0 else "left"
    lamp = f"from {abs(angle):.0f}° to the {side}" if angle else "from the camera"
    where = f"{abs(angle) / 2:.0f}° to the {side}" if angle else "at its centre"
    model = MODELS[settings.model].name
    width = math.degrees(half_width_rad(settings.model, settings.shininess))
    spot = (
        f"its {model} highlight lies {where} and has a half-width of {width:.0f}°"
        if settings.specular > 0
        else "it has no highlight, since the strength is 0"
    )
    return (
        f"A red ball is lit {lamp}; {spot}. The probed point shows {matte:.2f} of matte light "
        f"and {shine:.2f} of highlight."
    )


SCENE = Scene(
    id="phong",
    title="Phong Reflection",
    settings=Settings,
    draw=draw,
    formula=phong,
    stages=STAGES,
    handles=HANDLES,
    tiers=tuple(LIT),
    default_tier=DEFAULT_TIER,
    draft_tier="gouraud-64",
    ladder="shading",
    tier_labels=TIER_LABELS,
    estimate=estimate,
)
