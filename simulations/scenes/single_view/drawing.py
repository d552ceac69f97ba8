"""Drawings over the picture, over the image plane around it, and in the loupe."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import format_number
from simulations.engine.plotting.clipping import clipped
from simulations.models.arrays import Floats
from simulations.models.geometry.line_clipping import line_in_rectangle
from simulations.models.projection.single_view import SingleView
from simulations.models.projection.vanishing_lines import pixel_of
from simulations.scenes.single_view.fields import (
    HEIGHT,
    LOUPE_COLUMNS,
    LOUPE_ROWS,
    WIDTH,
    Field,
    Point,
    finite_point,
    whole,
)
from simulations.scenes.single_view.labels import beside_lines
from simulations.scenes.single_view.lines import FLOOR, Drawn
from simulations.scenes.single_view.lines import HEIGHT as HEIGHTS
from simulations.scenes.single_view.settings import LISTS, NORMALS, Settings
from simulations.scenes.single_view.stages import UNKNOWN, Found, Lengths

STYLES = ("world", "ray", "light", "image", "image")
"""Colour role of each list."""
NAMES = ("v₁", "v₂", "v₃")
PANEL = (0.0, WIDTH), (0.0, HEIGHT)
LINE = 17.0
"""Height of a line of text, in units."""
LARGEST = 60.0
"""Half the longest axis of an ellipse that is drawn, in units."""


def over_picture(settings: Settings, lines: Drawn, found: Found, lengths: Lengths) -> str:
    """The lines, those of the chosen list bold; the horizon; what was measured."""
    field, chosen = whole(lines.size), list(LISTS).index(settings.direction)
    parts = [_horizon(field, found.view, settings.plane, "camera dashed")]
    for number in sorted(range(len(STYLES)), key=lambda number: number == chosen):
        manner = " bold" if number == chosen else ""
        for ends, counts in zip(lines.ends[number], lines.placed[number], strict=True):
            start, end = field.place(ends[0]), field.place(ends[1])
            style = STYLES[number] + manner if counts else "muted dashed"
            parts.append(drawing.line(start, end, "casing") + drawing.line(start, end, style))
    parts.append(_lengths(field, lines, lengths, chosen))
    return "".join(parts)


def _lengths(field: Field, lines: Drawn, lengths: Lengths, chosen: int) -> str:
    """What was measured, by its line; clear of the ends of the chosen list."""
    labels = []
    for number, metres in ((FLOOR, lengths.floor), (HEIGHTS, lengths.height)):
        for place, (ends, pair) in enumerate(zip(lines.counted(number), metres, strict=False)):
            is_known = place == 0 and lengths.known == list(LISTS)[number]
            words = f"{format_number(pair[0])} m, known" if is_known else with_error(*pair, "m")
            labels.append((field.place(ends[0]), field.place(ends[1]), words))
    labels.sort(key=lambda label: label[2].endswith("known"))  # it may stand farther off
    handles = [field.place(end) for end in lines.ends[chosen].reshape(-1, 2)]
    return beside_lines(labels, handles, "image small ground")


def with_error(value: float, error: float, unit: str, digits: int = 2) -> str:
    """``2.13 ± 0.04 m``; in words for what is unknown."""
    if not math.isfinite(value):
        return "beyond the horizon"
    if not error < UNKNOWN * abs(value):
        return "cannot be told"
    return f"{format_number(value, digits)} ± {format_number(error, digits)} {unit}".strip()


def over_field(settings: Settings, lines: Drawn, found: Found, field: Field) -> str:
    """The picture's border, the lines as far as they meet, their points, and the horizon."""
    parts = [
        drawing.rectangle(
            field.place(np.array([-0.5, -0.5])),
            lines.size[0] * field.scale,
            lines.size[1] * field.scale,
            "muted",
        )
    ]
    view = found.view
    for axis in range(3):
        parts += _prolonged(field, lines.counted(axis), finite_point(view, axis), STYLES[axis])
    parts.append(_horizon(field, view, settings.plane, "camera bold", "horizon"))
    for axis in range(3):
        parts.append(_vanishing(field, view, axis))
    parts.append(_remark(found))
    return "".join(parts)


def _prolonged(field: Field, ends: Floats, point: Floats | None, style: str) -> Iterator[str]:
    for line in ends:
        start, end = (field.place(each) for each in line)
        yield drawing.line(start, end, f"{style} bold")
        if point is not None:
            near = min(line, key=lambda each: math.dist(each, point))
            if (part := clipped(field.place(near), field.place(point), *PANEL)) is not None:
                yield drawing.line(*part, f"{style} thin dashed")


def _vanishing(field: Field, view: SingleView | None, axis: int) -> str:
    """The vanishing point with the ellipse that holds it in 95 of 100 cases, if there is room."""
    point = finite_point(view, axis)
    if view is None or point is None or not _inside(place := field.place(point)):
        return ""
    _, spread, finite = pixel_of(view.vanishing[axis], view.vanishing_covariances[axis])
    x = min(max(place[0], 14.0), WIDTH - 14.0)
    y = place[1] - 10.0 if place[1] > 2.0 * LINE else place[1] + 20.0
    mark = drawing.dot(place, STYLES[axis], 3.5)
    if finite:
        mark += _ellipse(field, point, spread, STYLES[axis])
    return mark + drawing.text((x, y), NAMES[axis], f"{STYLES[axis]} strong ground", "middle")


def _ellipse(field: Field, point: Floats, spread: Floats, style: str) -> str:
    variances, axes = np.linalg.eigh(spread)
    radii = math.sqrt(-2.0 * math.log(0.05)) * np.sqrt(np.maximum(variances, 0.0))
    if not 1.0 < radii.max() * field.scale < LARGEST:
        return ""
    angle = np.linspace(0.0, 2.0 * math.pi, 49)
    ring = point + (np.column_stack([np.cos(angle), np.sin(angle)]) * radii) @ axes.T
    return drawing.polygon([field.place(each) for each in ring[:-1]], f"{style} fill thin")


def _horizon(field: Field, view: SingleView | None, plane: str, style: str, name: str = "") -> str:
    """The line on which all directions of the plane vanish, where it crosses the panel."""
    if view is None:
        return ""
    a, b, c = np.linalg.solve(view.K.T, view.R[:, NORMALS[plane]])
    corners = field.pixel((0.0, 0.0)), field.pixel((WIDTH, HEIGHT))
    ends = line_in_rectangle((a, b, c), *corners)
    if not len(ends):
        return ""
    start, end = (field.place(each) for each in ends)
    made = drawing.line(start, end, style)
    if name:
        left = (min(max(start[0] + 6.0, 6.0), WIDTH - 70.0), min(max(start[1] - 6.0, LINE), 290.0))
        made += drawing.text(left, name, "camera small ground")
    return made


def _remark(found: Found) -> str:
    """Why there is no camera, or what cannot be known."""
    if found.problem:
        return _in_lines(_wrapped(found.problem, 40), WIDTH / 2.0, "middle")
    if found.misfits:
        words = "The lines miss each other: check their directions, or raise the error of an end."
    elif not found.knows_focal:
        words = "The focal length cannot be told: lengths in depth stay unknown."
    else:
        return ""
    return _in_lines(_wrapped(words, 20), 8.0, "start")  # clear of lines that meet below


def _in_lines(lines: tuple[str, ...], x: float, anchor: str) -> str:
    base = HEIGHT - 10.0 - LINE * (len(lines) - 1)
    return "".join(
        drawing.text((x, base + LINE * row), words, "error ground", anchor)
        for row, words in enumerate(lines)
    )


def _wrapped(words: str, letters: int) -> tuple[str, ...]:
    """In lines of at most so many letters."""
    lines = [""]
    for word in words.split():
        if len(lines[-1]) + len(word) > letters:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return tuple(lines)


def in_loupe(lines: Drawn, settings: Settings) -> str:
    """The end that was moved last, and its line."""
    number = list(LISTS).index(settings.direction)
    ends = lines.ends[number].reshape(-1, 2)
    if not len(ends):
        middle = (WIDTH / 2.0, HEIGHT / 2.0)
        return drawing.text(middle, "no line yet", "ground", "middle")
    touched = min(lines.points.touched, len(ends) - 1)
    corner = np.rint(ends[touched]) - (LOUPE_COLUMNS // 2, LOUPE_ROWS // 2)
    unit = WIDTH / LOUPE_COLUMNS
    (x, y), (u, v) = ((ends[[touched, touched ^ 1]] - corner + 0.5) * unit).tolist()
    at, other = (x, y), (u, v)
    style = STYLES[number]
    parts = [drawing.circle(at, 12.0, "casing"), drawing.circle(at, 12.0, style)]
    if (part := clipped(at, other, *PANEL)) is not None:
        parts.append(drawing.line(*part, style))
    return "".join((*parts, drawing.dot(at, style, 2.5)))


def _inside(place: Point) -> bool:
    return 0.0 <= place[0] <= WIDTH and 0.0 <= place[1] <= HEIGHT
