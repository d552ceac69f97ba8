"""Reflection at a point of a surface: four models, their lobes, and their energy.

For each it shows whether more light is reflected than arrives, and whether the BRDF is reciprocal.
The computation is in `simulations.scenes.brdf.stages`.
"""

import math

from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.light.brdf import reflected
from simulations.scenes._ball.marks import HEIGHT, WIDTH
from simulations.scenes.brdf.energy import energy_plot
from simulations.scenes.brdf.handles import HANDLES
from simulations.scenes.brdf.lobe import lobe_plot
from simulations.scenes.brdf.materials import marks
from simulations.scenes.brdf.settings import MODELS, Settings
from simulations.scenes.brdf.stages import STAGES, Exchange

EQUAL = 1e-6
"""Relative difference up to which two directions count as equal."""


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The material, its lobe, and the reflected share."""
    exchange: Exchange = outputs["exchange"]
    light, view = settings.light_angle, settings.view_angle
    seen = math.pi * math.cos(math.radians(light)) * exchange.there
    smooth = settings.specular if settings.model == "microfacets" else None
    energy = energy_plot(outputs["sent back"], abs(light), exchange.sent, smooth)
    return Frame(
        panels=(
            Panel(
                "camera",
                "The material",
                WIDTH,
                HEIGHT,
                outputs["picture"],
                marks(view, settings.roughness, settings.specular),
                lead=True,
            ),
            Panel(
                "lobe",
                "Where the light goes",
                WIDTH,
                HEIGHT,
                overlay=lobe_plot(light, view, outputs["lobe"], seen),
            ),
            Panel("energy", "How much is reflected", WIDTH, HEIGHT, overlay=energy),
        ),
        readouts=_readouts(exchange, seen),
        description=describe(settings, exchange, seen),
    )


def _readouts(exchange: Exchange, seen: float) -> tuple[Readout, ...]:
    return (
        readout("there", "BRDF, light to camera", exchange.there, "1/sr", digits=3, role="ray"),
        readout("back", "BRDF, camera to light", exchange.back, "1/sr", digits=3, role="camera"),
        readout("seen", "Brightness seen", seen, digits=3, role="image"),
        readout("sent", "Total reflected", exchange.sent, "of the light", digits=3, role="light"),
        Readout("reciprocal", "Reciprocal", "yes" if _alike(exchange) else "no"),
    )


def _alike(exchange: Exchange) -> bool:
    return math.isclose(exchange.there, exchange.back, rel_tol=EQUAL)


def describe(settings: Settings, exchange: Exchange, seen: float) -> str:
    """The picture in one sentence."""
    name = MODELS[settings.model].replace(" (Lambert)", "").lower().replace("phong", "Phong")
    sides = "the same side" if settings.light_angle * settings.view_angle > 0 else "the other side"
    share = format_number(100 * exchange.sent, 0)
    verdict = ", more than came" if exchange.sent > 1 + 1e-9 else ""
    alike = "" if _alike(exchange) else "; light and camera exchanged, it would be another"
    return (
        f"A red ball by the model “{name}”, beside sixteen from smooth to rough and from "
        f"matte to mirror; a point of it, lit at {abs(settings.light_angle):.0f}° from its "
        f"normal and seen at {abs(settings.view_angle):.0f}° on {sides}, shows the brightness "
        f"{format_number(seen)}{alike}; in all directions together it sends back {share}\u00a0% of "
        f"the light{verdict}."
    )


# The quadrature is accurate to a percent and takes a few milliseconds: no tiers.
SCENE = Scene(
    id="brdf",
    title="Reflectance Distribution (BRDF)",
    settings=Settings,
    draw=draw,
    formula=reflected,
    stages=STAGES,
    handles=HANDLES,
)
