"""The drawings of the Phong scene: marks on the vase, the lobe at the probed point, and how the
highlight fades as the camera turns away from it.

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
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.engine.plotting.legend import Entry, legend
from simulations.models.arrays import Floats
from simulations.scenes import _ball
from simulations.scenes._ball import HEIGHT, WIDTH, outlined_dot
from simulations.scenes._turned_camera import body_from_above

type Direction = tuple[str, float, str]
"""Letter, angle from the normal in radians, colour role."""

FOOT = (WIDTH / 2, 232.0)
VECTOR = 122.0  # length of a unit vector, and of a brightness of 1
LAMP_DISTANCE = 150.0  # drawn distance of the lamp above the surface; it is far away
CAMERA_UNIT = 26.0  # drawn length of its axes
DEEPEST = HEIGHT - FOOT[1] - 20.0  # largest drawn depth of the lamp below the surface
AROUND_HIGHLIGHT = 9.0  # radius of its mark, large enough for a sharp highlight inside it
ABOVE_HIGHLIGHT = 56.0  # its handle is so far above that the finger hides neither it nor the point
STEM = 49.0  # from its centre to the end of the line to the handle
SAME_RAD = math.radians(9.0)  # directions nearer than this share one label

PLOT = Plot(Axis(0.0, 60.0, 46.0, 384.0), Axis(0.0, 1.0, 282.0, 44.0))
TURN = Scale(
    "turn of the camera from the middle",
    ticks=[(degrees, f"{degrees}°") for degrees in (0, 30, 60)],
    centred=True,
)
STRENGTH = Scale(ticks=(0, 1), grid=(1,))
DEGREES = np.arange(0.0, 60.5, 0.5)


def over_vase(light_rad: float, probe_rad: float) -> str:
    """Terminator, centre of the highlight, probed point."""
    parts = [_ball.shadow_edge(light_rad, _ball.VASE)]
    if abs(abs(light_rad) - math.pi) > 1e-9:
        spot = _ball.on_equator(light_rad / 2)
        rim, end = (spot[0], spot[1] - AROUND_HIGHLIGHT), (spot[0], spot[1] - STEM)
        for style in ("casing", "ray"):
            parts += [circle(spot, AROUND_HIGHLIGHT, style), line(rim, end, style)]
        name = (spot[0] + 14, spot[1] - ABOVE_HIGHLIGHT + 4)
        parts.append(text(name, "highlight", "ray small ground"))
    probed = _ball.on_equator(probe_rad)
    parts += [outlined_dot(probed, "world"), _ball.named(probed, "probed point", "world")]
    return "".join(parts)


def highlight_grip(light_rad: float) -> tuple[float, float]:
    """Place of the highlight's handle, above the point whose normal halves the angle of lamp and
    camera."""
    across, down = _ball.on_equator(light_rad / 2)
    return across, down - ABOVE_HIGHLIGHT


def lobe_plot(
    light_rad: float,
    view_rad: float,
    lobes: tuple[Floats, Floats],
    matte: float,
    names: tuple[str, str],
) -> str:
    """Directions and lobe, all relative to the normal.

    ``lobes`` are the brightness (181,) to cameras at −90°…90° by the chosen model and by the other
    one, ``names`` the names of both; ``matte`` is the part that is equal for all.
    """
    brightness, other = lobes
    parts = [
        lobe_scale(),
        curve_names(names, Entry("matte", "world dashed")),
        line((24, FOOT[1]), (WIDTH - 24, FOOT[1]), "world bold"),
        text((26, FOOT[1] + 20), "surface", "world small"),
    ]
    tip = VECTOR * float(brightness[round(math.degrees(view_rad)) + 90])
    if brightness.max() > 0:
        parts += [
            polyline(outline(other), "muted thin dashed"),
            polygon(outline(brightness), "ray fill"),
            polyline(outline(np.full(181, matte)), "world dashed"),
            outlined_dot(towards(view_rad, tip), "image"),  # brightness of the camera's pixel
        ]
    return "".join((*parts, *vectors(light_rad, view_rad, tip)))


def curve_names(names: tuple[str, str], *more: Entry) -> str:
    """The legend above a plot of both models, the chosen one first."""
    entries = (Entry(names[0], "ray bold"), Entry(names[1], "muted dashed"), *more)
    return legend((46.0, 24.0), entries, "small")


@cache
def lobe_scale() -> str:
    """Half circles of brightness 0.5 and 1: the same in every frame, so drawn once."""
    circles = [polyline(outline(np.full(181, level)), "muted thin faint") for level in (0.5, 1.0)]
    white = text((FOOT[0] + VECTOR + 4, FOOT[1] + 15), "I = 1", "muted small", "middle")
    half = text((FOOT[0] + VECTOR / 2, FOOT[1] + 15), "0.5", "muted small", "middle")
    return "".join((*circles, white, half))


def outline(brightness: Floats) -> list[Point]:
    around = np.radians(np.arange(-90.0, 91.0))
    x, y = FOOT[0] + VECTOR * brightness * np.sin(around), FOOT[1]
    return list(zip(x, y - VECTOR * brightness * np.cos(around), strict=True))


def vectors(light_rad: float, view_rad: float, tip: float) -> Iterator[str]:
    """n, l, v, the mirrored r and the halfway h; a label names both of two that coincide.

    ``tip`` is the distance from the foot of the dot on v, which no label may cover.
    """
    found = [("n", 0.0, "world"), ("l", light_rad, "light"), ("v", view_rad, "camera")]
    lit = math.cos(light_rad) > 0
    if lit:
        found.append(("r", -light_rad, "ray"))
    between = math.remainder(light_rad - view_rad, 2 * math.pi)
    if lit and abs(abs(between) - math.pi) > 1e-9:
        found.append(("h", view_rad + between / 2, "muted"))
    near = lamp_distance(light_rad) / LAMP_DISTANCE
    for name, turn, role in found:
        yield arrow(FOOT, towards(turn, VECTOR * near if name == "l" else VECTOR), f"{role} bold")
    yield dot(FOOT, "world", 4.5)
    yield body_from_above(towards(view_rad, VECTOR), FOOT, CAMERA_UNIT)
    yield _ball.lamp(lamp_place(light_rad))
    if lit and abs(light_rad) >= SAME_RAD:
        # Equal angles on both sides of the normal: the mirror turns l into r.
        turns = (light_rad, -light_rad)
        arcs = [[towards(turn * step / 16, 30.0) for step in range(17)] for turn in turns]
        yield path(arcs, "muted thin")
    yield from vector_labels(found, tip, near)


def vector_labels(found: list[Direction], tip: float, near: float) -> Iterator[str]:
    """One label for each group of directions within a few degrees of one another.

    ``near`` is the length of l as a share of the others'.
    """
    groups: list[list[Direction]] = []
    for vector in sorted(found, key=lambda item: math.remainder(item[1], 2 * math.pi)):
        if groups and azimuth_difference(groups[-1][-1], vector) < SAME_RAD:
            groups[-1].append(vector)
        else:
            groups.append([vector])
    for group in groups:
        middle = group[len(group) // 2][1]
        letters = [name for name, _, _ in group]
        length = VECTOR + 22 + 5 * (len(group) - 1)
        if "v" in letters and abs(tip - length) < 18:
            length = tip + 18
        place = towards(middle, length)
        if "l" in letters:  # next to the arrow, as the lamp is beyond it
            aside = math.copysign(0.2, math.sin(middle))
            low = 0.0 <= math.cos(middle) < 0.4  # above the arrow, not on the surface's line
            place = towards(middle - aside if low else middle + aside, VECTOR * near - 16)
        label = (" = " if azimuth_difference(group[0], group[-1]) < 1e-6 else ", ").join(letters)
        level = -9.0 if abs(math.cos(middle)) < 0.12 else 4.5  # clear of the surface's own line
        yield text((place[0], place[1] + level), label, f"{group[0][2]} strong ground", "middle")


def azimuth_difference(first: Direction, second: Direction) -> float:
    return abs(math.remainder(first[1] - second[1], 2 * math.pi))


def lamp_place(light_rad: float) -> tuple[float, float]:
    """The lamp, nearer to the foot below the surface, where there is less space."""
    return towards(light_rad, lamp_distance(light_rad))


def lamp_distance(light_rad: float) -> float:
    below = -math.cos(light_rad)
    return LAMP_DISTANCE if below <= 0 else min(LAMP_DISTANCE, DEEPEST / below)


def towards(turn_rad: float, length: float) -> tuple[float, float]:
    """The place at an angle from the normal and a distance from the foot."""
    return FOOT[0] + length * math.sin(turn_rad), FOOT[1] - length * math.cos(turn_rad)


def width_plot(names: tuple[str, str], fadings: tuple[Floats, Floats], half: Point | None) -> str:
    """The highlight at `DEGREES` (121,) by the chosen model and the other, as a share of its
    middle; ``half`` is the place at which the chosen one has half its strength."""
    x, y = PLOT.at(60, 0.5)
    return "".join(
        (
            PLOT.frame(TURN, STRENGTH),
            curve_names(names),
            PLOT.level(0.5, "muted thin"),
            text((x, y - 7), "half", "muted small", "end"),
            PLOT.curve(DEGREES, fadings[1], "muted thin dashed"),
            PLOT.curve(DEGREES, fadings[0], "ray bold"),
            outlined_dot(half, "ray", 5) if half else "",
        )
    )
