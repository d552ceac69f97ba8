"""The drawings of the Lambertian scene: over the sphere, and the sphere from above.

World axes: x right, y up, z towards the camera. Directions in the horizontal plane are given
by their angle from the camera's direction, positive to the right: ``(sin, 0, cos)``.
"""

import math
from collections.abc import Iterator

from simulations.engine.drawing import (
    Point,
    arrow,
    circle,
    dot,
    line,
    polygon,
    polyline,
    rectangle,
    text,
)
from simulations.scenes._ball.marks import (
    CENTRE,
    HEIGHT,
    RADIUS,
    lamp,
    named,
    on_equator,
    probed_point,
    shadow_edge,
)

PLAN_CENTRE, PLAN_RADIUS, VECTOR = (200.0, 136.0), 60.0, 72.0
"""The sphere from above, and the length of a unit vector there."""
ARC = 34.0
"""Radius of the arc of θ."""
RAY_START = 112.0
"""Distance at which parallel rays begin, from the plane through the sphere's centre."""
LAMP_DISTANCE = 126.0
"""Drawn distance of the lamp from the sphere's centre; it is far away."""


def over_sphere(light_rad: float, probe_rad: float, show_normals: bool) -> str:
    """Terminator, brightest point, light rays and probed point on the camera's view."""
    parts = [*_picture_normals()] if show_normals else []
    parts += shadow_edge(light_rad)
    parts += _picture_rays(light_rad)
    if math.cos(light_rad) > 0.05:
        brightest = on_equator(light_rad)
        parts += [circle(brightest, 7, "casing"), circle(brightest, 7, "light")]
        parts.append(named(brightest, "brightest point", "light"))
    parts += probed_point(probe_rad, "ray")
    parts.append(named(on_equator(probe_rad), "probed point", "ray", above=True))
    return "".join(parts)


def _picture_rays(light_rad: float) -> Iterator[str]:
    """Three parallel rays next to the sphere, foreshortened as the camera sees them."""
    across = math.sin(light_rad)
    length = 62 * abs(across)
    if length < 12:
        return
    side = math.copysign(1, across)
    for offset in (-46, 0, 46):
        edge = math.sqrt(RADIUS**2 - offset**2) + 8
        start = (CENTRE[0] + side * (edge + length), CENTRE[1] + offset)
        end = (CENTRE[0] + side * edge, CENTRE[1] + offset)
        yield from _cased_arrow(start, end, "light")


def _picture_normals() -> Iterator[str]:
    """Normals of the visible half, foreshortened; those towards the camera shrink to a point."""
    for latitude in (-60, -30, 0, 30, 60):
        for longitude in (-75, -50, -25, 0, 25, 50, 75):
            x = math.cos(math.radians(latitude)) * math.sin(math.radians(longitude))
            y = -math.sin(math.radians(latitude))
            foot = (CENTRE[0] + RADIUS * x, CENTRE[1] + RADIUS * y)
            tip = (foot[0] + 30 * x, foot[1] + 30 * y)
            yield from _cased_arrow(foot, tip, "world thin", head=6)


BEYOND_TIP = 4.2
"""Distance from the tip of a head to that of an outline which is 1.5 units wide."""


def _cased_arrow(start: Point, end: Point, style: str, head: float = 8) -> Iterator[str]:
    """An arrow with an outline in the paper's colour, visible on any picture."""
    length = math.hypot(end[0] - start[0], end[1] - start[1])
    if length < head:
        yield circle(end, 2.5, "casing")
        yield dot(end, style, 2)
        return
    past = 1 + BEYOND_TIP / length
    wide_end = (start[0] + (end[0] - start[0]) * past, start[1] + (end[1] - start[1]) * past)
    yield arrow(start, wide_end, "casing", head + BEYOND_TIP + 1.5)
    yield arrow(start, end, style, head)


def from_above(light_rad: float, probe_rad: float, theta_rad: float, show_normals: bool) -> str:
    """The equator seen from above, with true angles; the camera is at the bottom."""
    night = [in_plan(light_rad + math.pi * (0.5 + step / 32), PLAN_RADIUS) for step in range(33)]
    day = [in_plan(light_rad + math.pi * (step / 32 - 0.5), PLAN_RADIUS) for step in range(33)]
    probed = in_plan(probe_rad, PLAN_RADIUS)
    n_tip, l_tip = _from(probed, probe_rad, VECTOR), _from(probed, light_rad, VECTOR)
    n_label, l_label = _label_places(probed, probe_rad, light_rad)
    parts = [
        *_plan_rays(light_rad),
        polygon(night, "muted fill"),
        polyline(day, "light bold"),
        line(night[0], night[-1], "light dashed"),
        *lamp(in_plan(light_rad, LAMP_DISTANCE)),
        *(_plan_normals() if show_normals else ()),
        _camera(),
        _angle(probed, probe_rad, light_rad, theta_rad),
        arrow(probed, l_tip, "light bold"),
        arrow(probed, n_tip, "world bold"),
        dot(probed, "ray", 5.5),
        text(n_label, "n", "world strong ground", "middle"),
        text(l_label, "l", "light strong ground", "middle"),
    ]
    return "".join(parts)


def _plan_rays(light_rad: float) -> Iterator[str]:
    """Parallel rays that end on the lit half of the equator."""
    towards = (math.sin(light_rad), math.cos(light_rad))
    aside = (towards[1], -towards[0])
    for share in (-0.8, -0.4, 0, 0.4, 0.8):
        near = PLAN_RADIUS * math.sqrt(1 - share**2) + 4
        foot = (
            PLAN_CENTRE[0] + aside[0] * share * PLAN_RADIUS,
            PLAN_CENTRE[1] + aside[1] * share * PLAN_RADIUS,
        )
        start = (foot[0] + towards[0] * RAY_START, foot[1] + towards[1] * RAY_START)
        end = (foot[0] + towards[0] * near, foot[1] + towards[1] * near)
        yield arrow(start, end, "light thin faint", head=7)


def _plan_normals() -> Iterator[str]:
    for degrees in range(-90, 91, 15):
        angle = math.radians(degrees)
        foot = in_plan(angle, PLAN_RADIUS)
        yield arrow(foot, _from(foot, angle, 24), "world thin", head=6)


def _angle(probed: Point, probe_rad: float, light_rad: float, theta_rad: float) -> str:
    """The arc from n to l, the short way round."""
    turn = math.remainder(light_rad - probe_rad, 2 * math.pi)
    arc = [_from(probed, probe_rad + turn * step / 24, ARC) for step in range(25)]
    # Between the arms where there is room for it, else beside n.
    towards = probe_rad + (turn / 2 if theta_rad > 0.4 else -math.copysign(0.34, turn))
    label = _from(probed, towards, ARC + 16)
    return polyline(arc, "ray") + text((label[0], label[1] + 4), "θ", "ray strong ground", "middle")


def _label_places(probed: Point, probe_rad: float, light_rad: float) -> tuple[Point, Point]:
    """Labels of n and l, each on the side away from the other; that of l not under the lamp."""
    side = math.copysign(1.0, math.remainder(light_rad - probe_rad, 2 * math.pi))
    n = _from(probed, probe_rad - 0.2 * side, VECTOR + 2)
    l_ = _from(probed, light_rad + 0.3 * side, 0.7 * VECTOR)
    return (n[0], n[1] + 4), (l_[0], l_[1] + 4)


def _camera() -> str:
    x, y = PLAN_CENTRE[0], HEIGHT - 24.0
    lens = [(x - 5, y - 8), (x - 9, y - 15), (x + 9, y - 15), (x + 5, y - 8)]
    return (
        rectangle((x - 14, y - 8), 28, 16, "camera fill")
        + polygon(lens, "camera fill")
        + text((x + 22, y + 5), "camera", "camera")
    )


def in_plan(angle_rad: float, radius: float) -> tuple[float, float]:
    """A place at a distance from the sphere's centre, seen from above."""
    return _from(PLAN_CENTRE, angle_rad, radius)


def _from(start: Point, angle_rad: float, length: float) -> tuple[float, float]:
    """Go from a point of the plan in a direction; the camera's direction is down the page."""
    return (start[0] + length * math.sin(angle_rad), start[1] + length * math.cos(angle_rad))
