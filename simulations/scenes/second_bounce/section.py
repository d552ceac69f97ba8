"""The first panel of the second-bounce figure: both planes from the side, lamp and shadow."""

import math

from simulations.engine.drawing import Point, arrow, circle, dot, line, polygon, text
from simulations.models.light.interreflection import shadow_end
from simulations.scenes._ball.marks import lamp
from simulations.scenes.second_bounce import room
from simulations.scenes.second_bounce.settings import Settings

WIDTH, HEIGHT = 400, 320
EDGE = (192.0, 262.0)
LENGTH = 172.0
"""Length of each plane, in units of the view box."""
LAMP = 180.0
"""Drawn distance of the lamp from the edge; it is far away."""


def towards(angle_deg: float, length: float) -> tuple[float, float]:
    """The place at an angle above the floor and a distance from the edge."""
    turn = math.radians(angle_deg)
    return EDGE[0] + length * math.cos(turn), EDGE[1] - length * math.sin(turn)


def angle_at(place: Point) -> float:
    """Degrees above the floor, as seen from the edge; clamped to the nearer end below it."""
    across, up = float(place[0]) - EDGE[0], EDGE[1] - float(place[1])
    if up <= 0.0:
        return 0.0 if across >= 0.0 else 180.0
    return math.degrees(math.atan2(up, across))


def distance_at(place: Point) -> float:
    """Distance of a place along the floor."""
    return (float(place[0]) - EDGE[0]) / LENGTH


def section(settings: Settings) -> str:
    """Planes, lamp, shadow, and the chosen point's view of the wall."""
    wall, floor = towards(settings.opening, LENGTH), towards(0, LENGTH)
    here, source = towards(0, LENGTH * settings.place), towards(settings.light_angle, LAMP)
    middle = EDGE[0] + LENGTH * float(room.CENTRE[0]), EDGE[1] - LENGTH * room.RADIUS
    parts = [
        polygon((here, EDGE, wall), "ray fill thin"),
        circle(middle, room.RADIUS * LENGTH, "world thin"),
        *_shadow(settings),
        line(EDGE, floor, "world bold"),
        line(EDGE, wall, "world bold"),
        arrow(source, towards(settings.light_angle, LAMP - 62.0), "light bold"),
        *lamp(source),
        dot(EDGE, "world", 3.5),
        *(circle(here, 5.5, "casing"), dot(here, "image", 5)),
        text((floor[0], floor[1] - 8), "floor", "world ground", "end"),
        text(
            (EDGE[0], EDGE[1] + 48),
            "tinted: what the point sees of the wall",
            "ray small",
            "middle",
        ),
    ]
    rim = towards(settings.opening, LENGTH)
    beside = rim[0] > 90.0
    spot = (rim[0] - 20, rim[1] + 5) if beside else (max(rim[0], 32.0), rim[1] + 34)
    parts.append(text(spot, "opening", "world small ground", "end" if beside else "middle"))
    name = towards(settings.opening, 0.3 * LENGTH)
    parts.append(text((name[0] - 9, name[1]), "wall", "world ground", "end"))
    return "".join(parts)


def _shadow(settings: Settings) -> list[str]:
    """The ray past the wall's rim, or the floor's, and the shadow."""
    light, angle = math.radians(settings.light_angle), math.radians(settings.opening)
    end = shadow_end(light, angle)
    if end <= 0.0:
        return []
    reach = towards(0, LENGTH * min(end, 1.0))
    rim = towards(settings.opening, LENGTH)
    away = (math.cos(light), -math.sin(light))
    start = (rim[0] + 40.0 * away[0], rim[1] + 40.0 * away[1])
    parts = [polygon((EDGE, reach, rim), "muted fill thin faint")]
    if end <= 1.0:
        parts.append(line(start, reach, "light dashed"))
    parts.append(line(EDGE, reach, "error bold"))
    parts.append(text((EDGE[0] + 6, EDGE[1] + 26), "in the lamp’s shadow", "error small ground"))
    return parts
