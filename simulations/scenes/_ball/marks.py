"""The ball in the camera's picture: its place, and the marks that both scenes draw over it.

Directions in the horizontal plane are given by their angle from the camera's direction, positive
to the right.
"""

import math

from simulations.engine.drawing import Point, circle, dot, line, polyline, text

WIDTH, HEIGHT = 400, 340
CENTRE, RADIUS = (200.0, 170.0), 122.0
"""The ball, in view box units."""
LONGEST_NAME = 116.0
"""Room for the name of a point, in view box units."""


def on_equator(angle_rad: float) -> tuple[float, float]:
    """Place in the picture of the equator's point whose normal has an angle."""
    return CENTRE[0] + RADIUS * math.sin(angle_rad), CENTRE[1]


def angle_of_normal(place: Point) -> float:
    """The angle in degrees of the normal on the equator above or below a place of the picture."""
    across = (float(place[0]) - CENTRE[0]) / RADIUS
    return math.degrees(math.asin(min(max(across, -1.0), 1.0)))


def shadow_edge(light_rad: float) -> list[str]:
    """The terminator with an outline, visible on light and dark."""
    return [polyline(terminator(light_rad), style) for style in ("casing", "light dashed")]


def probed_point(probe_rad: float, role: str) -> list[str]:
    probed = on_equator(probe_rad)
    return [circle(probed, 5.5, "casing"), dot(probed, role, 5.5)]


def named(place: Point, words: str, role: str, *, above: bool = False) -> str:
    """The name of a point of the ball, far enough from it for the ring of its handle."""
    across = min(max(place[0], LONGEST_NAME / 2), WIDTH - LONGEST_NAME / 2)
    spot = (across, place[1] + (-20 if above else 30))
    return text(spot, words, f"{role} small ground", "middle")


def lamp(place: Point) -> list[str]:
    """A disc with rays around it."""
    parts = [circle(place, 7, "casing"), dot(place, "light", 6)]
    for eighth in range(8):
        across, down = math.cos(math.pi * eighth / 4), math.sin(math.pi * eighth / 4)
        near, far = ((place[0] + reach * across, place[1] + reach * down) for reach in (9, 14))
        parts.append(line(near, far, "light"))
    return parts


def terminator(light_rad: float) -> list[Point]:
    """The visible half of the circle where the light grazes the sphere, in view box units.

    If the light is in front or behind, it is the rim, which is wholly visible.
    """
    if abs(math.sin(light_rad)) < 1e-9:
        return [_on_rim(math.pi * step / 48) for step in range(97)]
    side = 1 if math.cos(light_rad) * math.sin(light_rad) <= 0 else -1
    reach = abs(math.cos(light_rad)) * side * RADIUS
    turns = [math.pi * (step / 48 - 0.5) for step in range(49)]
    return [
        (CENTRE[0] + reach * math.cos(turn), CENTRE[1] + RADIUS * math.sin(turn)) for turn in turns
    ]


def _on_rim(turn_rad: float) -> Point:
    return CENTRE[0] + RADIUS * math.cos(turn_rad), CENTRE[1] + RADIUS * math.sin(turn_rad)
