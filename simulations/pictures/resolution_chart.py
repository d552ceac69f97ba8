"""A test chart: chequered border, ruled grid, Siemens stars, line pairs, a slanted edge.

Flat and parallel to the image plane, one metre away, so that its coordinates in metres equal
normalised image coordinates. Linear luminance as grey RGB; the chart fills the whole picture.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, centred
from simulations.models.require import as_whole, require_positive
from simulations.pictures.patterns import band, blend, checker, pixel_width, siemens_star, stripes

PAPER, INK, RULE = (0.82, 0.81, 0.78), (0.025, 0.028, 0.035), (0.10, 0.22, 0.34)
STAR_CENTRES = ((-0.57, -0.37), (0.57, -0.37), (-0.57, 0.37), (0.57, 0.37))
STAR_RADIUS, STAR_SPOKES = 0.15, 18
EDGE_SLOPE = 0.0875
"""Tangent of the slanted edge's tilt, 5°: each row cuts it at another fraction of a pixel."""


def resolution_chart(width: int, height: int, focal_px: float) -> Floats:
    """The chart through a pinhole whose axis meets the centre of the picture.

    Returns
    -------
    (height, width, 3) float32 linear RGB. Raises ValueError unless sizes and ``focal_px`` are
    positive.
    """
    width, height = as_whole("width", width, 1), as_whole("height", height, 1)
    require_positive("focal_px", focal_px)
    x, y = ((centred(count) / focal_px).astype(np.float32) for count in (width, height))
    picture = np.full((height, width, 3), PAPER, np.float32)
    chart = Part(picture, x[None], y[:, None], np.float32(1.0 / focal_px))
    for draw in (_grid, _border, _stars, _line_pairs, _slanted_edge):
        draw(chart)
    return picture


@dataclass(frozen=True, slots=True)
class Part:
    """A part of the chart, painted in place."""

    picture: Floats
    """(h, w, 3)"""
    x: Floats
    """(1, w) coordinates of its columns; with ``y`` they broadcast to all of its pixels."""
    y: Floats
    """(h, 1) coordinates of its rows."""
    pixel: np.float32
    """Width of a pixel."""

    def around(self, centre: tuple[float, float], half_size: tuple[float, float]) -> "Part":
        """The pixels that a rectangle touches, and a pixel more on each side."""
        reach = 2 * self.pixel
        columns, rows = (
            slice(*np.searchsorted(along.ravel(), (at - half - reach, at + half + reach)))
            for along, at, half in zip((self.x, self.y), centre, half_size, strict=True)
        )
        return Part(self.picture[rows, columns], self.x[:, columns], self.y[rows], self.pixel)

    def paint(self, colour: ArrayLike, amount: Floats) -> None:
        self.picture[:] = blend(self.picture, colour, amount)


def _grid(chart: Part) -> None:
    """Lines every 0.1, bolder every 0.2 from the centre."""
    for period, width, strength in ((0.1, 0.003, 0.45), (0.2, 0.009, 1.0)):
        across, down = (stripes(at, period, width, chart.pixel) for at in (chart.x, chart.y))
        chart.paint(RULE, strength * np.maximum(across, down))


def _border(chart: Part) -> None:
    """A frame of squares just inside |x| = 0.8, |y| = 0.6, and a wall of squares outside it."""
    x, y, pixel = chart.x, chart.y, chart.pixel
    around = 1.0 - _box(x, y, 0.75, 0.55, pixel)
    squares = checker(x - 0.025, y - 0.025, 0.05, pixel, pixel)
    wall = checker(x - 0.1, y - 0.1, 0.2, pixel, pixel)
    chart.paint(PAPER, around)
    chart.paint(INK, squares * around)
    tiles = blend(np.full_like(chart.picture, 0.05), np.asarray(PAPER) * 0.55, wall)
    chart.paint(tiles, 1.0 - _box(x, y, 0.8, 0.6, pixel))


def _stars(chart: Part) -> None:
    for centre_x, centre_y in STAR_CENTRES:
        part = chart.around((centre_x, centre_y), (STAR_RADIUS, STAR_RADIUS))
        if min(part.picture.shape[:2]) < 2:  # hardly in view: a star has no slope to go by
            continue
        x, y = np.broadcast_arrays(part.x - centre_x, part.y - centre_y)
        star = siemens_star(x, y, STAR_SPOKES, 0.5 * (pixel_width(x) + pixel_width(y)))
        disc = np.clip((STAR_RADIUS - np.hypot(x, y)) / part.pixel + 0.5, 0.0, 1.0)
        part.paint(PAPER, disc)
        part.paint(INK, disc * (1.0 - star))


def _line_pairs(chart: Part) -> None:
    """Bars of five widths above and below the centre; the finest are one pixel at f = 200 px."""
    for step, width in enumerate((0.025, 0.018, 0.012, 0.008, 0.005)):
        left = -0.37 + 0.15 * step
        for top, upright in ((-0.48, True), (0.33, False)):
            part = chart.around((left + 0.07, top + 0.075), (0.07, 0.075))
            along = part.x - left if upright else part.y - 0.33
            field = band(part.x, left, left + 0.14, part.pixel)
            field = field * band(part.y, top, top + 0.15, part.pixel)
            bars = stripes(along - 0.5 * width, 2.0 * width, width, part.pixel)
            part.paint(PAPER, field)
            part.paint(INK, field * bars)


def _slanted_edge(chart: Part) -> None:
    """A dark square tilted by 5° on a clear field around the axis."""
    part = chart.around((0.0, 0.0), (0.19, 0.19))
    x, y, pixel = part.x, part.y, part.pixel
    across, down = x + EDGE_SLOPE * y, y - EDGE_SLOPE * x
    wide = pixel * np.float32(1.0 + EDGE_SLOPE)
    part.paint(PAPER, _box(x, y, 0.19, 0.19, pixel))
    part.paint(INK, _box(across, down, 0.12, 0.12, wide))
    hair = np.maximum(band(x, -0.002, 0.002, pixel), band(y, -0.002, 0.002, pixel))
    part.paint((0.75, 0.16, 0.08), hair * _box(x, y, 0.05, 0.05, pixel))


def _box(x: Floats, y: Floats, half_width: float, half_height: float, pixel: np.float32) -> Floats:
    return band(x, -half_width, half_width, pixel) * band(y, -half_height, half_height, pixel)
