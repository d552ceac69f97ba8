"""The plane of the square: the square and its image, lines at infinity, P and its image P′."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import accumulate, pairwise

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine import drawing
from simulations.engine.frame import format_number
from simulations.models.arrays import Floats
from simulations.models.geometry.line_clipping import line_in_rectangle
from simulations.models.geometry.transforms import (
    apply_homography,
    clip_to_rectangle,
    clip_to_visible,
    sign_of_w,
    translation,
)
from simulations.pictures import playing_card
from simulations.scenes._mapped_square import family
from simulations.scenes._mapped_square.family import HALF, SQUARE

WIDTH, HEIGHT = 400.0, 340.0
SCALE = 1.6  # view box units per unit of the plane
ORIGIN = np.array([104.0, 240.0])  # of the plane in the view box; the plane's y axis points up
RIM = 4.0  # margin around the view box, in its units, that hides cut edges
FRAME = (-RIM, -RIM), (WIDTH + RIM, HEIGHT + RIM)
SHORTEST = 160.0  # length of a line in the view box from which it is drawn and named
LABEL_FROM_END, LABEL_HALF = 50.0, 34.0
"""Distance of a line's label from the line's end, and half the label's width with a margin."""
CLEAR = 15.0  # from a point to its label, in view box units, with space for a handle between
LETTER_WIDTH = 8.2  # of the widest letter of a label
STATIONS = np.linspace(-HALF, HALF, 5)
GRID = np.array(
    [[[(s, -HALF), (s, HALF)] for s in STATIONS], [[(-HALF, s), (HALF, s)] for s in STATIONS]]
).reshape(10, 2, 2)
"""The square's sides and inner grid lines."""
SEGMENTS = np.concatenate([GRID, [SQUARE[[0, 2]], SQUARE[[1, 3]]]])
"""The sides, the grid lines and the diagonals, (12, 2, 2)."""


@dataclass(frozen=True, slots=True)
class Clipped:
    """The visible image of a polygon or polyline."""

    points: Floats
    """(N, 2) in the plane; N = 0 where nothing is visible."""
    cut: bool
    """Whether a part is on or beyond the line that is mapped to infinity."""


def image_of(H: Floats, points: ArrayLike, closed: bool = True) -> Clipped:
    before = np.asarray(points, float)
    visible = clip_to_visible(H, before, closed=closed)
    return Clipped(apply_homography(H, visible)[0], not np.array_equal(visible, before))


def to_view(points: ArrayLike) -> Floats:
    """Plane to view box."""
    return np.asarray(points, float) * [SCALE, -SCALE] + ORIGIN


def from_view(place: ArrayLike) -> Floats:
    """View box to plane."""
    return (np.asarray(place, float) - ORIGIN) / [SCALE, -SCALE]


def label_at(point: ArrayLike, right: float, down: float) -> Floats:
    """Place of a label in the view box, at an offset from a point of the plane."""
    return to_view(point) + np.array([right, down])


def in_frame(points: ArrayLike, closed: bool = True) -> Floats:
    """Plane to view box, clipped to it; may be empty."""
    return clip_to_rectangle(to_view(points), *FRAME, closed)


@cache
def axes() -> str:
    rules = [[(x, -60), (x, 148)] for x in (-50, 50, 100, 150)]
    rules += [[(-63, y), (184, y)] for y in (-50, 50, 100)]
    return (
        drawing.path([to_view(rule) for rule in rules], "muted thin faint")
        + drawing.arrow(to_view((-63, 0)), to_view((184, 0)), "muted thin")
        + drawing.arrow(to_view((0, -60)), to_view((0, 148)), "muted thin")
        + drawing.text(label_at((184, 0), 0, -8), "x", "muted italic", "end")
        + drawing.text(label_at((0, 148), 9, 11), "y", "muted italic")
        + drawing.text(label_at((100, 0), 0, 15), "100", "muted small ground", "middle")
        + drawing.text(label_at((0, 100), -7, 4), "100", "muted small ground", "end")
    )


def clipped_images(H: Floats, shapes: Sequence[Floats]) -> list[Floats]:
    """Images of a polygon, and of others and lines inside it, in the view box and clipped to it."""
    closed = [len(shape) > 2 for shape in shapes]
    if image_of(H, shapes[0]).cut:
        images = [image_of(H, *each).points for each in zip(shapes, closed, strict=True)]
        return [in_frame(*each) for each in zip(images, closed, strict=True)]
    together = to_view(apply_homography(H, np.concatenate(shapes))[0])
    within = (together >= FRAME[0]) & (together <= FRAME[1])
    inside = np.logical_and.reduce(within, axis=1)
    bounds = pairwise(accumulate(map(len, shapes), initial=0))
    return [
        together[start:end]
        if inside[start:end].all()
        else clip_to_rectangle(together[start:end], *FRAME, is_closed)
        for (start, end), is_closed in zip(bounds, closed, strict=True)
    ]


@cache
def original(right: float = 0.0, up: float = 0.0) -> str:
    """The square before it is mapped, which may be shown elsewhere."""
    return figure(translation(right, up), "world")


def figure(H: Floats, role: str) -> str:
    """The square with its grid and the card that lies on it, moved by H."""
    shapes = (SQUARE, *GRID, playing_card.OUTLINE, *playing_card.MARKS)
    outline, *rest = clipped_images(H, shapes)
    grid, (card, *marks) = rest[: len(GRID)], rest[len(GRID) :]
    return (
        (drawing.polygon(outline, f"{role} fill") if len(outline) else "")
        + drawing.path([rule for rule in grid if len(rule) > 1], f"{role} thin faint")
        + drawing.group([playing_card.card_markup(card, marks)], "" if role == "image" else "faint")
        + (drawing.polygon(card, f"{role} thin") if len(card) else "")
    )


def lines_at_infinity(H: Floats) -> str:
    """The line that H maps to infinity, and the horizon, the image of the points at infinity."""
    if not H[2, :2].any():
        return ""
    horizon = np.linalg.inv(H).T @ (0.0, 0.0, 1.0)
    return labelled_line(H[2], "w = 0", "error", "end") + labelled_line(
        horizon, "horizon", "image", "start"
    )


def labelled_line(line: Floats, label: str, role: str, anchor: str) -> str:
    """A line a x + b y + c = 0 of the plane, clipped to the view.

    Its label interrupts it near its left end (``start``) or its right end.
    """
    corners = from_view((-RIM, HEIGHT + RIM)), from_view((WIDTH + RIM, -RIM))
    ends = line_in_rectangle(line, *corners)
    if not len(ends):
        return ""
    left, right = to_view(ends)
    length = float(np.hypot(*(right - left)))
    if length < SHORTEST:
        return ""
    share = LABEL_FROM_END / length
    x, y = left + (share if anchor == "start" else 1.0 - share) * (right - left)
    place = (min(max(x, LABEL_HALF), WIDTH - LABEL_HALF), min(max(y + 4.0, 16.0), HEIGHT - 8.0))
    return drawing.line(left, right, f"{role} dashed") + drawing.text(
        place, label, f"{role} small ground", "middle"
    )


def corners(kind: str, H: Floats) -> Iterator[str]:
    """Images of the corners that a pull keeps fixed, as pins; the one to pull, solid."""
    images, valid = apply_homography(H, SQUARE)
    for index, place in enumerate(to_view(images)):
        inside = valid[index] and np.all(place >= 0.0) and np.all(place <= (WIDTH, HEIGHT))
        if inside and index == family.PULLED:
            yield drawing.rectangle(place - 5.0, 10.0, 10.0, "image solid")
        elif inside and index in family.FIXED[kind]:
            yield drawing.rectangle(place - 4.0, 8.0, 8.0, "image solid faint")


def point_and_image(H: Floats, matrices: Floats, point: Floats) -> str:
    """P, its image P′ and their coordinates.

    ``matrices`` (N, 3, 3) are the matrices of all amounts: P′ slides along a curve, of which the
    part on its side of infinity is drawn. Without any there is no curve.
    """
    before = to_view(point)
    image, valid = apply_homography(H, point)
    parts = [drawing.path(_track(matrices, point, H), "image thin faint")] if len(matrices) else []
    torn = sign_of_w(H, point) != sign_of_w(H, (0.0, 0.0))
    after = in_frame(image[None], closed=False) if valid else np.empty((0, 2))
    if len(after):
        if not torn:
            parts.append(drawing.line(before, after[0], "image thin dashed"))
        parts.append(drawing.dot(after[0], "image", 4.5))
        parts.append(_name_of_image(image, after[0]))
    near = before[0] < 2.0 * CLEAR  # to the left border: the name is on the right
    x, y = before + np.array([CLEAR if near else -CLEAR, -9.0 if before[1] > 26.0 else 17.0])
    parts.append(drawing.dot(before, "world", 4.5))
    parts.append(drawing.text((x, y), "P", "world ground strong", "start" if near else "end"))
    return "".join(parts)


def _track(matrices: Floats, point: Floats, H: Floats) -> list[Floats]:
    """Runs of places (n, 2) of P′ on its side of infinity, interrupted where it is out of view."""
    images = matrices @ np.array([*point, 1.0])
    w = images[:, 2]
    places = to_view(images[:, :2] / np.where(w == 0.0, np.nan, w)[:, None])
    near = np.all((places >= -4.0) & (places <= [WIDTH + 4.0, HEIGHT + 4.0]), axis=1)
    near &= np.sign(w) == sign_of_w(H, point)
    parted = np.flatnonzero(np.diff(near)) + 1
    runs = zip(np.split(places, parted), np.split(near, parted), strict=True)
    return [run for run, visible in runs if visible[0] and len(run) > 1]


def _name_of_image(point: Floats, place: Floats) -> str:
    """Name and coordinates of P′, on its right, or at the right border and farther from its row;
    away from the axis, on the side that its square is not on."""
    words = f"P′ {coordinates(point, 1)}"
    last = WIDTH - CLEAR - LETTER_WIDTH * len(words)
    above = place[1] > 26.0 and (point[1] >= 0.0 or place[1] > HEIGHT - 26.0)
    aside = CLEAR + 10.0 * (place[0] > last)
    row = place[1] + 4.0 - aside if above else min(place[1] + aside, HEIGHT - 6.0)
    corner = (min(place[0], last) + CLEAR, row)
    return drawing.text(corner, words, "image ground strong")


def area_ratio(H: Floats) -> float:
    """Ratio of the areas of the square's image and the square; infinite if it is cut."""
    image = image_of(H, SQUARE)
    return math.inf if image.cut else area(image.points) / area(SQUARE)


def area(polygon: Floats) -> float:
    """Area by the shoelace formula."""
    x, y = polygon[:, 0], polygon[:, 1]
    return 0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def describe_point(H: Floats, point: Floats) -> str:
    """The image of P, in words."""
    image, valid = apply_homography(H, point)
    there = coordinates(image, 1) if valid else "infinity"
    return f"P at {coordinates(point, 0)} goes to {there}."


def coordinates(point: Floats, digits: int) -> str:
    x, y = (format_number(float(value), digits) for value in point)
    return f"({x}, {y})"
