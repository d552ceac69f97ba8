"""A plot: two axes, and curves, areas and marks between them.

    PLOT = Plot(Axis(0, 90, 46, 384), Axis(0, 1, 240, 30))

    PLOT.frame(Scale("angle of the light", "°"), Scale("brightness"))
    PLOT.region(y=(0.8, 1.0), style="error fill faint")
    PLOT.curve(angles, brightness, "ray bold")
    PLOT.mark(30, 0.87, "image")

The result is SVG in view box units, with classes and without colours, as in
`simulations.engine.drawing`. Undefined values, NaN or 0 on a logarithmic axis, interrupt a curve
and raise an error elsewhere.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine.drafting import label
from simulations.engine.drawing import (
    Point,
    check_count,
    circle,
    dot,
    line,
    path,
    polygon,
    polyline,
)
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.clipping import Run, Span, runs_inside
from simulations.engine.plotting.scale import Scale

type Values = tuple[float, float]

STROKE = 4.0
"""Length of a tick's stroke."""
BELOW, BESIDE, UNDER = 19.0, 8.0, 4.5
"""Distances from the edges to the baseline of x ticks and to y ticks, and half a tick's height."""
TITLE_BELOW, TITLE_ABOVE, TITLE_LEFT = 41.0, 12.0, 26.0
"""Distances from the lower edge to the name of x, and from the upper end of the y axis to its
name."""


@dataclass(frozen=True, slots=True)
class Plot:
    """Two axes: ``x`` is drawn from left to right, ``y`` upwards."""

    x: Axis
    y: Axis
    names: tuple[str, str] = ("", "")
    """What x and y are, with units, for a plot that is drawn whole."""
    marks: str = ""
    """SVG over the axes."""

    @classmethod
    def of(cls, x: str, across: Values, y: str, up: Values, *, log: str = "") -> Self:
        """A plot that fills a view box of 400 × 290: ``Plot.of("time, s", (0, 10), "speed, m/s",
        (0, 60))``; an axis in ``log``, ``x``, ``y`` or ``xy``, is logarithmic."""
        horizontal = Axis(*across, 50.0, 388.0, log="x" in log)
        return cls(horizontal, Axis(*up, 240.0, 30.0, log="y" in log), (x, y))

    def showing(self, *marks: str) -> Self:
        """The plot with these marks, and with those that it has."""
        return replace(self, marks="".join((self.marks, *marks)))

    @property
    def markup(self) -> str:
        """Axes and marks."""
        return self.frame(Scale(self.names[0]), Scale(self.names[1])) + self.marks

    def at(self, x: float, y: float) -> tuple[float, float]:
        """The place of two values, also outside the plot."""
        return self.x.place(x), self.y.place(y)

    def clamped(self, x: float, y: float) -> tuple[float, float]:
        """The place of two values, clamped to the plot."""
        return self.x.clamped(x), self.y.clamped(y)

    def values(self, place: Point) -> Values:
        """The values at a place, also outside the plot; for handles."""
        return self.x.value(float(place[0])), self.y.value(float(place[1]))

    def curve(self, xs: ArrayLike, ys: ArrayLike, style: str = "") -> str:
        """A curve through points (n,), clipped at the edges and interrupted where it is
        undefined."""
        runs = self.pieces(xs, ys)
        return path(runs, style) if runs else ""

    def pieces(self, xs: ArrayLike, ys: ArrayLike) -> list[Run]:
        """The runs of a curve within the plot."""
        check_count(np.size(xs))
        across, down = self.x.position(xs), self.y.position(ys)
        return runs_inside(across, down, _span(self.x), _span(self.y))

    def area(self, xs: ArrayLike, ys: ArrayLike, style: str = "") -> str:
        """The area between a curve (n,) and the lower edge, clamped to the plot."""
        top = self._edge(xs, ys)
        return polygon([(top[0][0], self.y.start), *top, (top[-1][0], self.y.start)], style)

    def between(self, xs: ArrayLike, upper: ArrayLike, lower: ArrayLike, style: str = "") -> str:
        """The area between two curves (n,), clamped to the plot."""
        return polygon([*self._edge(xs, upper), *reversed(self._edge(xs, lower))], style)

    def _edge(self, xs: ArrayLike, ys: ArrayLike) -> Run:
        across = np.clip(self.x.position(xs), *_span(self.x)).tolist()
        down = np.clip(self.y.position(ys), *_span(self.y)).tolist()
        return list(zip(across, down, strict=True))

    def region(
        self, x: Values | None = None, y: Values | None = None, style: str = "muted fill faint"
    ) -> str:
        """The rectangle between two values of one axis, or of each, clamped to the plot."""
        left, right = (self.x.clamped(value) for value in x or (self.x.low, self.x.high))
        foot, top = (self.y.clamped(value) for value in y or (self.y.low, self.y.high))
        return polygon([(left, foot), (right, foot), (right, top), (left, top)], style)

    def upright(self, x: float, style: str = "muted thin dashed") -> str:
        """A line through the plot at a value of x; empty if that is outside."""
        if not _contains(self.x, x):
            return ""
        return line((self.x.place(x), self.y.start), (self.x.place(x), self.y.end), style)

    def level(self, y: float, style: str = "muted thin dashed") -> str:
        """A line through the plot at a value of y; empty if that is outside."""
        if not _contains(self.y, y):
            return ""
        return line((self.x.start, self.y.place(y)), (self.x.end, self.y.place(y)), style)

    def drop(self, x: float, y: float, style: str = "muted thin dashed", to: str = "x") -> str:
        """Lines from a point to the axes in ``to``: ``x``, ``y`` or ``xy``."""
        here = self.clamped(x, y)
        ends = {"x": (here[0], self.y.start), "y": (self.x.start, here[1])}
        if to not in ("x", "y", "xy"):
            raise ValueError(f"to={to!r}; legal: 'x', 'y', 'xy'")
        return polyline([ends["x"], here, ends["y"]] if to == "xy" else [ends[to], here], style)

    def mark(self, x: float, y: float, style: str = "", radius: float = 5.0) -> str:
        """A point with an outline against the curves under it, clamped to the plot."""
        here = self.clamped(x, y)
        return circle(here, radius + 0.5, "casing") + dot(here, style, radius)

    def frame(self, across: Scale, up: Scale, style: str = "muted") -> str:
        """The axes with their grid, ticks and names."""
        return "".join(
            (
                self.grid(across, up, f"{style} thin faint"),
                self.axes(style),
                self.x_axis(across),
                self.y_axis(up),
            )
        )

    def grid(self, across: Scale, up: Scale, style: str = "muted thin faint") -> str:
        """The grid lines of two scales."""
        foot, top, left, right = self.y.start, self.y.end, self.x.start, self.x.end
        lines = [[(x, foot), (x, top)] for x in map(self.x.place, across.grid)]
        lines += [[(left, y), (right, y)] for y in map(self.y.place, up.grid)]
        return path(lines, style) if lines else ""

    def x_axis(self, scale: Scale) -> str:
        """The ticks of x and its name."""
        foot, ticks = self.y.start + scale.gap, tuple(scale.ticks_on(self.x))
        strokes = path([[(x, foot), (x, foot + STROKE)] for x, _ in ticks], "muted thin")
        words = [
            label((x, foot + BELOW), name, scale.tick_style, "middle") for x, name in ticks if name
        ]
        if scale.title:
            x, anchor = (self.x.start + self.x.end) / 2, "middle"
            if not scale.centred:
                x, anchor = self.x.end, "end"
            words.append(label((x, foot + TITLE_BELOW), scale.title, scale.style, anchor))
        return "".join((strokes if ticks else "", *words))

    def y_axis(self, scale: Scale) -> str:
        """The ticks of y, with strokes if there is no grid line, and its name."""
        edge, ticks = self.x.start - scale.gap, tuple(scale.ticks_on(self.y))
        strokes = path([[(edge - STROKE, y), (edge, y)] for y, _ in ticks], "muted thin")
        words = [
            label((edge - BESIDE, y + UNDER), name, scale.tick_style, "end")
            for y, name in ticks
            if name
        ]
        if scale.title:
            place = (max(edge - TITLE_LEFT, 2.0), self.y.end - TITLE_ABOVE)
            words.append(label(place, scale.title, scale.style))
        return "".join((strokes if ticks and not scale.grid else "", *words))

    def axes(self, style: str = "muted") -> str:
        """The lower and the left edge."""
        corner = (self.x.start, self.y.start)
        return polyline([(self.x.start, self.y.end), corner, (self.x.end, self.y.start)], style)


def _span(axis: Axis) -> Span:
    return min(axis.start, axis.end), max(axis.start, axis.end)


def _contains(axis: Axis, value: float) -> bool:
    return min(axis.low, axis.high) <= value <= max(axis.low, axis.high)
