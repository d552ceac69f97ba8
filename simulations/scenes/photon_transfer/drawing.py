"""The panels: variance against mean, a pair of frames, and the pattern that both share."""

import math
from collections.abc import Iterator
from textwrap import wrap

import numpy as np

from simulations.engine.drawing import circle, path, text
from simulations.engine.frame import Raster
from simulations.engine.handles import Point
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats, Mask
from simulations.models.sensor.photon_transfer_fit import Line, SensorEstimate
from simulations.scenes.photon_transfer.stages import Measured, Pair

WIDTH, HEIGHT = 400.0, 300.0
LEFT, RIGHT, FOOT, TOP = 50.0, 380.0, 228.0, 34.0
ROWS, COLUMNS, GAP = 100, 66, 2
"""Size of the part of a frame that is shown, and the space between two, in px."""
CELL = 3.0
"""Side of a pixel in the panel."""
PAIR_WIDTH, PAIR_HEIGHT = CELL * (2 * COLUMNS + GAP), CELL * ROWS
SPREAD = 3.5
"""Standard deviations from mid-grey to white."""
BARS = 2.0
"""Standard errors shown."""
WORDS = 34
"""Letters in a line of a reason."""
HIGHEST_DN2, HIGHEST_DN = 1100.0, 48.0
"""Upper ends of the axes of variance and of the pattern for the simulated sensor."""


def end_place(most: float) -> Point:
    """The handle of the fit's end, given in % of the scale: on the axis of the mean."""
    return LEFT + 0.01 * most * (RIGHT - LEFT), FOOT


def end_of(across: float) -> float:
    """The end in % whose handle is so far from the panel's left."""
    return 100.0 * (across - LEFT) / (RIGHT - LEFT)


def transfer(
    measured: Measured, estimate: SensorEstimate, most: float, shown: int, simulated: bool
) -> str:
    """Noise of all pairs, with error bars, over the line through those that were fitted."""
    mean = measured.mean_dn
    noise = np.array([level.noise_dn2 for level in measured.levels])
    error = np.array([level.noise_error_dn2 for level in measured.levels])
    room = 2.2 if estimate.gain.reason else 1.1
    plot = _plot(measured, room * (noise + BARS * error), HIGHEST_DN2 if simulated else 0.0)
    end = 0.01 * most * measured.span_dn
    line = "error bold" if estimate.gain.reason else "ray bold"
    parts = [
        plot.region(x=(end, measured.span_dn)),
        plot.frame(
            Scale("mean above black", "DN", style="small", tick_style="muted small"),
            Scale("variance of the noise", "DN²", 4, (), "small", "muted small"),
        ),
        *(_line(plot, estimate.noise, end, line) if estimate.noise else ()),
        plot.upright(end, "camera dashed"),
        *_points(plot, mean, noise, error, estimate.fitted),
        *(_chosen(plot, mean, noise, shown) if shown >= 0 else ()),
        *_reason(estimate.gain.reason),
        legend(
            (LEFT, HEIGHT - 8),
            (
                Entry(f"pair ± {BARS:.0f} errors", "image", "dot"),
                Entry("fitted line", line, shown=estimate.noise is not None),
                Entry("end of the fit", "camera dashed"),
            ),
            "small",
            RIGHT - LEFT,
        ),
    ]
    return "".join(parts)


def _plot(measured: Measured, values: Floats, highest: float) -> Plot:
    """From 0 to the highest value, or a fixed one."""
    if not highest:
        highest = float(np.max(values, initial=0.0)) or 1.0
    return Plot(Axis(0.0, measured.span_dn, LEFT, RIGHT), Axis(0.0, highest, FOOT, TOP))


def _line(plot: Plot, fit: Line, end: float, style: str) -> Iterator[str]:
    """Solid as far as it was fitted."""
    mean = np.linspace(0.0, plot.x.high, 101)
    value = fit.start + fit.slope * mean
    yield plot.curve(mean[mean <= end], value[mean <= end], style)
    yield plot.curve(mean[mean >= end], value[mean >= end], f"{style} dashed")


def _points(plot: Plot, x: Floats, y: Floats, error: Floats, fitted: Mask) -> Iterator[str]:
    """Open where they were left out."""
    bars = [
        [plot.clamped(u, v - BARS * e), plot.clamped(u, v + BARS * e)]
        for u, v, e in zip(x.tolist(), y.tolist(), error.tolist(), strict=True)
    ]
    if bars:
        yield path(bars, "image")
    for u, v, use in zip(x.tolist(), y.tolist(), fitted.tolist(), strict=True):
        place = plot.clamped(u, v)
        yield plot.mark(u, v, "image", 3.0) if use else circle(place, 3.5, "image")


def _chosen(plot: Plot, x: Floats, y: Floats, shown: int) -> Iterator[str]:
    """A ring around the pair of the second panel."""
    place = plot.clamped(float(x[shown]), float(y[shown]))
    yield circle(place, 8.0, "casing")
    yield circle(place, 8.0, "image bold")


def _reason(sentence: str) -> Iterator[str]:
    for number, words in enumerate(wrap(sentence, WORDS)):
        yield text((LEFT + 10, TOP + 16 + 19 * number), words, "error small ground")


def pattern(measured: Measured, estimate: SensorEstimate, simulated: bool) -> str:
    """Standard deviation of what both frames share, against the mean."""
    mean = measured.mean_dn
    variance = np.array([level.pattern_dn2 for level in measured.levels])
    error = np.array([level.pattern_error_dn2 for level in measured.levels])
    root = np.sqrt(np.maximum(variance, 0.0))
    top = np.sqrt(np.maximum(variance + BARS * error, 0.0))
    foot = np.sqrt(np.maximum(variance - BARS * error, 0.0))
    plot = _plot(measured, 1.1 * top, HIGHEST_DN if simulated else 0.0)
    parts = [
        plot.frame(
            Scale("mean above black", "DN", style="small", tick_style="muted small"),
            Scale("pattern from cell to cell", "DN", 4, (), "small", "muted small"),
        )
    ]
    if estimate.pattern is not None:
        x = np.linspace(0.0, measured.span_dn, 101)
        shared = estimate.pattern.start + estimate.pattern.slope * x**2
        parts.append(plot.curve(x, np.sqrt(np.maximum(shared, 0.0)), "ray bold"))
    bars = [
        [plot.clamped(u, low), plot.clamped(u, high)]
        for u, low, high in zip(mean.tolist(), foot.tolist(), top.tolist(), strict=True)
    ]
    if bars:
        parts.append(path(bars, "error"))
    for u, v, use in zip(mean.tolist(), root.tolist(), estimate.fitted.tolist(), strict=True):
        place = plot.clamped(u, v)
        parts.append(plot.mark(u, v, "error", 3.0) if use else circle(place, 3.5, "error"))
    parts.append(
        legend(
            (LEFT, HEIGHT - 8),
            (
                Entry(f"pair ± {BARS:.0f} errors", "error", "dot"),
                Entry("DSNU and PRNU, fitted", "ray bold"),
            ),
            "small",
        )
    )
    return "".join(parts)


def pair_pixels(pair: Pair | None) -> Raster:
    """(100, 134, 4) the middle of the first frame, and of the difference, at the same contrast.

    The difference is divided by √2, so that noise looks alike in both.
    """
    shown = np.zeros((ROWS, 2 * COLUMNS + GAP, 4), np.uint8)
    if pair is None:
        return shown
    top, left = (max(pair.shape[1] - ROWS, 0) // 2, max(pair.shape[2] - COLUMNS, 0) // 2)
    first, second = pair[:, top : top + ROWS, left : left + COLUMNS].astype(float)
    frame = first - first.mean()
    apart = (first - second - (first.mean() - second.mean())) / math.sqrt(2)
    unit = 2 * SPREAD * max(float(frame.std()), float(apart.std()), 0.1)
    height, width = frame.shape
    shown[:height, :width] = _grey(frame / unit)
    shown[:height, COLUMNS + GAP : COLUMNS + GAP + width] = _grey(apart / unit)
    return shown


def _grey(share: Floats) -> Raster:
    return to_rgba8(np.repeat(np.clip(0.5 + share, 0.0, 1.0)[..., None], 3, axis=2))


def over_pair() -> str:
    """Names of both halves."""
    right = CELL * (COLUMNS + GAP)
    return text((8, 22), "one frame", "image strong ground") + text(
        (right + 8, 22), "difference / √2", "image strong ground"
    )
