"""The plane of the square: its axes, the square, and the lines at infinity."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine import drawing
from simulations.models.arrays import Floats
from simulations.models.geometry.line_clipping import line_in_rectangle
from simulations.models.geometry.transforms import (
    apply_homography,
    clip_half_plane,
    clip_to_visible,
)
from simulations.scenes._mapped_square.square import GRID, LETTER, SQUARE

WIDTH, HEIGHT = 400.0, 340.0
SCALE = 1.6
"""View box units per unit of the plane."""
ORIGIN = np.array([104.0, 240.0])
"""The plane's origin in the view box; the plane's y axis points up."""
RIM = 4.0
"""Margin around the view box, in its units, that hides cut edges."""
FRAME = ((1, 0, RIM), (-1, 0, WIDTH + RIM), (0, 1, RIM), (0, -1, HEIGHT + RIM))
"""The view box and its rim, as half planes a x + b y + c ≥ 0."""
SHORTEST = 160.0
"""Length of a line in the view, in its units, from which it is drawn and named."""
LABEL_FROM_END, LABEL_HALF = 50.0, 34.0
"""Distance of a line's label from the line's end, and half the label's width with a margin."""


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


CORNERS = from_view((-RIM, HEIGHT + RIM)), from_view((WIDTH + RIM, -RIM))
"""The lowest and the highest coordinates of the plane that the frame shows."""


def label_at(point: ArrayLike, right: float, down: float) -> Floats:
    """Place of a label in the view box, at an offset from a point of the plane."""
    return to_view(point) + np.array([right, down])


def in_frame(points: ArrayLike, closed: bool = True) -> Floats:
    """Plane to view box, clipped to it; may be empty."""
    view = to_view(points)
    for edge in FRAME:
        view = clip_half_plane(view, edge, closed)
    return view


def axes() -> str:
    ticks = (
        drawing.text(label_at((100, 0), 0, 15), "100", "muted small ground", "middle"),
        drawing.text(label_at((0, 100), -7, 4), "100", "muted small ground", "end"),
    )
    rules = [[(x, -60), (x, 148)] for x in (-50, 50, 100, 150)]
    rules += [[(-63, y), (184, y)] for y in (-50, 50, 100)]
    return (
        drawing.path([to_view(rule) for rule in rules], "muted thin faint")
        + drawing.arrow(to_view((-63, 0)), to_view((184, 0)), "muted thin")
        + drawing.arrow(to_view((0, -60)), to_view((0, 148)), "muted thin")
        + drawing.text(label_at((184, 0), 0, -8), "x", "muted italic", "end")
        + drawing.text(label_at((0, 148), 9, 11), "y", "muted italic")
        + "".join(ticks)
    )


def figure(H: Floats, role: str) -> str:
    """The square with its grid and letter, moved by H."""
    outline = in_frame(image_of(H, SQUARE).points)
    bars = [in_frame(image_of(H, bar).points) for bar in LETTER]
    grid = [in_frame(image_of(H, rule, closed=False).points, closed=False) for rule in GRID]
    return (
        (drawing.polygon(outline, f"{role} fill") if len(outline) else "")
        + drawing.path([rule for rule in grid if len(rule) > 1], f"{role} thin faint")
        + drawing.group(
            [drawing.polygon(bar, f"{role} solid") for bar in bars if len(bar)], "faint"
        )
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
    ends = line_in_rectangle(line, *CORNERS)
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
