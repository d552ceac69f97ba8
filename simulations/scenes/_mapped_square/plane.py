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
TAKEN_Y = {"start": 255.0, "end": 232.0}
"""Baselines, at the left and the right end, of the numbers below the x axis and of its name."""
LABEL_HEIGHT = 12.0
"""Line height of a small label, in view box units."""
LABEL_WIDTH = 60.0
"""Size of a small label with its distance from a line."""


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

    Its label is at its left end (``start``) or its right end, on the other side if it would extend
    out of the view.
    """
    ends = line_in_rectangle(line, *CORNERS)
    if not len(ends):
        return ""
    left, right = ends = to_view(ends)
    if np.hypot(*(right - left)) < 160.0:
        return ""
    at_start = anchor == "start"
    x, y = left if at_start else right
    below = (right[1] < left[1]) == at_start
    y = min(max(y + (15.0 if below else -7.0), 16.0), HEIGHT - 8.0)
    if abs(y - TAKEN_Y[anchor]) < LABEL_HEIGHT:
        y = TAKEN_Y[anchor] + (LABEL_HEIGHT if below else -LABEL_HEIGHT)
    beside = clip_half_plane(ends, (0.0, -1.0, y) if below else (0.0, 1.0, -y), closed=False)
    if len(beside):  # of the line, as far as the label's row
        x = beside[:, 0].min() if at_start else beside[:, 0].max()
    if x > WIDTH - LABEL_WIDTH if at_start else x < LABEL_WIDTH:
        anchor = "end" if at_start else "start"
    x = max(x + 5.0, 7.0) if anchor == "start" else min(x - 5.0, WIDTH - 7.0)
    return drawing.line(left, right, f"{role} dashed") + drawing.text(
        (x, y), label, f"{role} small ground", anchor
    )
