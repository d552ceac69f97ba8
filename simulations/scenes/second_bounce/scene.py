"""A floor, a wall and a ball: light that bounces between them, also into the lamp's shadow.

The computation is in `simulations.scenes.second_bounce.picture`.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np

from simulations.engine.drawing import arrow, circle, dot, line, polygon, text
from simulations.engine.frame import Frame, Panel, format_number, readout
from simulations.engine.handles import Handle
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.light.interreflection import bounced, edge_factor, shadow_end
from simulations.scenes._ball import lamp, named, outlined_dot
from simulations.scenes.second_bounce import room
from simulations.scenes.second_bounce.picture import DRAFT, PLACES, STAGES, Planes
from simulations.scenes.second_bounce.room import HEIGHT, WIDTH

WALLS = {"red": "Red", "white": "White, as the floor"}
BOUNCES = {"0": "None: the lamp alone", "1": "One", "2": "Two", "4": "Four", "all": "All"}
LAMP = (1.12, -0.7)
"""Drawn distance of the lamp from the edge in the room, which it has in a vertical plane, and
its z."""

EDGE = (192.0, 262.0)
LENGTH = 172.0  # of each plane in the section, in units of the view box
SECTION_LAMP = 180.0  # drawn distance of the lamp from the edge; it is far away

PLOT = Plot(Axis(-1.0, 1.0, 42.0, 386.0), Axis(0.0, 1.2, 262.0, 44.0))
"""Places along the wall from −1 to 0, along the floor from 0 to 1."""
FROM_EDGE = Scale(ticks=[(place, f"{abs(place):g}") for place in (-1, 0, 1)])
BRIGHTNESS = Scale(ticks=(0, 1))
LEGEND = (
    Entry("lamp alone", "light dashed"),
    Entry("all: red light", "ray bold"),
    Entry("all: blue light", "image"),
)
ALONG = np.concatenate([-PLACES[::-1], PLACES])


@dataclass(frozen=True, slots=True)
class Settings:
    bounces: str = choice("Bounces", BOUNCES, "all")
    light_angle: float = slider("Lamp above the floor", 55, 10, 170, 1, unit="°")
    opening: float = slider("Opening angle φ", 90, 40, 150, 1, unit="°")
    albedo: float = slider("Albedo ρ", 0.8, 0, 0.95, 0.01)
    wall: str = choice("Wall", WALLS)
    place: float = slider("Point on the floor", 0.15, 0.01, 0.99, 0.01)


def point_in_room(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return room.project((settings.place, 0.0, room.LINE))


def lamp_in_room(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    turn = math.radians(settings.light_angle)
    return room.project((LAMP[0] * math.cos(turn), LAMP[0] * math.sin(turn), LAMP[1]))


def marks(settings: Settings) -> str:
    """The lamp, dashed behind the wall, and the chosen point."""
    here, source = point_in_room(settings, {}), lamp_in_room(settings, {})
    hidden = settings.light_angle > settings.opening
    return "".join(
        (
            circle(source, 9, "light dashed") if hidden else lamp(source),
            outlined_dot(here, "image", 5),
            named(here, "point", "image"),
        )
    )


def towards(angle_deg: float, length: float) -> tuple[float, float]:
    """The place in the section at an angle above the floor and a distance from the edge."""
    turn = math.radians(angle_deg)
    return EDGE[0] + length * math.cos(turn), EDGE[1] - length * math.sin(turn)


def section(settings: Settings) -> str:
    """Planes, lamp, shadow, and the chosen point's view of the wall."""
    rim, floor = towards(settings.opening, LENGTH), towards(0, LENGTH)
    here, source = towards(0, LENGTH * settings.place), towards(settings.light_angle, SECTION_LAMP)
    middle = EDGE[0] + LENGTH * float(room.CENTRE[0]), EDGE[1] - LENGTH * room.RADIUS
    under = (EDGE[0], EDGE[1] + 48)
    beside = rim[0] > 90.0
    spot = (rim[0] - 20, rim[1] + 5) if beside else (max(rim[0], 32.0), rim[1] + 34)
    name = towards(settings.opening, 0.3 * LENGTH)
    parts = [
        polygon((here, EDGE, rim), "ray fill thin"),
        circle(middle, room.RADIUS * LENGTH, "world thin"),
        *shadow(settings),
        line(EDGE, floor, "world bold"),
        line(EDGE, rim, "world bold"),
        arrow(source, towards(settings.light_angle, SECTION_LAMP - 62.0), "light bold"),
        lamp(source),
        dot(EDGE, "world", 3.5),
        outlined_dot(here, "image", 5),
        text((floor[0], floor[1] - 8), "floor", "world ground", "end"),
        text(under, "tinted: what the point sees of the wall", "ray small", "middle"),
        text(spot, "opening", "world small ground", "end" if beside else "middle"),
        text((name[0] - 9, name[1]), "wall", "world ground", "end"),
    ]
    return "".join(parts)


def shadow(settings: Settings) -> Iterator[str]:
    """The ray past the wall's rim, or the floor's, and the shadow."""
    light = math.radians(settings.light_angle)
    end = shadow_end(light, math.radians(settings.opening))
    if end <= 0.0:
        return
    reach, rim = towards(0, LENGTH * min(end, 1.0)), towards(settings.opening, LENGTH)
    yield polygon((EDGE, reach, rim), "muted fill thin faint")
    if end <= 1.0:
        start = (rim[0] + 40.0 * math.cos(light), rim[1] - 40.0 * math.sin(light))
        yield line(start, reach, "light dashed")
    yield line(EDGE, reach, "error bold")
    yield text((EDGE[0] + 6, EDGE[1] + 26), "in the lamp’s shadow", "error small ground")


def profile(planes: Planes, place: float) -> str:
    """The lamp's part, and all of the light, in red and blue, along the wall and the floor."""
    red, blue = planes.all_light
    _, red_here, blue_here = planes.at(place)
    return "".join(
        (
            profile_axes(),
            profile_curve(planes.lamp, "light dashed"),
            profile_curve(blue, "image"),
            profile_curve(red, "ray bold"),
            PLOT.drop(place, red_here, "muted thin"),
            PLOT.mark(place, blue_here, "image", radius=4.0),
            PLOT.mark(place, red_here, "ray"),
        )
    )


def profile_curve(brightness: Floats, style: str) -> str:
    """(2, 201) of floor and wall, from the wall's rim over the edge to the floor's."""
    floor, wall = brightness
    return PLOT.curve(ALONG, np.minimum(np.concatenate([wall[::-1], floor]), PLOT.y.high), style)


@cache
def profile_axes() -> str:
    (wall, foot), (edge, _), (floor, _) = (PLOT.at(place, 0) for place in (-0.5, 0, 0.5))
    return "".join(
        (
            PLOT.frame(FROM_EDGE, BRIGHTNESS),
            PLOT.upright(0.0, "world thin dashed"),
            text((wall, foot + 38), "← along the wall", "world small", "middle"),
            text((floor, foot + 38), "along the floor →", "world small", "middle"),
            text((edge, foot + 38), "edge", "world small", "middle"),
            legend((PLOT.x.start, 22), LEGEND, "small", PLOT.x.end - PLOT.x.start),
        )
    )


def draw(settings: Settings, outputs: Outputs) -> Frame:
    planes: Planes = outputs["planes"]
    by_lamp, red, blue = planes.at(settings.place)
    factor = edge_factor(settings.albedo, math.radians(settings.opening))
    size, curves = (WIDTH, HEIGHT), profile(planes, settings.place)
    shown = outputs["picture"], marks(settings)
    return Frame(
        (
            Panel("picture", "What the camera sees", *size, *shown, lead=True),
            Panel("section", "From the side", *size, overlay=section(settings)),
            Panel("profile", "Brightness of wall and floor", *size, overlay=curves),
        ),
        (
            readout("lamp", "Point, lamp alone", by_lamp, digits=3, role="light"),
            readout("red", "Point, red light", red, digits=3, role="ray"),
            readout("blue", "Point, blue light", blue, digits=3, role="image"),
            readout("bounced", "Point, red light from the wall", red - by_lamp, digits=3),
            readout("factor", "Edge of two alike: times brighter", factor, digits=2),
        ),
        describe(settings, red, blue),
    )


def describe(settings: Settings, red: float, blue: float) -> str:
    end = shadow_end(math.radians(settings.light_angle), math.radians(settings.opening))
    shadow = (
        f"the wall’s shadow covers {100 * min(end, 1.0):.0f}\u00a0% of the floor"
        if end > 0
        else "no part of the floor is shaded"
    )
    count = BOUNCES[settings.bounces].lower().replace("none: the lamp alone", "no")
    times = "bounce" if settings.bounces == "1" else "bounces"
    return (
        f"A white ball on a white floor, before a {settings.wall} wall at "
        f"{settings.opening:.0f}° to it, with the lamp {settings.light_angle:.0f}° above the "
        f"floor: {shadow}, and with {count} {times} a point {100 * settings.place:.0f}\u00a0% out "
        f"from the edge has the brightness {format_number(red)} in red light and "
        f"{format_number(blue)} in blue."
    )


def lamp_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return towards(settings.light_angle, SECTION_LAMP)


def wall_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return towards(settings.opening, LENGTH)


def point_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return towards(0, LENGTH * settings.place)


def plotted_at(settings: Settings, outputs: Outputs) -> tuple[float, float]:
    return PLOT.clamped(settings.place, outputs["planes"].at(settings.place)[1])


LIGHT, OPENING, PLACE = ("light_angle",), ("opening",), ("place",)
HANDLES: tuple[Handle[Settings], ...] = (
    Handle("lamp-in-room", "picture", "Lamp", LIGHT, lamp_in_room, role="light", reversed=LIGHT),
    Handle("point-in-room", "picture", "Point on the floor", PLACE, point_in_room, role="image"),
    Handle("lamp", "section", "Lamp", LIGHT, lamp_at, role="light", reversed=LIGHT),
    Handle("wall", "section", "Top of the wall", OPENING, wall_at, role="world", reversed=OPENING),
    Handle("point", "section", "Point on the floor", PLACE, point_at, role="image"),
    Handle("plotted", "profile", "Point on the floor", PLACE, plotted_at, role="ray"),
)
SCENE = Scene(
    "second-bounce",
    "A Shadow and a Second Bounce",
    Settings,
    draw,
    STAGES,
    HANDLES,
    own_drafts={DRAFT: ("opening", "light_angle", "albedo")},
    formula=bounced,
)
