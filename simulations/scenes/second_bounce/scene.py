"""A floor, a wall and a ball: light that bounces between them, also into the lamp's shadow.

The computation is in `simulations.scenes.second_bounce.stages`.
"""

import math

from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.light.interreflection import bounced, edge_factor, shadow_end
from simulations.scenes.second_bounce import section
from simulations.scenes.second_bounce.handles import HANDLES
from simulations.scenes.second_bounce.picture import marks
from simulations.scenes.second_bounce.profile import profile
from simulations.scenes.second_bounce.room import DRAFT
from simulations.scenes.second_bounce.settings import BOUNCES, Settings
from simulations.scenes.second_bounce.shown import Shown, shown_at
from simulations.scenes.second_bounce.stages import STAGES


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The room, the planes from the side, and their brightness as curves."""
    planes = outputs["planes"]
    shown = shown_at(planes, settings.place)
    width, height = section.WIDTH, section.HEIGHT
    curves = profile(planes, settings.place, (shown.red, shown.blue))
    return Frame(
        panels=(
            Panel(
                "picture",
                "What the camera sees",
                width,
                height,
                outputs["picture"],
                marks(settings),
                lead=True,
            ),
            Panel("section", "From the side", width, height, overlay=section.section(settings)),
            Panel("profile", "Brightness of wall and floor", width, height, overlay=curves),
        ),
        readouts=_readouts(settings, shown),
        description=describe(settings, shown),
    )


def _readouts(settings: Settings, shown: Shown) -> tuple[Readout, ...]:
    factor = edge_factor(settings.albedo, math.radians(settings.opening))
    return (
        readout("lamp", "Point, lamp alone", shown.lamp, digits=3, role="light"),
        readout("red", "Point, red light", shown.red, digits=3, role="ray"),
        readout("blue", "Point, blue light", shown.blue, digits=3, role="image"),
        readout("bounced", "Point, red light from the wall", shown.red - shown.lamp, digits=3),
        readout("factor", "Edge of two alike: times brighter", factor, digits=2),
    )


def describe(settings: Settings, shown: Shown) -> str:
    """The picture in one sentence."""
    light, angle = math.radians(settings.light_angle), math.radians(settings.opening)
    end = shadow_end(light, angle)
    shadow = (
        f"the wall’s shadow covers {100 * min(end, 1.0):.0f}\u00a0% of the floor"
        if end > 0
        else "no part of the floor is shaded"
    )
    count = BOUNCES[settings.bounces].lower().replace("none: the lamp alone", "no")
    times = "bounce" if settings.bounces == "1" else "bounces"
    wall = "red" if settings.wall == "red" else "white"
    return (
        f"A white ball on a white floor, before a {wall} wall at {settings.opening:.0f}° to it, "
        f"with the lamp {settings.light_angle:.0f}° above the floor: {shadow}, "
        f"and with {count} {times} a point {100 * settings.place:.0f}\u00a0% out from the "
        f"edge has the brightness {format_number(shown.red)} in red light and "
        f"{format_number(shown.blue)} in blue."
    )


SCENE = Scene(
    id="second-bounce",
    title="A Shadow and a Second Bounce",
    settings=Settings,
    draw=draw,
    formula=bounced,
    stages=STAGES,
    handles=HANDLES,
    own_drafts={DRAFT: ("opening", "light_angle", "albedo")},
)
