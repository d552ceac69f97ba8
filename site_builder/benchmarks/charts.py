"""The chart of a ladder: what each tier costs in time against what it gets wrong.

A filled dot is CPython, a hollow one the browser, joined because they are the same computation.
The line runs through the tiers of the front; what is clearly beaten is grey.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from simulations.engine import drawing
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.labels import Label, Rectangle, place_labels
from simulations.engine.plotting.ticks import Tick
from site_builder.benchmarks.measurements import SIDES, MeasuredLadder, MeasuredTier
from site_builder.cache.results import cached_result
from site_builder.languages.words import ENGLISH, Words

type Point = tuple[float, float]
type Segment = tuple[Point, Point]
type TierPoint = Callable[[MeasuredTier, str], Point]
"""Where a tier stands on one side."""

WIDTH, HEIGHT = 420, 320
LEFT, RIGHT, TOP, BOTTOM = 51.0, 408.0, 34.0, 270.0
NONE_ROW = 22.0
"""Height of the strip for tiers without any error."""
RADIUS = 4.5
FRAME = Rectangle(LEFT, TOP - 6, RIGHT + 8, BOTTOM)
LETTERS = 0.85
"""Font size of a name, relative to the labels of a figure."""


@dataclass(frozen=True, slots=True)
class ChartAxis:
    """One axis. Values off its ends are put on them."""

    scale: Axis
    none: float | None = None
    """View box coordinate that stands for no error at all; None where nothing is free of error."""

    def position(self, value: float) -> float:
        """View box coordinate of a value."""
        if self.none is not None and (value <= 0.0 if self.scale.log else math.isinf(value)):
            return self.none
        return self.scale.clamped(value)

    def ticks(self) -> tuple[Tick, ...]:
        return tuple(self.scale.ticks())


@dataclass(frozen=True, slots=True, kw_only=True)
class Chart:
    """A drawn chart, and the axes with which the page's script adds points of its own."""

    marks: str
    """Everything but the names."""
    names: str
    """Drawn over the reader's own points, so that they stay readable."""
    time: ChartAxis
    error: ChartAxis
    description: str
    width: float = WIDTH
    height: float = HEIGHT


def pareto_chart(measured: MeasuredLadder, words: Words = ENGLISH) -> Chart:
    """The chart, cached by what it shows."""
    metric = measured.metric
    tiers = [(i.tier.id, i.tier.label, i.errors, i.times, i.draws) for i in measured.tiers]
    given = (tiers, metric.id, metric.label, metric.unit, metric.higher_is_better, words)
    return cached_result("chart", given, lambda: _draw(measured, words))


def _draw(measured: MeasuredLadder, words: Words) -> Chart:
    spans = [item.times[side] for item in measured.tiers for side in SIDES]
    time = log_axis((value for t in spans for value in (t.low, t.ms, t.high)), LEFT, RIGHT)
    error = _error_axis(measured)

    def at(item: MeasuredTier, side: str) -> tuple[float, float]:
        value = item.errors[measured.metric.id]
        free = float("inf") if measured.metric.higher_is_better else 0.0
        y = error.position(free if value is None else value)
        return time.position(item.times[side].ms), y

    beaten = {(item.tier.id, side) for side in SIDES for item in measured.beaten(side)}
    fronts = [[at(i, side) for i in measured.front(side)] for side in SIDES]
    curves = [
        drawing.polyline(front, manner)
        for front, manner in zip(fronts, ("image faint", "image faint dashed"), strict=True)
    ]
    marks = [
        _marks(at(i, "native"), at(i, "browser"), [(i.tier.id, side) in beaten for side in SIDES])
        for i in measured.tiers
    ]
    spreads = [_spread(i, side, at(i, side)[1], time) for i in measured.tiers for side in SIDES]
    spreads += [
        ((x, error.position(low)), (x, error.position(high)))
        for i in measured.tiers
        if (ends := i.spread(measured.metric.id))
        for (low, high), (x, _) in [(ends, at(i, "browser"))]
    ]
    bars = [drawing.line(*bar, "image spread") for bar in spreads]
    joins = [(at(i, "native"), at(i, "browser")) for i in measured.tiers]
    lines = [*spreads, *joins, *(step for front in fronts for step in pairwise(front))]
    parts = [_grid(time, error, measured, words), *curves, *bars, *marks]
    names = _names(measured, at, lines, {tier for tier, side in beaten if side == "browser"})
    return Chart(
        marks="".join(parts),
        names=names,
        time=time,
        error=error,
        description=describe(measured, words),
    )


def describe(measured: MeasuredLadder, words: Words = ENGLISH) -> str:
    """The chart in a sentence."""
    names = ", ".join(item.tier.label for item in measured.front("browser"))
    losers = [item.tier.label for item in measured.beaten("browser")]
    sentences = [
        words("chart.against_time", metric=measured.metric.label, count=len(measured.tiers)),
        words("chart.front", tiers=names),
        *([words("chart.beaten", tiers=", ".join(losers))] if losers else []),
    ]
    return " ".join(sentences)


def _error_axis(measured: MeasuredLadder) -> ChartAxis:
    """Errors grow upwards, so that low is good; ratios of signal to noise too: there high is."""
    higher = measured.metric.higher_is_better
    name = measured.metric.id
    values = [item.errors[name] for item in measured.tiers]
    values += [end for item in measured.tiers for end in item.spread(name) or () if end]
    some_free = any(value is None or (value == 0.0 and not higher) for value in values)
    finite = [value for value in values if value is not None]
    if higher or min(finite, default=0.0) < 0.0:
        low = TOP + NONE_ROW if some_free else TOP
        return linear_axis(finite, BOTTOM, low, TOP + 6.0 if some_free else None)
    high = BOTTOM - NONE_ROW if some_free else BOTTOM
    return log_axis(finite, high, TOP, BOTTOM - 6.0 if some_free else None)


def _grid(time: ChartAxis, error: ChartAxis, measured: MeasuredLadder, words: Words) -> str:
    metric = measured.metric
    better = "chart.higher" if metric.higher_is_better else "chart.lower"
    rules, labels = [], []
    for value, label in time.ticks():
        x = time.position(value)
        rules.append([(x, TOP), (x, BOTTOM)])
        labels.append(drawing.text((x, BOTTOM + 17), words.numeral(label), "muted", "middle"))
    for value, label in error.ticks():
        y = error.position(value)
        rules.append([(LEFT, y), (RIGHT, y)])
        labels.append(drawing.text((LEFT - 7, y + 4.5), words.numeral(label), "muted", "end"))
    if error.none is not None:
        word = "∞" if metric.higher_is_better else words("ladder.none")
        labels.append(drawing.text((LEFT - 7, error.none + 4.5), word, "muted", "end"))
    titles = (
        drawing.text((4, 14), words(better, metric=metric.label, unit=metric.unit)),
        drawing.text((RIGHT, HEIGHT - 10), words("chart.time"), "", "end"),
    )
    return "".join(
        (
            drawing.path(rules, "muted thin grid"),
            drawing.line((LEFT, BOTTOM), (RIGHT, BOTTOM), "muted"),
            *labels,
            *titles,
        )
    )


def _marks(native: tuple[float, float], browser: tuple[float, float], grey: Sequence[bool]) -> str:
    """Both dots of a tier, joined."""
    first, second = ("muted" if is_beaten else "image" for is_beaten in grey)
    return (
        drawing.line(native, browser, f"{second} thin")
        + drawing.circle(native, RADIUS, f"{first} solid")
        + drawing.circle(browser, RADIUS, f"{second} hollow")
    )


def _spread(item: MeasuredTier, side: str, y: float, time: ChartAxis) -> tuple[Point, Point]:
    """Ends of the bar over the middle half of the samples."""
    low, high = (time.position(v) for v in (item.times[side].low, item.times[side].high))
    return (low, y), (high, y)


def _names(
    measured: MeasuredLadder, at: TierPoint, lines: Sequence[Segment], grey: set[str]
) -> str:
    """A name beside the browser's dot of each tier."""
    dots = [at(item, side) for item in measured.tiers for side in SIDES]
    taken = [Rectangle(x - RADIUS, y - RADIUS, x + RADIUS, y + RADIUS) for x, y in dots]
    labels = [
        Label(
            at(item, "browser"),
            item.tier.label,
            "ground chart-name" + (" muted" if item.tier.id in grey else ""),
            prefer="right",
            leader="muted thin",
            others=[at(item, "native")],
            scale=LETTERS,
        )
        for item in measured.tiers
    ]
    return place_labels(labels, FRAME, lines, taken)


def log_axis(
    values: Iterable[float], start: float, end: float, none: float | None = None
) -> ChartAxis:
    """An axis over all ``values`` above 0, with room at both ends, no shorter than a decade."""
    logs = [math.log10(value) for value in values if value > 0.0] or [0.0]
    low, high = min(logs) - 0.2, max(logs) + 0.2
    missing = max(0.0, 1.0 - (high - low)) / 2
    ends = 10.0 ** (low - missing), 10.0 ** (high + missing)
    return ChartAxis(Axis(*ends, start, end, log=True), none)


def linear_axis(
    values: Iterable[float], start: float, end: float, none: float | None = None
) -> ChartAxis:
    """An axis over all finite ``values``, with room at both ends."""
    finite = [value for value in values if math.isfinite(value)] or [0.0]
    margin = max(0.12 * (max(finite) - min(finite)), 0.5)
    return ChartAxis(Axis(min(finite) - margin, max(finite) + margin, start, end), none)
