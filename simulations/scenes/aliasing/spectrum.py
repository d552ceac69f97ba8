"""The axis of frequencies, folded at Nyquist: where the wave is, and where it appears."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import Point, arrow, dot, line, path, polygon, polyline, text
from simulations.engine.frame import format_number
from simulations.models.sampling.prefilters import Prefilter, transfer
from simulations.scenes.aliasing.own import FINE, PHOTOGRAPH_PX, Own
from simulations.scenes.aliasing.pattern import Pattern

LEFT, RIGHT, FLOOR, FULL = 40.0, 386.0, 244.0, 116.0
"""Edges of the plot, its zero line, and the row of amplitude 1."""
LABELS = 98.0
"""Row of the numbers above the lines."""
HIGHEST = 1.2
HEAD = 7.0
APART = 56.0
"""Least distance of the middles of two labels."""
ARC_TOP = 50.0
"""Row that the arrow from the true to the seen frequency passes."""


def draw(pattern: Pattern, kernel: Prefilter, kept: float, own: Own | None) -> str:
    """SVG markup of the third panel; ``kept`` is the amplitude in the samples."""
    rate, frequency = pattern.rate, pattern.frequency * pattern.rate
    passed = abs(float(transfer(kernel, pattern.frequency)))
    band = _band(frequency) if pattern.kind == "zone_plate" else iter(())
    return "".join(
        (
            *_axes(0.5 * rate),
            *(_detail(own) if own else band),
            _response(kernel, rate),
            *_lines(pattern, passed, kept),
        )
    )


def wave_at(frequency: float) -> tuple[float, float]:
    """Where the wave in front of the lens stands: as high as it is before the filter."""
    return _at(frequency, 1.0)


def fold_at(frequency: float) -> tuple[float, float]:
    """Where the axis is folded."""
    return _at(frequency, 0.0)


def frequency_at(place: Point) -> float:
    """Cycles per pixel at a place of the panel."""
    return HIGHEST * (float(place[0]) - LEFT) / (RIGHT - LEFT)


def _axes(nyquist: float) -> Iterator[str]:
    beyond = [_at(nyquist, 0), _at(HIGHEST, 0), _at(HIGHEST, 1), _at(nyquist, 1)]
    yield polygon(beyond, "muted fill faint")
    yield path([[_at(0, 1.1), _at(0, 0), _at(HIGHEST, 0)]], "muted")
    yield path([[_at(0, 1), _at(HIGHEST, 1)]], "muted thin faint")
    x = _at(nyquist, 0)[0]
    yield line((x, FLOOR), (x, LABELS - 20), "camera dashed")
    yield dot(fold_at(nyquist), "camera", 5)
    yield text((x, LABELS - 26), "Nyquist", "camera halo", "middle")
    for tick in (0.0, 0.25, 0.5, 0.75, 1.0):
        x, y = _at(tick, 0)
        yield line((x, y), (x, y + 5), "muted thin")
        yield text((x, y + 23), f"{tick:g}", "muted", "middle")
    for share in (0.0, 1.0):
        x, y = _at(0, share)
        yield text((x - 8, y + 4.5), f"{share:g}", "muted", "end")
    yield text((RIGHT, FLOOR + 46), "frequency, cycles per pixel", "", "end")


def _response(kernel: Prefilter, rate: float) -> str:
    """What the filter passes, by frequency."""
    frequencies = np.linspace(0.0, HIGHEST, 121)
    passed = np.abs(transfer(kernel, frequencies / rate)).tolist()
    curve = [_at(f, a) for f, a in zip(frequencies.tolist(), passed, strict=True)]
    return polyline(curve, "light")


def _band(frequency: float) -> Iterator[str]:
    """The zone plate holds every frequency up to that of its edge."""
    yield line(_at(0.0, 0.0), _at(frequency, 0.0), "world bold")


def _detail(own: Own) -> Iterator[str]:
    """How much of each frequency the reader's picture holds."""
    frequencies = np.arange(own.detail.size) * FINE / PHOTOGRAPH_PX[0]
    shape = [_at(f, a) for f, a in zip(frequencies.tolist(), own.detail.tolist(), strict=True)]
    yield polygon([*shape, _at(float(frequencies[-1]), 0), _at(0, 0)], "world fill thin")
    yield text((12, FLOOR + 46), "your picture, by octaves", "world small")


def _lines(pattern: Pattern, passed: float, kept: float) -> Iterator[str]:
    """The wave before the filter, after it, and what the samples make of it."""
    frequency, alias = pattern.frequency * pattern.rate, pattern.alias * pattern.rate
    folded = pattern.frequency > 0.5
    yield line(_at(frequency, 0), wave_at(frequency), "world dashed")
    yield dot(wave_at(frequency), "world", 5)
    yield line(_at(frequency, 0), _at(frequency, passed), "world bold")
    yield dot(_at(frequency, passed), "world", 4.5)
    if folded:
        yield line(_at(alias, 0), _at(alias, kept), "error bold")
        yield dot(_at(alias, kept), "error", 4.5)
        yield from _fold(frequency, alias)
    elif not math.isclose(kept, passed):
        yield dot(_at(frequency, kept), "image", 5.5)
    yield from _labels(frequency, alias, folded)


def _fold(frequency: float, alias: float) -> Iterator[str]:
    """The way from the true to the seen frequency, through the fold at 1 where there is one."""
    start, end = _at(frequency, 0)[0], _at(alias, 0)[0]
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
    """Frequencies above the lines, kept apart where the lines are close."""
    x, seen = _at(frequency, 0)[0], _at(alias, 0)[0]
    push = max(0.0, 0.5 * (APART - (x - seen))) if folded else 0.0
    place = (min(max(x + push, LEFT + 24), RIGHT - 22), LABELS)
    yield text(place, f"f = {format_number(frequency)}", "world halo strong", "middle")
    if folded:
        yield text(
            (max(seen - push, LEFT + 16), LABELS),
            format_number(alias),
            "error halo strong",
            "middle",
        )


def _at(frequency: float, amplitude: float) -> tuple[float, float]:
    return (LEFT + (RIGHT - LEFT) * frequency / HIGHEST, FLOOR - (FLOOR - FULL) * amplitude)
