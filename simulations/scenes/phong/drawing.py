"""The drawings of the Phong scene: marks on the ball, and the lobe at the probed point.

In the lobe's plot the normal of the surface points up; angles count from it, positive to the
right, and the length from the foot to the curve is the brightness seen from that side.
"""

import math
from collections.abc import Iterator
from functools import cache

import numpy as np

from simulations.engine.drawing import (
    Point,
    arrow,
    circle,
    dot,
    line,
    path,
    polygon,
    polyline,
    text,
)
from simulations.engine.plotting.legend import Entry, legend
from simulations.models.arrays import Floats
from simulations.scenes._ball.marks import (
    HEIGHT,
    WIDTH,
    lamp,
    named,
    on_equator,
    probed_point,
    shadow_edge,
)
from simulations.scenes.phong.gloss import MODELS

type Direction = tuple[str, float, str]
"""Letter, angle from the normal in radians, colour role."""

FOOT = (WIDTH / 2, 232.0)
VECTOR = 122.0
"""Length of a unit vector, and of a brightness of 1."""
LAMP_DISTANCE = 150.0
"""Drawn distance of the lamp from the foot, above the surface; it is far away."""
DEEPEST = HEIGHT - FOOT[1] - 20.0
"""Largest drawn depth of the lamp below the surface."""
AROUND_HIGHLIGHT = 9.0
"""Radius of the mark of a highlight, large enough for a sharp highlight inside it."""
ABOVE_HIGHLIGHT = 56.0
"""Distance of its handle from its centre, so that the finger does not hide it, nor the probed
point."""
STEM = 49.0
"""Distance from its centre to the end of the line to the handle."""
SAME_RAD = math.radians(9.0)
"""Directions nearer than this share one label."""


def over_ball(light_rad: float, probe_rad: float) -> str:
    """Terminator, centre of the highlight, probed point."""
    parts = shadow_edge(light_rad)
    if abs(abs(light_rad) - math.pi) > 1e-9:
        spot = on_equator(light_rad / 2)
        rim, end = (spot[0], spot[1] - AROUND_HIGHLIGHT), (spot[0], spot[1] - STEM)
        for style in ("casing", "ray"):
            parts += [circle(spot, AROUND_HIGHLIGHT, style), line(rim, end, style)]
        name = (spot[0] + 14, spot[1] - ABOVE_HIGHLIGHT + 4)
        parts.append(text(name, "highlight", "ray small ground"))
    return "".join(
        (
            *parts,
            *probed_point(probe_rad, "world"),
            named(on_equator(probe_rad), "probed point", "world"),
        )
    )


def highlight_grip(light_rad: float) -> tuple[float, float]:
    """Place of the highlight's handle."""
    across, down = on_equator(light_rad / 2)
    return across, down - ABOVE_HIGHLIGHT


def lobe_plot(
    light_rad: float,
    view_rad: float,
    brightness: Floats,
    other: Floats,
    matte: float,
    model: str,
) -> str:
    """Directions and lobe, all relative to the normal.

    ``brightness`` and ``other`` (181,) are the brightness to cameras at −90°…90° by the chosen
    ``model`` and by the other one; ``matte`` is the part that is equal for all.
    """
    parts = [
        _scale(),
        curve_names(model, Entry("matte", "world dashed")),
        line((24, FOOT[1]), (WIDTH - 24, FOOT[1]), "world bold"),
        text((26, FOOT[1] + 20), "surface", "world small"),
    ]
    seen = VECTOR * float(brightness[round(math.degrees(view_rad)) + 90])
    if brightness.max() > 0:
        at = towards(view_rad, seen)
        parts += [
            polyline(_outline(other), "muted thin dashed"),
            polygon(_outline(brightness), "ray fill"),
            polyline(_outline(np.full(181, matte)), "world dashed"),
            *(
                circle(at, 5.5, "casing"),
                dot(at, "image", 5.5),
            ),  # the brightness of the camera's pixel
        ]
    parts += _vectors(light_rad, view_rad, seen)
    return "".join(parts)


def curve_names(model: str, *more: Entry) -> str:
    """The legend above a plot of both models, the chosen one first."""
    other = next(name for name in MODELS if name != model)
    entries = (
        Entry(MODELS[model].name, "ray bold"),
        Entry(MODELS[other].name, "muted dashed"),
        *more,
    )
    return legend((46.0, 24.0), entries, "small")


@cache
def _scale() -> str:
    """Half circles of brightness 0.5 and 1: the same in every frame, so drawn once."""
    circles = [polyline(_outline(np.full(181, level)), "muted thin faint") for level in (0.5, 1.0)]
    white = text((FOOT[0] + VECTOR + 4, FOOT[1] + 15), "I = 1", "muted small", "middle")
    half = text((FOOT[0] + VECTOR / 2, FOOT[1] + 15), "0.5", "muted small", "middle")
    return "".join((*circles, white, half))


def _outline(brightness: Floats) -> list[Point]:
    around = np.radians(np.arange(-90.0, 91.0))
    x, y = FOOT[0] + VECTOR * brightness * np.sin(around), FOOT[1]
    return list(zip(x, y - VECTOR * brightness * np.cos(around), strict=True))


def _vectors(light_rad: float, view_rad: float, seen: float) -> list[str]:
    """n, l, v, the mirrored r and the halfway h; a label names both of two that coincide.

    ``seen`` is the distance from the foot of the dot on v, which no label may cover.
    """
    vectors = [("n", 0.0, "world"), ("l", light_rad, "light"), ("v", view_rad, "camera")]
    lit = math.cos(light_rad) > 0
    if lit:
        vectors.append(("r", -light_rad, "ray"))
    between = math.remainder(light_rad - view_rad, 2 * math.pi)
    if lit and abs(abs(between) - math.pi) > 1e-9:
        vectors.append(("h", view_rad + between / 2, "muted"))
    near = lamp_distance(light_rad) / LAMP_DISTANCE
    parts = [
        arrow(FOOT, towards(turn, VECTOR * near if name == "l" else VECTOR), f"{role} bold")
        for name, turn, role in vectors
    ]
    parts += [dot(FOOT, "world", 4.5), dot(towards(view_rad, VECTOR), "camera", 4.5)]
    parts += lamp(lamp_place(light_rad))
    if lit:
        parts.append(_equal_angles(light_rad))
    return parts + list(_labels(vectors, seen, near))


def _equal_angles(light_rad: float) -> str:
    """Arcs on both sides of the normal: the mirror turns l into r."""
    if abs(light_rad) < SAME_RAD:
        return ""
    arcs = [[towards(turn * step / 16, 30.0) for step in range(17)] for turn in (light_rad,)]
    arcs.append([towards(-light_rad * step / 16, 30.0) for step in range(17)])
    return path(arcs, "muted thin")


def _labels(vectors: list[Direction], seen: float, near: float) -> Iterator[str]:
    """One label for each group of directions within a few degrees of one another.

    ``near`` is the length of l as a share of the others'.
    """
    groups: list[list[Direction]] = []
    for vector in sorted(vectors, key=lambda item: math.remainder(item[1], 2 * math.pi)):
        if groups and _apart(groups[-1][-1], vector) < SAME_RAD:
            groups[-1].append(vector)
        else:
            groups.append([vector])
    for group in groups:
        middle = group[len(group) // 2][1]
        names_in = {name for name, _, _ in group}
        length = VECTOR + 22 + 5 * (len(group) - 1)
        if "v" in names_in and abs(seen - length) < 18:
            length = seen + 18
        place = towards(middle, length)
        if "l" in names_in:  # next to the arrow, as the lamp is beyond it
            aside = math.copysign(0.2, math.sin(middle))
            low = 0.0 <= math.cos(middle) < 0.4  # above the arrow, not on the surface's line
            place = towards(middle - aside if low else middle + aside, VECTOR * near - 16)
        names = " = " if _coincide(group) else ", "
        label = names.join(name for name, _, _ in group)
        level = -9.0 if abs(math.cos(middle)) < 0.12 else 4.5  # clear of the surface's own line
        yield text((place[0], place[1] + level), label, f"{group[0][2]} strong ground", "middle")


def _coincide(group: list[Direction]) -> bool:
    return _apart(group[0], group[-1]) < 1e-6


def _apart(first: Direction, second: Direction) -> float:
    return abs(math.remainder(first[1] - second[1], 2 * math.pi))


def lamp_place(light_rad: float) -> tuple[float, float]:
    """The lamp, nearer to the foot below the surface, where there is less space."""
    return towards(light_rad, lamp_distance(light_rad))


def lamp_distance(light_rad: float) -> float:
    """Its drawn distance from the foot."""
    below = -math.cos(light_rad)
    return LAMP_DISTANCE if below <= 0 else min(LAMP_DISTANCE, DEEPEST / below)


def towards(turn_rad: float, length: float) -> tuple[float, float]:
    """The place at an angle from the normal and a distance from the foot."""
    return FOOT[0] + length * math.sin(turn_rad), FOOT[1] - length * math.cos(turn_rad)
