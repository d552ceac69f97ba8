"""The drawings of the Lambertian scene: over the sphere, from above, and brightness by angle.

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
    path,
    polygon,
    polyline,
    rectangle,
    text,
)
from simulations.engine.frame import format_number

WIDTH, HEIGHT = 400, 340
CENTRE, RADIUS = (200.0, 170.0), 122.0
"""The sphere in the camera's view."""

PLAN_CENTRE, PLAN_RADIUS, VECTOR = (200.0, 136.0), 74.0, 62.0
"""The sphere from above, and the length of a unit vector there."""

PLOT_LEFT, PLOT_RIGHT, PLOT_TOP, PLOT_BOTTOM = 58.0, 382.0, 34.0, 282.0


def over_sphere(light_rad: float, probe_rad: float, show_normals: bool) -> str:
    """Terminator, brightest point, light rays and probed point on the camera's view."""
    parts = [*_picture_normals()] if show_normals else []
    for style in ("casing", "light dashed"):
        parts.append(polyline(terminator(light_rad), style))
    parts += _picture_rays(light_rad)
    if math.cos(light_rad) > 0.05:
        brightest = (CENTRE[0] + RADIUS * math.sin(light_rad), CENTRE[1])
        parts += [circle(brightest, 7, "casing"), circle(brightest, 7, "light")]
    probed = (CENTRE[0] + RADIUS * math.sin(probe_rad), CENTRE[1])
    parts += [circle(probed, 5.5, "casing"), dot(probed, "ray", 5.5)]
    return "".join(parts)


def terminator(light_rad: float) -> list[Point]:
    """The visible half of the circle where the light grazes the sphere, in view box units.

    With the light in front or behind it is the rim, all of which is visible.
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


def _picture_rays(light_rad: float) -> Iterator[str]:
    """Three parallel rays beside the sphere, foreshortened as the camera sees them."""
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


def _cased_arrow(start: Point, end: Point, style: str, head: float = 8) -> Iterator[str]:
    """An arrow that stands out from any picture: over a wider one in the paper's colour."""
    length = math.hypot(end[0] - start[0], end[1] - start[1])
    if length < head:
        yield circle(end, 2.5, "casing")
        yield dot(end, style, 2)
        return
    past = 1 + 2 / length
    wide_end = (start[0] + (end[0] - start[0]) * past, start[1] + (end[1] - start[1]) * past)
    yield arrow(start, wide_end, "casing", head + 5)
    yield arrow(start, end, style, head)


def from_above(light_rad: float, probe_rad: float, theta_rad: float, show_normals: bool) -> str:
    """The equator seen from above, the camera at the bottom: every angle is true here."""
    night = [_plan(light_rad + math.pi * (0.5 + step / 32), PLAN_RADIUS) for step in range(33)]
    day = [_plan(light_rad + math.pi * (step / 32 - 0.5), PLAN_RADIUS) for step in range(33)]
    probed = _plan(probe_rad, PLAN_RADIUS)
    n_tip, l_tip = _from(probed, probe_rad, VECTOR), _from(probed, light_rad, VECTOR)
    n_label, l_label = _label_places(probed, probe_rad, light_rad)
    parts = [
        *_plan_rays(light_rad),
        polygon(night, "muted fill"),
        polyline(day, "light bold"),
        line(night[0], night[-1], "light dashed"),
        *(_plan_normals() if show_normals else ()),
        _camera(),
        _angle(probed, probe_rad, light_rad, theta_rad),
        arrow(probed, l_tip, "light bold"),
        arrow(probed, n_tip, "world bold"),
        dot(probed, "ray", 5.5),
        text(n_label, "n", "world strong halo", "middle"),
        text(l_label, "l", "light strong halo", "middle"),
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
        start = (foot[0] + towards[0] * 124, foot[1] + towards[1] * 124)
        end = (foot[0] + towards[0] * near, foot[1] + towards[1] * near)
        yield arrow(start, end, "light thin faint", head=7)


def _plan_normals() -> Iterator[str]:
    for degrees in range(-90, 91, 15):
        angle = math.radians(degrees)
        foot = _plan(angle, PLAN_RADIUS)
        yield arrow(foot, _from(foot, angle, 24), "world thin", head=6)


def _angle(probed: Point, probe_rad: float, light_rad: float, theta_rad: float) -> str:
    """The arc from n to l, the short way round, with its size."""
    turn = math.remainder(light_rad - probe_rad, 2 * math.pi)
    arc = [_from(probed, probe_rad + turn * step / 24, 30) for step in range(25)]
    middle = probe_rad + turn / 2
    # Just outside the arc, or across from it where the arms leave no room between them.
    sideways = abs(math.sin(middle))
    label = _from(probed, middle, 44 + 26 * sideways if theta_rad > 1.2 else -22 - 18 * sideways)
    degrees = format_number(math.degrees(theta_rad), 0)
    return polyline(arc, "ray") + text(
        (label[0], label[1] + 4), f"θ = {degrees}°", "ray strong halo", "middle"
    )


def _label_places(probed: Point, probe_rad: float, light_rad: float) -> tuple[Point, Point]:
    """Beside the tips of n and l, each on the side away from the other."""
    turn = math.copysign(0.2, math.remainder(light_rad - probe_rad, 2 * math.pi))
    n = _from(probed, probe_rad - turn, VECTOR + 2)
    l_ = _from(probed, light_rad + turn, VECTOR + 2)
    return (n[0], n[1] + 4), (l_[0], l_[1] + 4)


def _camera() -> str:
    x, y = PLAN_CENTRE[0], HEIGHT - 24.0
    lens = [(x - 5, y - 8), (x - 9, y - 15), (x + 9, y - 15), (x + 5, y - 8)]
    return (
        rectangle((x - 14, y - 8), 28, 16, "camera fill")
        + polygon(lens, "camera fill")
        + text((x + 22, y + 5), "camera", "camera")
    )


def _plan(angle_rad: float, radius: float) -> Point:
    return _from(PLAN_CENTRE, angle_rad, radius)


def _from(start: Point, angle_rad: float, length: float) -> Point:
    """Go from a point of the plan in a direction; the camera's direction is down the page."""
    return (start[0] + length * math.sin(angle_rad), start[1] + length * math.cos(angle_rad))


def brightness_plot(albedo: float, theta_rad: float, brightness: float) -> str:
    """Brightness against the angle between normal and light, and where the probed point is."""
    theta_deg = math.degrees(theta_rad)
    here = _plot(theta_deg, brightness)
    curve = [_plot(t, albedo * max(0.0, math.cos(math.radians(t)))) for t in range(0, 181, 2)]
    white = [_plot(t, max(0.0, math.cos(math.radians(t)))) for t in range(0, 91, 2)]
    label = text(
        (min(here[0] + 12, PLOT_RIGHT - 62), max(here[1] - 12, PLOT_TOP + 18)),
        f"I = {format_number(brightness, 3)}",
        "ray strong halo",
    )
    parts = [
        *_axes(),
        polyline(white, "muted thin dashed"),
        polyline(curve, "image bold"),
        path([[(here[0], PLOT_BOTTOM), here, (PLOT_LEFT, here[1])]], "ray thin dashed"),
        dot(here, "ray", 5.5),
        label,
    ]
    return "".join(parts)


def _axes() -> Iterator[str]:
    grid = [[_plot(0, share), _plot(180, share)] for share in (0.5, 1.0)]
    yield path([*grid, [_plot(90, 0), _plot(90, 1)]], "muted thin faint")
    yield path([[_plot(0, 1), _plot(0, 0), _plot(180, 0)]], "muted")
    for degrees in (0, 45, 90, 135, 180):
        x, y = _plot(degrees, 0)
        yield text((x, y + 19), f"{degrees}°", "muted", "middle")
    for share in (0, 0.5, 1.0):
        x, y = _plot(0, share)
        yield text((x - 9, y + 4.5), f"{share:g}", "muted", "end")
    yield text((PLOT_LEFT - 20, PLOT_TOP - 14), "brightness I", "image")
    yield text((_plot(59, 0)[0], _plot(0, 0.56)[1]), "ρ = 1", "muted small halo")
    yield text(
        ((PLOT_LEFT + PLOT_RIGHT) / 2, PLOT_BOTTOM + 42),
        "angle θ between normal and light",
        "",
        "middle",
    )
    yield text((_plot(135, 0)[0], _plot(0, 0.2)[1]), "faces away", "muted small", "middle")


def _plot(theta_deg: float, brightness: float) -> Point:
    return (
        PLOT_LEFT + (PLOT_RIGHT - PLOT_LEFT) * theta_deg / 180,
        PLOT_BOTTOM - (PLOT_BOTTOM - PLOT_TOP) * brightness,
    )
