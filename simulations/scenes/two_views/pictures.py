"""The two pictures: the lamp in each, and the epipolar line in the right one."""

import math

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import Panel, Raster, format_number
from simulations.models.arrays import Floats
from simulations.models.geometry.line_clipping import line_in_rectangle
from simulations.models.geometry.transforms import clip_half_plane
from simulations.models.projection.pinhole import project
from simulations.scenes.two_views.view import (
    EYE_M,
    HALF_HEIGHT_PX,
    HALF_WIDTH_PX,
    View,
    in_picture,
)

WIDTH, HEIGHT = 400.0, 300.0
MIDDLE = np.array([200.0, 150.0])
UNITS_PER_PX = 2.0
MARKED_DEPTHS = (2.0, 4.0, 8.0, 16.0, math.inf)
"""Depths marked on the epipolar line, metres."""
BORDERS = (
    (1, 0, HALF_WIDTH_PX),
    (-1, 0, HALF_WIDTH_PX),
    (0, 1, HALF_HEIGHT_PX),
    (0, -1, HALF_HEIGHT_PX),
)
"""A picture, as half planes a x + b y + c ≥ 0 of its pixels."""
LABEL_WIDTH = 34.0
"""Width of a depth's label, in units."""
SHIFT_BELOW = 26.0
"""Distance of the disparity's arrow below the images, in units."""


def place(pixel: Floats) -> Floats:
    """Pixel to view box."""
    return MIDDLE + UNITS_PER_PX * np.asarray(pixel)


def pixel_at(spot: drawing.Point) -> Floats:
    """View box to pixel."""
    return (np.asarray(spot, float) - MIDDLE) / UNITS_PER_PX


def left_panel(view: View, floor: Raster) -> Panel:
    foot = project(_foot(view), view.pair.K)[0]
    overlay = _post(view.left, foot) + _image(view.left)
    return Panel("left", "What the left camera sees", WIDTH, HEIGHT, floor, overlay)


def right_panel(view: View, floor: Raster, line: bool) -> Panel:
    foot = view.pair.right(_foot(view))
    parts = [_post(view.right, foot)]
    if line:
        parts += [_row(view), _line(view), _depths(view)]
    parts += [_disparity(view), _image(view.right)]
    return Panel("right", "What the right camera sees", WIDTH, HEIGHT, floor, "".join(parts))


def _foot(view: View) -> Floats:
    """Foot of the lamp's post, on the floor, below the cameras."""
    X, _, Z = view.point
    return np.array([X, EYE_M, Z])


def _within(points: Floats) -> Floats:
    """A polyline, in pixels, clipped to the picture."""
    for limit in BORDERS:
        points = clip_half_plane(points, limit, closed=False)
    return points


def _drawn(points: Floats, style: str) -> str:
    inside = _within(points)
    return drawing.polyline([place(point) for point in inside], style) if len(inside) > 1 else ""


def _post(top: Floats, foot: Floats) -> str:
    return _drawn(np.array([top, foot]), "world bold")


def _image(pixel: Floats) -> str:
    """The lamp, or its direction if it is outside the picture."""
    if not in_picture(pixel):
        text = f"outside, to the {'left' if pixel[0] < 0 else 'right'}"
        return drawing.text((WIDTH / 2.0, 22.0), text, "image ground", "middle")
    return drawing.dot(place(pixel), "image", 5.0)


def _row(view: View) -> str:
    """The row of the match for parallel cameras."""
    row = float(view.left[1])
    return _drawn(np.array([(-HALF_WIDTH_PX, row), (HALF_WIDTH_PX, row)]), "muted thin dashed")


def _line(view: View) -> str:
    """The whole line, with depths from 1 m to infinity in bold."""
    borders = np.array([HALF_WIDTH_PX, HALF_HEIGHT_PX])
    whole = line_in_rectangle(view.line, -borders, borders)
    seen = np.array([view.pair.right(view.at(1.0)), view.pair.vanishing(view.left)])
    return _drawn(whole, "ray thin faint") + _drawn(seen, "ray")


def _depths(view: View) -> str:
    """Marks on the line, with labels above it; those near one another or the lamp are left out."""
    parts, taken = [], [float(place(view.right)[0])]
    for depth in MARKED_DEPTHS:
        endless = math.isinf(depth)
        pixel = view.pair.vanishing(view.left) if endless else view.pair.right(view.at(depth))
        if not in_picture(pixel):
            continue
        x, y = place(pixel)
        if all(abs(x - other) >= LABEL_WIDTH for other in taken) and 20.0 < x < WIDTH - 20.0:
            taken.append(float(x))
            words = "∞" if endless else f"{depth:.0f} m"
            parts.append(drawing.dot((x, y), "ray", 3.0))
            above = (x, y - 12.0 if y > 30.0 else y + 20.0)
            parts.append(drawing.text(above, words, "ray small ground", "middle"))
    return "".join(parts)


def _disparity(view: View) -> str:
    """The shift from the lamp's place in the left picture to that in the right one, with the
    error."""
    parts = [_drawn(view.matches, "error bold")]
    if in_picture(view.left) and in_picture(view.right):
        start, end = place(view.left), place(view.right)
        level = np.array([0.0, SHIFT_BELOW])
        row = max(start[1], end[1])
        ends = (np.array([start[0], row]) + level, np.array([end[0], row]) + level)
        parts += [
            drawing.line(start, ends[0], "image thin dashed"),
            drawing.line(end, ends[1], "image thin dashed"),
            drawing.arrow(*ends, "image"),
            drawing.circle(start, 5.0, "image"),
        ]
        words = f"d = {format_number(view.disparity, 1)} px"
        left, right = sorted((float(start[0]), float(end[0])))
        fits = right < WIDTH - 90.0
        beside = (right + 10.0 if fits else left - 10.0, ends[0][1] + 4.0)
        parts.append(drawing.text(beside, words, "image small ground", "start" if fits else "end"))
    return "".join(parts)
