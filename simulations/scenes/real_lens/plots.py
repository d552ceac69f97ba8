"""The second and third panel: the rays close to the image, and where each crosses the axis.

Both show the same part of the axis, with the same columns.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from simulations.engine.drawing import Point, dot, path, text
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats
from simulations.models.lens.singlet import Rays
from simulations.scenes.real_lens.stages import HEIGHTS_MM, Glass

WIDTH = 400.0
LEFT, RIGHT, TOP, FLOOR = 40.0, 388.0, 26.0, 240.0
BEFORE_MM, BEHIND_MM = 20.0, 9.0
"""Length of the axis shown on either side of the thick lens's image."""
ASIDE = Axis(-3.0, 3.0, FLOOR, TOP)
"""Distances from the optical axis in the second panel, mm."""
HEIGHTS = Axis(0.0, 20.0, FLOOR, TOP)
"""Heights of rays in the third panel, mm."""
ALONG = Scale("mm behind the lens’s middle", ticks=4, style="small", tick_style="muted small")


def height_at(place: Point) -> float:
    """The height of a ray at a place of the third panel."""
    return HEIGHTS.value(float(place[1]))


def opening_mark(opening: float) -> tuple[float, float]:
    """The right end of the line of the opening."""
    return RIGHT - 10.0, HEIGHTS.place(opening)


def close(glass: Glass, fan: Rays, marked: Rays | None) -> str:
    """The rays around the image; heights are drawn larger than lengths. ``marked`` is None if that
    ray is stopped."""
    plot = _plot(glass, ASIDE)
    parts = [
        *_frame(glass, plot, "mm from the axis", (-2, 2) if glass.real else ()),
        plot.level(0.0),
    ]
    if glass.real:
        parts += [
            _ways(glass, plot, fan, "light thin"),
            *_models(glass, plot),
        ]
        if marked:
            parts += [_ways(glass, plot, marked, "ray bold"), *_crossing(plot, marked, 0.0)]
    return "".join(parts)


def aberration(glass: Glass, curve: Floats, height: float, marked: Rays, opening: float) -> str:
    """Places where rays cross the axis, by their height: a real lens, and the two lines of the
    models."""
    plot = _plot(glass, HEIGHTS)
    parts = [
        *_frame(glass, plot, "height h, mm", (0, 10, 20)),
        plot.level(opening, "thin dashed"),
        text((RIGHT - 28, HEIGHTS.place(opening) - 5), "opening", "small ground", "end"),
        dot(opening_mark(opening)),
    ]
    if glass.real:
        within, beyond = opening >= HEIGHTS_MM, opening <= HEIGHTS_MM
        parts += [
            *_models(glass, plot),
            plot.curve(curve[beyond], HEIGHTS_MM[beyond], "light thin dashed"),
            plot.curve(curve[within], HEIGHTS_MM[within], "light bold"),
        ]
        parts += _crossing(plot, marked, height)
    return "".join(parts)


def mark(glass: Glass, marked: Rays, height: float) -> tuple[float, float]:
    """The marked ray in the third panel, on the axis of heights if it does not cross."""
    plot = _plot(glass, HEIGHTS)
    crosses = _crosses_within(plot, marked) if glass.real else None
    return plot.at(plot.x.low if crosses is None else crosses, height)


def _plot(glass: Glass, up: Axis) -> Plot:
    """The axis around the image, if there is one."""
    image_mm = glass.paraxial_mm if glass.real else 0.0
    return Plot(Axis(image_mm - BEFORE_MM, image_mm + BEHIND_MM, LEFT, RIGHT), up)


def _frame(glass: Glass, plot: Plot, name: str, ticks: Sequence[float]) -> Iterator[str]:
    yield plot.axes()
    yield plot.y_axis(Scale(name, ticks=ticks, style="small", tick_style="muted small"))
    yield plot.x_axis(ALONG if glass.real else replace(ALONG, name="", ticks=()))
    if not glass.real:
        middle = (0.5 * (LEFT + RIGHT), 0.5 * (TOP + FLOOR) - 16)
        yield text(middle, "no image behind this lens", "error ground", "middle")


def _models(glass: Glass, plot: Plot) -> Iterator[str]:
    """The images of the thin lens and of the thick one."""
    names = (("thin", glass.thin_mm, "muted"), ("thick", glass.paraxial_mm, "image"))
    for name, along, role in names:
        if plot.x.low <= along <= plot.x.high:
            yield plot.upright(along, f"{role} dashed")
            side = "end" if glass.thin_mm < glass.paraxial_mm else "start"
            anchor = side if name == "thin" else {"end": "start", "start": "end"}[side]
            shift = 4 if anchor == "start" else -4
            place = (plot.x.place(along) + shift, FLOOR - 6)
            yield text(place, name, f"{role} small ground", anchor)


def _crosses_within(plot: Plot, marked: Rays) -> float | None:
    """The point where the marked ray crosses the axis, if it is within the plot."""
    along = float(marked.crossing_mm[0])
    return along if plot.x.low <= along <= plot.x.high else None


def _crossing(plot: Plot, marked: Rays, height: float) -> Iterator[str]:
    along = _crosses_within(plot, marked)
    if along is not None:
        yield dot(plot.at(along, height), "ray", 5)


def _ways(glass: Glass, plot: Plot, rays: Rays, style: str) -> str:
    """The part of each ray behind the lens, clipped to the second panel."""
    behind = max(plot.x.low, glass.lens.thickness_mm / 2.0)
    runs = []
    for (x, y), slope in zip(rays.back.tolist(), rays.slope.tolist(), strict=True):
        ends = np.array([max(behind, x), plot.x.high])
        runs += plot.pieces(ends, y + slope * (ends - x))
    return path(runs, style) if runs else ""
