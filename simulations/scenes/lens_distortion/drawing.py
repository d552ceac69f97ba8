"""Drawings of the lens-distortion figure: the bent grid, the limits over its pictures, and the
radial profile.

The view box is 400 × 300 for the photograph's 320 × 240 px, so that r = 1 is 250 units.
"""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine.drawing import arrow, cased, circle, dot, line, path, rectangle, text
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats, Mask
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    largest_distorted_radius,
)
from simulations.models.distortion.radial_profile import evaluate

VIEW_WIDTH, VIEW_HEIGHT, UNITS_PER_RADIUS = 400.0, 300.0, 250.0
CENTRE = (200.0, 150.0)
SAMPLE = (0.6, -0.4)
"""The ideal point whose shift is shown: a crossing of the grid. Only in the strongest barrels is it
past the fold."""
INNER, OUTER = (0.6, 0.45), (0.72, -0.54)
"""The ideal points marked in the photograph, towards corners. While k₂ is 0, the inner one
is always in view."""
BEAM = (-0.56, -0.425), (0.62, -0.425)
"""The ideal ends of the edge of a beam in the room."""
RULER, TICKS = 15.0, 10.0  # width of the ruler, and distance of its marks
BORDER = 15.0  # least distance of a handle from the border of the photograph, in view box units
VISIBLE_RADIUS_UNITS = 238.0
"""Radius above which too little of a circle is visible in the corners for a label."""
LARGEST = 1.25  # radius at the ends of the axes of the profile
PLOT = Plot(Axis(0.0, LARGEST, 44.0, 386.0), Axis(0.0, LARGEST, 250.0, 16.0))
SCALE = Scale(ticks=(0, 0.5, 1), grid=(1,))


def overlays(k1: float, k2: float) -> dict[str, str]:
    """The SVG of all three panels that depends on the lens alone; ``corrected`` is the SVG of the
    corrected picture."""
    lens = Distortion(k1=k1, k2=k2)
    named = ((INNER, "inner"), (OUTER, "outer"))
    shifts = [
        _shift_mark(*point, lens) for point in named if math.hypot(*point[0]) < fold_radius(lens)
    ]
    return {
        "grid": _grid(lens),
        "picture": "".join((_limits(lens, fold=False, image=True), *shifts)),
        "corrected": _limits(lens, fold=True, image=False),
        "profile": _profile(lens),
    }


@lru_cache(maxsize=1)
def grid_lines() -> Floats:
    """Straight lines of the grid (16, 65, 2), 0.2 apart in normalised coordinates."""
    along_x, along_y = np.linspace(-0.8, 0.8, 65), np.linspace(-0.6, 0.6, 65)
    upright = [np.stack((np.full(65, x), along_y), -1) for x in np.linspace(-0.8, 0.8, 9)]
    level = [np.stack((along_x, np.full(65, y)), -1) for y in np.linspace(-0.6, 0.6, 7)]
    return np.stack(upright + level)


def to_view(xy: ArrayLike) -> Floats:
    """Normalised coordinates as view box units."""
    return np.asarray(CENTRE) + UNITS_PER_RADIUS * np.asarray(xy)


def image_of(point: tuple[float, float], lens: Distortion) -> tuple[float, float]:
    """View box units of the image of an ideal point."""
    return tuple(to_view(distort(np.asarray(point), lens)).tolist())


def handle_place(ideal: tuple[float, float], lens: Distortion) -> tuple[float, float]:
    """The place of the handle of a point of the photograph: its image, within the border."""
    x, y = (image - middle for image, middle in zip(image_of(ideal, lens), CENTRE, strict=True))
    beyond = max(abs(x) / (CENTRE[0] - BORDER), abs(y) / (CENTRE[1] - BORDER), 1.0)
    return CENTRE[0] + x / beyond, CENTRE[1] + y / beyond


def _grid(lens: Distortion) -> str:
    """The straight grid, its image, the limits, and the shift of one point."""
    lines = grid_lines()
    images = to_view(distort(lines, lens))
    within = np.hypot(lines[..., 0], lines[..., 1]) < fold_radius(lens)
    aside, down = np.abs(images[..., 0] - CENTRE[0]), np.abs(images[..., 1] - CENTRE[1])
    in_view = (aside <= 220.0) & (down <= 170.0)
    bent, folded = [], []
    for image, inside, visible in zip(images, within, in_view, strict=True):
        bent += _runs(image, inside & visible)
        if not inside.all():
            folded += _runs(image, _grown(~inside) & visible)
    (x, y), ideal = CENTRE, tuple(to_view(SAMPLE).tolist())
    parts = [
        rectangle((0.5, 0.5), VIEW_WIDTH - 1, VIEW_HEIGHT - 1, "muted thin faint"),
        path(to_view(lines[:, [0, -1]]).tolist(), "world thin faint"),
        path(folded, "error thin dashed faint") if folded else "",
        path(bent, "image"),
        _limits(lens, fold=True, image=True),
        path([[(x - 6, y), (x + 6, y)], [(x, y - 6), (x, y + 6)]], "camera"),
        line(CENTRE, ideal, "world thin dashed"),
        dot(ideal, "world"),
    ]
    if math.hypot(*SAMPLE) < fold_radius(lens):
        seen_at = image_of(SAMPLE, lens)
        parts += [arrow(ideal, seen_at, "ray bold"), dot(seen_at, "image")]
    return "".join(parts)


def _runs(points: Floats, keep: Mask) -> list[Floats]:
    """The runs of a curve (N, 2), of two points or more, where ``keep`` (N,) is true."""
    if keep.all():
        return [points]
    edges = np.flatnonzero(np.diff(np.concatenate(([False], keep, [False])).astype(np.int8)))
    return [points[start:end] for start, end in edges.reshape(-1, 2) if end - start > 1]


def _grown(mask: Mask) -> Mask:
    """``mask`` extended by neighbours, so that runs of both meet."""
    result = mask.copy()
    result[:-1] |= mask[1:]
    result[1:] |= mask[:-1]
    return result


def _shift_mark(ideal: tuple[float, float], name: str, lens: Distortion) -> str:
    """The shift of a marked point from its pinhole image, as far as the border; its name
    on its left and off its radius."""
    ends = to_view(ideal), handle_place(ideal, lens)
    x, y = ends[1]
    row = min(max(y + (14.0 if ideal[1] > 0.0 else -5.0), 16.0), VIEW_HEIGHT - 8.0)
    label = text((x - 14.0, row), name, "image small strong ground", "end")
    return cased(line, *ends, style="image bold") + dot(ends[1], "image") + label


def ruler(lens: Distortion) -> str:
    """A ruler from end to end of a beam of the room; none for a beam past the fold."""
    if math.hypot(*BEAM[1]) >= fold_radius(lens):
        return ""
    start, end = to_view(distort(np.array(BEAM), lens))
    along = (end - start) / math.dist(start, end)
    down = RULER * np.array([-along[1], along[0]])
    at = start + np.arange(0.0, math.dist(start, end), TICKS)[:, None] * along
    marks = np.stack([at, at + 0.4 * down], axis=1)
    rim = [(start, end, end + down, start + down, start)]
    return path(rim, "casing solid") + path(rim, "world") + path(marks, "world thin")


def _limits(lens: Distortion, *, fold: bool, image: bool) -> str:
    """Circles of the fold (on ideal points) and of its image, where they are in view.

    The fold's label is on the circle's upper left, or where the frame cuts it off; that of its
    image is just inside the circle's lowest point, or at the frame's lower left.
    """
    parts, (x, y) = [], CENTRE
    units = UNITS_PER_RADIUS * fold_radius(lens)
    if fold and units < VISIBLE_RADIUS_UNITS:
        row = max(y - 0.82 * units, 16.0)
        place = (x - math.sqrt(max(units**2 - (y - row) ** 2, 0.0)), row)
        parts.append(circle(CENTRE, units, "error thin dashed"))
        parts.append(text(place, "fold", "error small ground", "middle"))
    units = UNITS_PER_RADIUS * largest_distorted_radius(lens)
    if image and units < VISIBLE_RADIUS_UNITS:
        place = (x, y + units - 8.0)
        if units > 140.0:
            row = VIEW_HEIGHT - 14.0
            place = (max(x - math.sqrt(units**2 - (row - y) ** 2) + 52.0, 56.0), row)
        parts.append(circle(CENTRE, units, "error"))
        parts.append(text(place, "limit of the image", "error small ground", "middle"))
    return "".join(parts)


def _profile(lens: Distortion) -> str:
    """Image radius against ideal radius: the curve that the coefficients describe."""
    fold = fold_radius(lens)
    before = np.linspace(0.0, min(fold, LARGEST), 101)
    corner, foot = PLOT.at(1.0, 0.0)
    middle = 0.5 * (PLOT.x.start + PLOT.x.end)
    # Next to the dashed line, on the side away from the curve.
    beside = (1.12, 1.19) if float(evaluate(lens.radial, 1.0)) < 0.99 else (LARGEST, 0.86)
    parts = [
        PLOT.frame(SCALE, SCALE),
        text((corner - 5, foot - 14), "corner", "muted small ground", "end"),
        text((middle, foot + 41), "ideal radius", "world", "middle"),
        text((PLOT.x.start + 8, PLOT.y.end + 8), "radius in the image", "image ground"),
        line(PLOT.at(0, 0), PLOT.at(LARGEST, LARGEST), "muted thin dashed"),
        text(PLOT.at(*beside), "no distortion", "muted small ground", "end"),
        PLOT.curve(before, evaluate(lens.radial, before), "image bold"),
    ]
    if fold < LARGEST:
        after = np.linspace(fold, LARGEST, 51)
        x, y = PLOT.at(fold, largest_distorted_radius(lens))
        parts += [
            PLOT.curve(after, evaluate(lens.radial, after), "error dashed"),
            line((x, y), (x, PLOT.y.start), "error thin dashed"),
            dot((x, y), "error"),
            text((x, y - 10.0), "fold", "error small ground", "middle"),
        ]
    ideal = math.hypot(*SAMPLE)
    here = PLOT.at(ideal, float(evaluate(lens.radial, ideal)))
    parts += [
        line((here[0], PLOT.y.start), here, "world thin"),
        line((PLOT.x.start, here[1]), here, "image thin"),
        dot(here, "image"),
    ]
    return "".join(parts)
