"""The four angles of a ray at the two surfaces of a lens, one after the other."""

import math

import numpy as np

from simulations.engine.drafting import dimension, label, polar
from simulations.engine.drawing import Point, dot, line, polygon
from simulations.engine.illustration import Illustration, Panel, in_steps
from simulations.models.lens.singlet import Singlet, sag_mm, through_exact

MIDDLE, AXIS = 152.0, 136.0
"""Of the lens; all lengths are in units of the drawing."""
LENS = Singlet(1 / 230, -1 / 260, 120.0, 1.5)
HEIGHT, HALF = 92.0, 112.0
"""Of the ray and of the lens."""
RAY = through_exact(LENS, math.inf, [HEIGHT], 200.0)
FRONT, BACK = ((MIDDLE + x, AXIS - y) for x, y in (*RAY.front, *RAY.back))
CENTRE = (MIDDLE - LENS.thickness_mm / 2 + 1 / LENS.front_per_mm, AXIS)
"""Of the front sphere."""
FIRST = math.asin(HEIGHT * LENS.front_per_mm)
SECOND = -math.asin(float(RAY.back[0, 1]) * LENS.back_per_mm)
"""Directions of the normals; angles are counter-clockwise, from the right."""
INSIDE = math.atan2(FRONT[1] - BACK[1], BACK[0] - FRONT[0])
OUTSIDE = math.atan(float(RAY.slope[0]))


def angles() -> tuple[float, float, float, float]:
    """Between ray and normal: before and behind the front, before and behind the back."""
    return FIRST, FIRST + INSIDE, SECOND - INSIDE, SECOND - OUTSIDE


def _glass() -> list[tuple[float, float]]:
    """The upper half of the lens."""
    heights = np.linspace(0.0, HALF, 25)
    half = LENS.thickness_mm / 2
    front = -half + sag_mm(LENS.front_per_mm, heights)
    back = half + sag_mm(LENS.back_per_mm, heights)
    faces = [*zip(front, heights, strict=True), *zip(back[::-1], heights[::-1], strict=True)]
    return [(MIDDLE + x, AXIS - y) for x, y in faces]


def _wedge(
    place: Point,
    radius: float,
    start: float,
    end: float,
    name: str,
    style: str,
    at: tuple[float, float] | None = None,
) -> str:
    """A sector, and its name ``at`` a place or outside of its arc."""
    corners = [polar(place, radius, start + share / 12 * (end - start)) for share in range(13)]
    x, y = at or polar(place, radius + 12.0, (start + end) / 2)
    words = label((x, y + 4.5), name, f"{style} italic ground", "middle")
    return polygon([place, *corners], f"{style} fill thin") + words


def draw() -> Illustration:
    focus = (MIDDLE + float(RAY.crossing_mm[0]), AXIS)
    turn = math.pi
    ahead = (BACK[0] + 88.0, BACK[1])
    first = [
        line((6, AXIS), (396, AXIS), "muted thin dashed"),
        polygon(_glass(), "camera fill"),
        line((6, AXIS - HEIGHT), FRONT, "ray"),
        line(polar(FRONT, 62, turn - FIRST), CENTRE, "muted thin dashed"),
        dot(CENTRE, "muted", 3),
        dimension((30, AXIS - HEIGHT), (30, AXIS), "muted"),
        label((22, AXIS - HEIGHT / 2 + 5), "h", "muted italic", "end"),
        label(polar(CENTRE, 120, turn - FIRST - 0.07), "R_1", "muted italic ground", "middle"),
        _wedge(CENTRE, 40, turn - FIRST, turn, "θ_1", "world"),
        _wedge(FRONT, 40, turn - FIRST, turn, "θ_1", "world"),
    ]
    second = [
        line(FRONT, BACK, "ray"),
        _wedge(FRONT, 40, -FIRST, INSIDE, "θ_2", "world", polar(FRONT, 34, -FIRST - 0.4)),
    ]
    third = [
        line(polar(BACK, 60, turn + SECOND), polar(BACK, 70, SECOND), "muted thin dashed"),
        _wedge(BACK, 26, turn + INSIDE, turn + SECOND, "θ_3", "image"),
    ]
    fourth = [line(BACK, focus, "ray"), _wedge(BACK, 36, OUTSIDE, SECOND, "θ_4", "image")]
    fifth = [
        dot(focus, "ray", 4),
        line(BACK, ahead, "ray thin dashed"),
        _wedge(focus, 44, turn + OUTSIDE, turn, "turn", "error", (focus[0] - 10, AXIS - 28)),
    ]
    words = (
        "A ray parallel to the axis meets the front of a lens at {:.0f}° to the normal and goes "
        "on at {:.0f}°; it meets the back at {:.0f}° to the normal there and leaves at {:.0f}°."
    ).format(*map(math.degrees, angles()))
    overlay = in_steps(first, second, third, fourth, fifth)
    return Illustration((Panel("section", "", 400.0, 156.0, overlay=overlay),), words)
