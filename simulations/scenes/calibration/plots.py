"""The plots: the error of each model of the lens, and the focal length by the photographs."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import Point, text
from simulations.engine.frame import format_number
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.calibration.camera import LENSES
from simulations.models.calibration.left_out import Growth
from simulations.models.calibration.model_choice import Trial
from simulations.scenes.calibration.settings import LEAST, MOST

WIDTH, HEIGHT = 400.0, 300.0
LEFT, RIGHT, TOP, FOOT = 46.0, 388.0, 40.0, 190.0
ACROSS = Axis(0.0, float(len(LENSES)), LEFT, RIGHT)
TICKS = ("none", "k₁", "+ k₂", "+ p₁p₂", "+ k₃")
"""Each model has the coefficients of those before it."""
FOOT_GROWN = 214.0
SETTLED_FROM = 5
"""Count from which errors must fit into the plot; with fewer they may be huge."""
LEAST_REACH = 0.01
"""Pixels on both sides of the last focal length that the plot always shows."""
COUNTS = Axis(LEAST, MOST, 58.0, RIGHT)
"""Counts of photographs."""
ROUND = tuple(step * 10.0**power for power in range(-7, 8) for step in (1.0, 2.0, 5.0))
"""Values at which an axis of errors may end."""
LINE = 18.0
"""Distance between lines of text."""
WORDS_PER_LINE = 46
"""Letters of a line of text across a panel."""


def place_of(lens: str) -> float:
    """The middle of a model's column."""
    return list(LENSES).index(lens) + 0.5


def lens_at(place: Point) -> str:
    """The model whose column is nearest."""
    index = math.floor(ACROSS.value(float(place[0])))
    return list(LENSES)[min(max(index, 0), len(LENSES) - 1)]


def error_plot(trials: tuple[Trial, ...]) -> Plot:
    """Errors on a logarithmic axis between round values."""
    values = [t.rms_px for t in trials] + [t.left_out_px for t in trials]
    usable = [value for value in values if 1e-6 < value < 1e6] or [1.0]
    low = max(value for value in ROUND if value <= 0.9 * min(usable))
    high = min(value for value in ROUND if value >= 1.1 * max(usable))
    return Plot(ACROSS, Axis(low, high, FOOT, TOP, log=True))


def model_errors(trials: tuple[Trial, ...], chosen: Trial) -> str:
    """For each model, its error on the photographs used and left out, and its AIC."""
    plot = error_plot(trials)
    x = [place_of(trial.lens) for trial in trials]
    ticks_up = _ticks(plot.y)
    best = min(trial.aic for trial in trials)
    edges = (place_of(chosen.lens) - 0.5, place_of(chosen.lens) + 0.5)
    ticks = [(index + 0.5, name) for index, name in enumerate(TICKS)]
    parts = [
        plot.region(x=edges),
        plot.frame(
            Scale(ticks=ticks, style="small"),
            Scale("RMS error", "px", ticks_up, ticks_up, "small", "muted small"),
        ),
        plot.curve(x, [trial.rms_px for trial in trials], "image"),
        plot.curve(x, [trial.left_out_px for trial in trials], "error bold"),
        *(plot.mark(at, t.rms_px, "image", 3.0) for at, t in zip(x, trials, strict=True)),
        *(
            plot.mark(at, min(t.left_out_px, plot.y.high), "error", 4.0)
            for at, t in zip(x, trials, strict=True)
        ),
        text((plot.x.place(place_of(chosen.lens)), TOP - 8.0), "supported", "small", "middle"),
        *_akaike(plot, x, [trial.aic - best for trial in trials]),
        legend(
            (LEFT, 282.0),
            (Entry("photographs used", "image", "dot"), Entry("left out", "error", "dot")),
            "small",
            RIGHT - LEFT,
        ),
    ]
    return "".join(parts)


def _ticks(axis: Axis) -> list[float]:
    """Round values between the ends; of more than five, the powers of ten and the ends."""
    inside = [value for value in ROUND if axis.low <= value <= axis.high]
    if len(inside) <= 5:
        return inside
    return [v for v in inside if v in (axis.low, axis.high) or _is_power_of_ten(v)]


def _is_power_of_ten(value: float) -> bool:
    return abs(math.log10(value) - round(math.log10(value))) < 1e-9


def _akaike(plot: Plot, x: list[float], above: list[float]) -> Iterator[str]:
    """How far each AIC is above the least."""
    row = FOOT + 44.0
    yield text((2.0, row), "ΔAIC", "muted small")
    for at, value in zip(x, above, strict=True):
        yield text((plot.x.place(at), row), format_number(value, 0), "muted small", "middle")


def growth_plot(grown: Growth, truth: float | None) -> Plot:
    """The focal length with its errors, from `SETTLED_FROM` photographs on or of all, if these are
    fewer, and the truth."""
    known = np.isfinite(grown.value) & np.isfinite(grown.error)
    known &= np.array(grown.counts) >= min(SETTLED_FROM, grown.counts[-1])
    ends = [grown.value[-1] - LEAST_REACH, grown.value[-1] + LEAST_REACH]
    ends += [*(grown.value - grown.error)[known], *(grown.value + grown.error)[known]]
    if truth is not None:
        ends.append(truth)
    spare = 0.1 * (max(ends) - min(ends))
    return Plot(COUNTS, Axis(min(ends) - spare, max(ends) + spare, FOOT_GROWN, TOP))


def _finite(value: float, otherwise: float) -> float:
    return float(value) if math.isfinite(value) and value > 0.0 else otherwise


def growth(grown: Growth, count: int, truth: float | None) -> str:
    """The focal length ± its standard error from the first photographs."""
    plot = growth_plot(grown, truth)
    counts = np.array(grown.counts, float)
    error = np.where(np.isfinite(grown.error), grown.error, 1e6)
    value = np.where(np.isfinite(grown.value), grown.value, grown.value[-1])
    parts = [
        plot.between(counts, value + error, value - error, "image fill faint"),
        plot.frame(
            Scale("photographs", style="small", tick_style="muted small"),
            Scale("f_x", "px", style="small", tick_style="muted small"),
        ),
        plot.curve(counts, value, "image bold"),
        "" if truth is None else plot.level(truth, "world dashed"),
        plot.upright(_at(grown, count)[0], "muted thin"),
        plot.mark(*_at(grown, count), "image", 4.5),
    ]
    entries = [Entry("± one standard error", "image fill faint", "area")]
    if truth is not None:
        entries.append(Entry("the truth", "world dashed"))
    return "".join((*parts, legend((58.0, 282.0), entries, "small")))


def _at(grown: Growth, count: int) -> tuple[float, float]:
    index = min(max(count - grown.counts[0], 0), len(grown.counts) - 1)
    return float(grown.counts[index]), _finite(grown.value[index], float(grown.value[-1]))


def place_of_count(grown: Growth, count: int, truth: float | None) -> tuple[float, float]:
    """Where the mark of a count is."""
    plot = growth_plot(grown, truth)
    return plot.clamped(*_at(grown, count))


def count_at(place: Point) -> float:
    """The count at a place."""
    return COUNTS.value(float(place[0]))


def said(sentence: str) -> str:
    """A sentence in place of a plot."""
    lines: list[str] = [""]
    for word in sentence.split():
        joined = f"{lines[-1]} {word}".strip()
        if len(joined) > WORDS_PER_LINE:
            lines.append(word)
        else:
            lines[-1] = joined
    top = HEIGHT / 2 - LINE * (len(lines) - 1) / 2
    return "".join(
        label((WIDTH / 2, top + LINE * index), words, "", "middle")
        for index, words in enumerate(lines)
    )
