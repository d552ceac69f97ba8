"""The axis of frequencies, folded at Nyquist, with the true and the apparent wave."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import Point, arrow, dot, line, polygon, polyline, text
from simulations.engine.frame import format_number
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.sampling.prefilters import Prefilter, transfer
from simulations.scenes.aliasing.own import FINE, PHOTOGRAPH_PX, Own
from simulations.scenes.aliasing.pattern import Pattern

HIGHEST = 1.2
PLOT = Plot(Axis(0.0, HIGHEST, 40.0, 386.0), Axis(0.0, 1.0, 244.0, 116.0))
FREQUENCIES = Scale("frequency", "cycles per pixel", ticks=(0, 0.25, 0.5, 0.75, 1), gap=9.0)
"""The ticks are clear of the handle of the fold."""
AMPLITUDES = Scale(ticks=(0, 1), grid=(1,))
LABELS = 92.0
"""Row of the numbers above the lines."""
HEAD = 7.0
APART = 56.0
"""Least distance between the centres of two labels."""
ARC_TOP = 50.0
"""Row of the arrow from the true to the apparent frequency."""


def draw(pattern: Pattern, kernel: Prefilter, remaining: float, own: Own | None) -> str:
    """SVG markup of the third panel; ``remaining`` is the amplitude in the samples."""
    rate, frequency = pattern.rate, pattern.frequency * pattern.rate
    passed = abs(float(transfer(kernel, pattern.frequency)))
    band = _band(frequency) if pattern.kind == "zone_plate" else iter(())
    return "".join(
        (
            *_axes(0.5 * rate),
            *(_detail(own) if own else band),
            _response(kernel, rate),
            *_lines(pattern, passed, remaining),
        )
    )


def wave_at(frequency: float) -> tuple[float, float]:
    """The end of the line of the wave before the filter."""
    return PLOT.at(frequency, 1.0)


def fold_at(frequency: float) -> tuple[float, float]:
    """The place of the fold."""
    return PLOT.at(frequency, 0.0)


def frequency_at(place: Point) -> float:
    """Cycles per pixel at a place of the panel."""
    return PLOT.values(place)[0]


def _axes(nyquist: float) -> Iterator[str]:
    yield PLOT.region(x=(nyquist, HIGHEST))
    yield PLOT.frame(FREQUENCIES, AMPLITUDES)
    x, foot = fold_at(nyquist)
    yield line((x, foot), (x, LABELS - 20), "camera dashed")
    yield dot((x, foot), "camera", 5)
    yield text((x, LABELS - 26), "Nyquist", "camera ground", "middle")


def _response(kernel: Prefilter, rate: float) -> str:
    """The transfer function of the filter."""
    frequencies = np.linspace(0.0, HIGHEST, 121)
    return PLOT.curve(frequencies, np.abs(transfer(kernel, frequencies / rate)), "light")


def _band(frequency: float) -> Iterator[str]:
    """The zone plate has every frequency up to that of its edge."""
    yield line(PLOT.at(0.0, 0.0), PLOT.at(frequency, 0.0), "world bold")


def _detail(own: Own) -> Iterator[str]:
    """The spectrum of the reader's picture."""
    frequencies = np.arange(own.detail.size) * FINE / PHOTOGRAPH_PX[0]
    shape = [PLOT.at(f, a) for f, a in zip(frequencies.tolist(), own.detail.tolist(), strict=True)]
    yield polygon([*shape, PLOT.at(float(frequencies[-1]), 0), PLOT.at(0, 0)], "world fill thin")
    yield text((12, PLOT.y.start + 41), "your picture, by octaves", "world small")


def _lines(pattern: Pattern, passed: float, remaining: float) -> Iterator[str]:
    """The wave before the filter, after it, and in the samples."""
    frequency, alias = pattern.frequency * pattern.rate, pattern.alias * pattern.rate
    folded = pattern.frequency > 0.5
    yield line(PLOT.at(frequency, 0), wave_at(frequency), "world dashed")
    yield dot(wave_at(frequency), "world", 5)
    yield line(PLOT.at(frequency, 0), PLOT.at(frequency, passed), "world bold")
    yield dot(PLOT.at(frequency, passed), "world", 4.5)
    if folded:
        yield line(PLOT.at(alias, 0), PLOT.at(alias, remaining), "error bold")
        yield dot(PLOT.at(alias, remaining), "error", 4.5)
        yield from _fold(frequency, alias)
    elif not math.isclose(remaining, passed):
        yield dot(PLOT.at(frequency, remaining), "image", 5.5)
    yield from _labels(frequency, alias, folded)


def _fold(frequency: float, alias: float) -> Iterator[str]:
    """The path from the true to the apparent frequency, through the fold at 1 if there is one."""
    start, end = PLOT.at(frequency, 0)[0], PLOT.at(alias, 0)[0]
    span = start - end
    rise = min(30.0, 0.35 * span)
    arc = [
        (start - span * step / 24, ARC_TOP - rise * math.sin(math.pi * step / 24))
        for step in range(24)
    ]
    far = [point for point in arc if math.dist(point, (end, ARC_TOP)) > HEAD]
    yield polyline(arc[: len(far) + 1], "error thin")
    if far:
        yield arrow(far[-1], (end, ARC_TOP), "error thin", head=HEAD)


def _labels(frequency: float, alias: float, folded: bool) -> Iterator[str]:
    """The frequencies above the lines, without overlap."""
    x, seen = PLOT.at(frequency, 0)[0], PLOT.at(alias, 0)[0]
    push = max(0.0, 0.5 * (APART - (x - seen))) if folded else 0.0
    place = (min(max(x + push, PLOT.x.start + 24), PLOT.x.end - 22), LABELS)
    yield text(place, f"f = {format_number(frequency)}", "world ground strong", "middle")
    if folded:
        yield text(
            (max(seen - push, PLOT.x.start + 16), LABELS),
            format_number(alias),
            "error ground strong",
            "middle",
        )
