"""Drawings over the picture, over the image plane around it, and in the loupe."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from simulations.engine import drawing
from simulations.engine.drawing import Point
from simulations.engine.frame import format_number
from simulations.engine.plotting.clipping import clipped
from simulations.engine.plotting.labels import Label, Rectangle, place_labels
from simulations.models.arrays import Floats
from simulations.models.geometry.line_clipping import line_in_rectangle
from simulations.models.projection.picture_lens import IDEAL, PictureLens
from simulations.models.projection.single_view import SingleView
from simulations.models.projection.vanishing_lines import pixel_of
from simulations.scenes.single_view.lines import FLOOR, LISTS, Lines, Settings
from simulations.scenes.single_view.lines import HEIGHT as HEIGHTS
from simulations.scenes.single_view.measuring import NORMALS, Found, Lengths, with_error

WIDTH, HEIGHT = 400.0, 300.0  # of every panel, in units
PANEL = (0.0, WIDTH), (0.0, HEIGHT)
LOUPE_COLUMNS, LOUPE_ROWS = 40, 30  # pixels that the loupe shows
FARTHEST = 4.0
"""Largest distance from the picture to a vanishing point in the field, in its longer side."""
STYLES = ("world", "ray", "light", "image", "image")  # colour role of each list
NAMES = ("v₁", "v₂", "v₃")
LARGE = "image large strong ground"  # style of the first length that is measured
LINE = 17.0  # height of a line of text, in units
LARGEST = 60.0  # half the longest axis of an ellipse that is drawn, in units
LETTERS, HANDLE = 1.2, 17.0
"""Size of a label's letters, relative to a figure's, and half the side of a handle's mark, in
units, where the panel is as small as on a phone."""
ALONG = (0.5, 0.35, 0.65, 0.2, 0.8)  # shares of a line at which a label may stand
INSIDE = Rectangle(4.0, 4.0, WIDTH - 4.0, HEIGHT - 4.0)


@dataclass(frozen=True, slots=True)
class Field:
    """A part of the image plane that fills a panel."""

    size: tuple[int, int]
    """Size of the picture, in pixels."""
    left: float
    top: float
    """The corner of the panel in pixels from the corner of the picture."""
    scale: float
    """Units to the pixel."""

    def place(self, pixel: Sequence[float] | Floats) -> tuple[float, float]:
        """The place of a pixel in the panel."""
        x, y = (float(number) for number in pixel)
        return (x + 0.5 - self.left) * self.scale, (y + 0.5 - self.top) * self.scale

    def pixel(self, place: Point) -> tuple[float, float]:
        return self.pixel_x(place[0]) - 0.5, self.pixel_y(place[1]) - 0.5

    def pixel_x[N: (float, Floats)](self, x: N) -> N:
        """Pixels from the left border of the picture."""
        return x / self.scale + self.left

    def pixel_y[N: (float, Floats)](self, y: N) -> N:
        return y / self.scale + self.top


def picture_field(size: tuple[int, int]) -> Field:
    """The picture as large as the lead panel allows, in its middle."""
    return _holding(size, np.zeros(2), np.array(size, float))


def field_around(lines: Lines, found: Found) -> Field:
    """The picture and the vanishing points that are not too far from it.

    The borders are at multiples of a quarter of the picture, so that they mostly keep still while
    an end moves.
    """
    low, high = np.zeros(2), np.array(lines.size, float)
    quarter, middle, reach = high / 4.0, high / 2.0, FARTHEST * max(lines.size)
    for axis in range(3):
        point = finite_point(found.view, axis)
        if point is not None and np.abs(point - middle).max() < reach:
            low, high = np.minimum(low, point), np.maximum(high, point)
    low, high = np.floor(low / quarter - 0.4) * quarter, np.ceil(high / quarter + 0.4) * quarter
    return _holding(lines.size, low, high)


def finite_point(view: SingleView | None, axis: int) -> Floats | None:
    """The pixel (2,) of a vanishing point; none for one at infinity or nearly so."""
    if view is None:
        return None
    x, y, w = view.vanishing[axis]
    limit = 1e3 * view.diagonal
    if abs(w) * limit <= math.hypot(x, y):
        return None
    return np.array([x / w, y / w])


def _holding(size: tuple[int, int], low: Floats, high: Floats) -> Field:
    """The smallest field with the shape of the panel that holds a box of the image plane."""
    panel = np.array([WIDTH, HEIGHT])
    scale = float((panel / (high - low)).min())
    left, top = ((low + high - panel / scale) / 2.0).tolist()
    return Field(size, left, top, scale)


def bent(ends: Floats, lens: PictureLens) -> Floats:
    """Points (N, 2) along a line that is straight in the world, from its ends in the picture."""
    if lens.distortion == IDEAL.distortion:
        return ends
    start, end = lens.straight(ends)
    return lens.bent(start + np.linspace(0.0, 1.0, 17)[:, None] * (end - start))


def over_picture(settings: Settings, lines: Lines, found: Found, lengths: Lengths) -> str:
    """The lines of the chosen list, bold, and what was measured; the horizon. The other lines
    only if they are asked for."""
    field, chosen = picture_field(lines.size), list(LISTS).index(settings.direction)
    lens = found.view.lens if found.view else IDEAL
    parts = [_horizon(field, found.view, settings.plane, "camera dashed")]
    shown = range(len(STYLES)) if settings.all_lines else {FLOOR, HEIGHTS, chosen}
    for number in sorted(shown, key=lambda number: number == chosen):
        manner = " bold" if number == chosen else ""
        for ends, counts in zip(lines.ends[number], lines.placed[number], strict=True):
            style = STYLES[number] + manner if counts else "muted dashed"
            drawn = [field.place(point) for point in bent(ends, lens)]
            parts += (drawing.path([drawn], each) for each in ("casing", style))
    labels = []
    for number, metres in ((FLOOR, lengths.floor), (HEIGHTS, lengths.height)):
        for place, (ends, pair) in enumerate(zip(lines.counted(number), metres, strict=False)):
            is_known = place == 0 and lengths.known == list(LISTS)[number]
            words = f"{format_number(pair[0])} m, known" if is_known else with_error(pair, "m")
            middle, *others = (field.place(ends[0] + s * (ends[1] - ends[0])) for s in ALONG)
            style = "image small ground"
            labels.append(Label(middle, words, style, prefer="below", others=others, scale=LETTERS))
    labels.sort(key=lambda label: label.words.endswith("known"))  # it may stand farther off
    handles = [field.place(end) for end in lines.ends[chosen].reshape(-1, 2)]
    taken = [Rectangle(x - HANDLE, y - HANDLE, x + HANDLE, y + HANDLE) for x, y in handles]
    return "".join(parts) + place_labels(labels, INSIDE, taken=taken)


def over_field(settings: Settings, lines: Lines, found: Found, field: Field) -> str:
    """The picture's border, the lines shown as far as they meet, all their points, the horizon."""
    width, height = (side * field.scale for side in lines.size)
    parts = [drawing.rectangle(field.place((-0.5, -0.5)), width, height, "muted")]
    view = found.view
    chosen = {list(LISTS).index(settings.direction)}
    for axis in {0, 1, 2} if settings.all_lines else {0, 1, 2} & chosen:
        ends = lines.counted(axis)
        straight = view.lens.straight(ends) if view else ends
        parts += _prolonged(field, straight, finite_point(view, axis), STYLES[axis])
    parts.append(_horizon(field, view, settings.plane, "camera bold", "horizon"))
    if view is not None:
        parts += [_vanishing(field, view, axis) for axis in range(3)]
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


def _vanishing(field: Field, view: SingleView, axis: int) -> str:
    """The vanishing point with the ellipse that holds it in 95 of 100 cases, if there is room."""
    point, style = finite_point(view, axis), STYLES[axis]
    x, y = field.place(point) if point is not None else (math.nan, math.nan)
    if point is None or not (0.0 <= x <= WIDTH and 0.0 <= y <= HEIGHT):
        return ""
    mark = drawing.dot((x, y), style, 3.5)
    _, spread, finite = pixel_of(view.vanishing[axis], view.vanishing_covariances[axis])
    if finite:
        mark += _ellipse(field, point, spread, style)
    beside = (min(max(x, 14.0), WIDTH - 14.0), y - 10.0 if y > 2.0 * LINE else y + 20.0)
    return mark + drawing.text(beside, NAMES[axis], f"{style} strong ground", "middle")


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
    a, b, c = np.linalg.solve(view.K.T, view.normal(NORMALS[plane]))
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
    """The reason why there is no camera, or why a number is unknown."""
    words, letters, x, anchor = found.problem, 40, WIDTH / 2.0, "middle"
    if not words:
        letters, x, anchor = 20, 8.0, "start"  # clear of lines that meet below
        if found.misfits:
            words = (
                "The lines miss each other: check their directions, or raise the error of an end."
            )
        elif not found.knows_focal:
            words = "The focal length cannot be told: lengths in depth stay unknown."
        else:
            return ""
    lines = [""]
    for word in words.split():
        if len(lines[-1]) + len(word) > letters:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    base = HEIGHT - 10.0 - LINE * (len(lines) - 1)
    return "".join(
        drawing.text((x, base + LINE * row), line, "error ground", anchor)
        for row, line in enumerate(lines)
    )


def in_loupe(lines: Lines, settings: Settings) -> str:
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
    at, other, style = (x, y), (u, v), STYLES[number]
    parts = [drawing.cased(drawing.circle, at, 12.0, style=style)]
    if (part := clipped(at, other, *PANEL)) is not None:
        parts.append(drawing.line(*part, style))
    return "".join((*parts, drawing.dot(at, style, 2.5)))
