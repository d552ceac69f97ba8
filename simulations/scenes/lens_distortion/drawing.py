"""Drawings of the lens-distortion figure: the bent grid, and the limits over its pictures.

The view box is 400 × 300 for the photograph's 320 × 240 px, so that r = 1 is 250 units.
"""

import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np

from simulations.engine.drawing import (
    Point,
    arrow,
    circle,
    dot,
    line,
    path,
    rectangle,
    text,
)
from simulations.models.arrays import Floats, Mask
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    largest_distorted_radius,
)

VIEW_WIDTH, VIEW_HEIGHT, UNITS_PER_RADIUS = 400.0, 300.0, 250.0
CENTRE = (200.0, 150.0)
SAMPLE = (0.6, -0.4)
"""The ideal point whose shift is shown: a crossing of the grid. Only in the strongest barrels is it
past the fold."""
INNER, OUTER = (0.6, 0.45), (0.72, -0.54)
"""The ideal points marked in the photograph, towards corners. While k₂ is 0, the inner one
is always in view."""
BORDER = 15.0
"""Least distance of a handle from the border of the photograph, in view box units."""
VISIBLE_RADIUS_UNITS = 238.0
"""Radius above which too little of a circle is visible in the corners for a label."""


@lru_cache(maxsize=1)
def grid_lines() -> Floats:
    """Straight lines of the grid (16, 65, 2), 0.2 apart in normalised coordinates."""
    along_x, along_y = np.linspace(-0.8, 0.8, 65), np.linspace(-0.6, 0.6, 65)
    upright = [np.stack((np.full(65, x), along_y), -1) for x in np.linspace(-0.8, 0.8, 9)]
    level = [np.stack((along_x, np.full(65, y)), -1) for y in np.linspace(-0.6, 0.6, 7)]
    return np.stack(upright + level)


def grid_overlay(lens: Distortion) -> str:
    """The straight grid, its image, the limits, and the shift of one point."""
    fold = fold_radius(lens)
    lines = grid_lines()
    straight = to_view(lines[:, [0, -1]]).tolist()
    images = to_view(distort(lines, lens))
    within = np.hypot(lines[..., 0], lines[..., 1]) < fold
    in_view = np.all(np.abs(images - CENTRE) <= (220.0, 170.0), axis=-1)
    bent, folded = [], []
    for seen, inside, visible in zip(images, within, in_view, strict=True):
        bent += runs(seen, inside & visible)
        folded += runs(seen, grown(~inside) & visible)
    parts = [
        rectangle((0.5, 0.5), VIEW_WIDTH - 1, VIEW_HEIGHT - 1, "muted thin faint"),
        path(straight, "world thin faint"),
        path(folded, "error thin dashed faint") if folded else "",
        path(bent, "image"),
        _limits(lens, with_fold=True),
        _cross(CENTRE),
        _sample(lens),
    ]
    return "".join(parts)


def picture_overlay(lens: Distortion, *, corrected: bool) -> str:
    """The limit of the photograph and the shift of a point, or the limit of the correction."""
    limits = _limits(lens, with_fold=corrected, with_image=not corrected)
    if corrected:
        return limits
    named = ((INNER, "k₁"), (OUTER, "k₂"))
    return limits + "".join(
        _moved(ideal, lens) + _name(ideal, lens, name)
        for ideal, name in named
        if math.hypot(*ideal) < fold_radius(lens)
    )


def image_of(point: tuple[float, float], lens: Distortion) -> tuple[float, float]:
    """View box units of the image of an ideal point."""
    x, y = to_view(distort(np.asarray(point), lens))
    return float(x), float(y)


def held(ideal: tuple[float, float], lens: Distortion) -> tuple[float, float]:
    """Where the image of a point of the photograph is held: within the border."""
    x, y = (seen - middle for seen, middle in zip(image_of(ideal, lens), CENTRE, strict=True))
    beyond = max(abs(x) / (CENTRE[0] - BORDER), abs(y) / (CENTRE[1] - BORDER), 1.0)
    return CENTRE[0] + x / beyond, CENTRE[1] + y / beyond


def _name(ideal: tuple[float, float], lens: Distortion, name: str) -> str:
    """The coefficient that a point moves, on the left of the point and off its radius."""
    x, y = held(ideal, lens)
    row = min(max(y + (14.0 if ideal[1] > 0.0 else -5.0), 16.0), VIEW_HEIGHT - 8.0)
    return text((x - 14.0, row), name, "image small strong ground", "end")


def _moved(ideal: tuple[float, float], lens: Distortion) -> str:
    """The shift of a marked point from its pinhole image, as far as the border."""
    way = to_view(np.asarray(ideal)), held(ideal, lens)
    return line(*way, "casing") + line(*way, "image bold") + dot(way[1], "image")


def to_view(xy: Floats) -> Floats:
    """Normalised coordinates as view box units."""
    return np.asarray(CENTRE) + UNITS_PER_RADIUS * np.asarray(xy)


def runs(points: Floats, keep: Mask) -> list[Floats]:
    """The runs of a curve (N, 2), of two points or more, where ``keep`` (N,) is true."""
    if keep.all():
        return [points]
    edges = np.flatnonzero(np.diff(np.concatenate(([False], keep, [False])).astype(np.int8)))
    return [points[start:end] for start, end in edges.reshape(-1, 2) if end - start > 1]


def grown(mask: Mask) -> Mask:
    """``mask`` extended by neighbours, so that runs of both meet."""
    result = mask.copy()
    result[:-1] |= mask[1:]
    result[1:] |= mask[:-1]
    return result


def _limits(lens: Distortion, *, with_fold: bool, with_image: bool = True) -> str:
    """Circles of the fold (on ideal points) and of its image, where they are in view."""
    fold, limit = fold_radius(lens), largest_distorted_radius(lens)
    parts = []
    shown: tuple[tuple[bool, float, str, str, Callable[[float], Point]], ...] = (
        (with_fold, fold, "error thin dashed", "fold", _above),
        (with_image, limit, "error", "limit of the image", _below),
    )
    for wanted, radius, style, label, place in shown:
        units = radius * UNITS_PER_RADIUS
        if wanted and units < VISIBLE_RADIUS_UNITS:
            parts.append(circle(CENTRE, units, style))
            parts.append(text(place(units), label, "error small ground", "middle"))
    return "".join(parts)


def _above(radius: float) -> Point:
    """Label on the circle's upper left, or where the frame cuts it off."""
    y = max(CENTRE[1] - 0.82 * radius, 16.0)
    return (CENTRE[0] - math.sqrt(max(radius**2 - (CENTRE[1] - y) ** 2, 0.0)), y)


def _below(radius: float) -> Point:
    """Label just inside the circle's lowest point, or at the frame's lower left."""
    if radius <= 140.0:
        return (CENTRE[0], CENTRE[1] + radius - 8.0)
    y = VIEW_HEIGHT - 14.0
    x = CENTRE[0] - math.sqrt(radius**2 - (y - CENTRE[1]) ** 2)
    return (max(x + 52.0, 56.0), y)


def _cross(centre: Point) -> str:
    """The principal point."""
    x, y = centre
    return path([[(x - 6, y), (x + 6, y)], [(x, y - 6), (x, y + 6)]], "camera")


def _sample(lens: Distortion) -> str:
    """The shift of a crossing along the line from the principal point."""
    ideal = to_view(np.asarray(SAMPLE))
    parts = [line(CENTRE, ideal, "world thin dashed"), dot(ideal, "world")]
    if math.hypot(*SAMPLE) < fold_radius(lens):
        seen = to_view(distort(np.asarray(SAMPLE), lens))
        parts += [arrow(ideal, seen, "ray bold"), dot(seen, "image")]
    return "".join(parts)
