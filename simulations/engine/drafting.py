"""Marks of a drawing board: labels with indices, dimensions, arcs, lenses, and plots with axes.

They build on `simulations.engine.drawing` and follow its rules: view box units, x right, y down;
``style`` is a list of CSS classes. Angles are counter-clockwise as seen, from the right.
"""

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine.drawing import (
    Point,
    arrow,
    coordinate,
    line,
    path,
    polygon,
    polyline,
)

SCRIPT = re.compile(r"([_^])(?:\{([^}]*)\}|(.))")
"""An index or an exponent: ``z_s``, ``r^2``, ``N_{min}``."""
SCRIPT_SIZE = 0.74
"""Of its letters, beside those of the label."""
HEIGHTS = {"_": ("sub", 0.22), "^": ("super", -0.37)}
"""Class of a script and how far below the line it stands, in letters of the label."""


def label(position: Point, content: str, style: str = "", anchor: str = "start") -> str:
    """A text in which ``_`` lowers and ``^`` raises the character, or ``{group}``, after it."""
    x, y = coordinate(position[0]), coordinate(position[1])
    return f'<text class="{style}" x="{x}" y="{y}" text-anchor="{anchor}">{_spans(content)}</text>'


def _spans(content: str) -> str:
    parts, rest, height = [], 0, 0.0
    for found in SCRIPT.finditer(content):
        if plain := content[rest : found.start()]:
            parts.append(_span(plain, "", -height))
            height = 0.0
        kind, wanted = HEIGHTS[found[1]]
        parts.append(_span(found[2] or found[3], kind, (wanted - height) / SCRIPT_SIZE))
        rest, height = found.end(), wanted
    return "".join([*parts, _span(content[rest:], "", -height)])


def _span(content: str, kind: str, down_em: float) -> str:
    """Words, so many of their own letters below those before."""
    words = escape(content, quote=False)
    if not words or not (kind or down_em):
        return words
    style = f' class="{kind}"' if kind else ""
    return f'<tspan{style} dy="{coordinate(down_em)}em">{words}</tspan>'


def swatch(corner: Point, width: float, height: float, srgb: Sequence[float]) -> str:
    """A rectangle in a colour that was computed, 0 to 1: a measurement, the same in all themes."""
    x, y, w, h = (coordinate(value) for value in (corner[0], corner[1], width, height))
    red, green, blue = (round(255 * min(max(float(value), 0.0), 1.0)) for value in srgb)
    fill = f"#{red:02x}{green:02x}{blue:02x}"
    return f'<rect class="swatch" x="{x}" y="{y}" width="{w}" height="{h}" fill="{fill}"/>'


def polar(centre: Point, radius: float, angle_rad: float) -> tuple[float, float]:
    """The point at that distance and angle."""
    return (
        float(centre[0]) + radius * math.cos(angle_rad),
        float(centre[1]) - radius * math.sin(angle_rad),
    )


def arc(centre: Point, radius: float, start_rad: float, end_rad: float, style: str = "") -> str:
    """An open arc of a circle, in steps of at most 3°."""
    steps = max(2, math.ceil(abs(end_rad - start_rad) / math.radians(3)))
    angles = np.linspace(start_rad, end_rad, steps + 1)
    return polyline([polar(centre, radius, float(angle)) for angle in angles], style)


def double_arrow(start: Point, end: Point, style: str = "", head: float = 7.0) -> str:
    """A line with a head at each end."""
    middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
    return arrow(middle, start, style, head) + arrow(middle, end, style, head)


def dimension(start: Point, end: Point, style: str = "", tick: float = 5.0) -> str:
    """A dimension line: heads at both ends, each against a short stroke across."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    across = (-dy / length * tick, dx / length * tick)
    strokes = [
        [(place[0] - across[0], place[1] - across[1]), (place[0] + across[0], place[1] + across[1])]
        for place in (start, end)
    ]
    return double_arrow(start, end, f"{style} thin", 6.0) + path(strokes, f"{style} thin")


def glass(centre: Point, half_height: float, half_width: float, style: str = "camera fill") -> str:
    """A lens of two equal faces, seen from the side."""
    x, y = float(centre[0]), float(centre[1])
    radius = (half_height**2 + half_width**2) / (2 * half_width)
    heights = np.linspace(-half_height, half_height, 33)
    bulge = np.sqrt(radius**2 - heights**2) - (radius - half_width)
    right = [(x + b, y + h) for b, h in zip(bulge, heights, strict=True)]
    return polygon([*right, *((2 * x - px, py) for px, py in reversed(right))], style)


def box(corner: Point, width: float, height: float, radius: float = 3.0, style: str = "") -> str:
    """A rectangle with rounded corners."""
    x, y, w, h, r = (coordinate(v) for v in (corner[0], corner[1], width, height, radius))
    return f'<rect class="{style}" x="{x}" y="{y}" width="{w}" height="{h}" rx="{r}"/>'


@dataclass(frozen=True, slots=True)
class Axis:
    """Values from ``low`` to ``high``, drawn from ``start`` to ``end``; equal steps for equal
    factors where ``log``."""

    low: float
    high: float
    start: float
    end: float
    log: bool = False

    def position(self, values: ArrayLike) -> np.ndarray:
        """View box coordinates of values (...); NaN for those that a logarithm does not have."""
        scaled, low, high = np.asarray(values, float), self.low, self.high
        if self.log:
            with np.errstate(divide="ignore", invalid="ignore"):
                scaled = np.log(np.where(scaled > 0, scaled, np.nan))
            low, high = math.log(low), math.log(high)
        return np.asarray(self.start + (scaled - low) / (high - low) * (self.end - self.start))


@dataclass(frozen=True, slots=True)
class Plot:
    """Two axes and what is drawn between them."""

    x: Axis
    y: Axis

    def at(self, x: float, y: float) -> tuple[float, float]:
        return float(self.x.position(x)), float(self.y.position(y))

    def curve(self, xs: ArrayLike, ys: ArrayLike, style: str = "") -> str:
        """A curve through points (n,), broken where it leaves the plot or is undefined."""
        return path(self.pieces(xs, ys), style)

    def pieces(self, xs: ArrayLike, ys: ArrayLike) -> list[list[tuple[float, float]]]:
        """The runs of points that lie within the plot, as view box coordinates."""
        across, down = self.x.position(xs), self.y.position(ys)
        inside = np.isfinite(across) & np.isfinite(down)
        for places, axis in ((across, self.x), (down, self.y)):
            low, high = sorted((axis.start, axis.end))
            inside &= (places >= low - 1e-6) & (places <= high + 1e-6)
        runs: list[list[tuple[float, float]]] = [[]]
        for x, y, shown in zip(across, down, inside, strict=True):
            if shown:
                runs[-1].append((float(x), float(y)))
            elif runs[-1]:
                runs.append([])
        return [run for run in runs if len(run) > 1]

    def area(self, xs: ArrayLike, ys: ArrayLike, style: str = "") -> str:
        """The area between a curve and the foot of the plot."""
        places = [
            (float(x), float(y))
            for x, y in zip(self.x.position(xs), self.y.position(ys), strict=True)
        ]
        foot = self.y.start
        return polygon([(places[0][0], foot), *places, (places[-1][0], foot)], style)

    def axes(self, style: str = "muted") -> str:
        """The lower and the left edge."""
        corner = (self.x.start, self.y.start)
        return polyline([(self.x.start, self.y.end), corner, (self.x.end, self.y.start)], style)

    def ticks_x(self, ticks: Iterable[tuple[float, str]], style: str = "muted small") -> str:
        """Ticks below the plot, with their labels."""
        return "".join(
            line((x, self.y.start), (x, self.y.start + 4), "muted")
            + label((x, self.y.start + 17), name, style, "middle")
            for x, name in ((float(self.x.position(value)), name) for value, name in ticks)
        )

    def ticks_y(self, ticks: Iterable[tuple[float, str]], style: str = "muted small") -> str:
        """Ticks left of the plot, with their labels."""
        return "".join(
            line((self.x.start - 4, y), (self.x.start, y), "muted")
            + label((self.x.start - 8, y + 4), name, style, "end")
            for y, name in ((float(self.y.position(value)), name) for value, name in ticks)
        )
