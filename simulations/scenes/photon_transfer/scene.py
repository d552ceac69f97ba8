"""Photon transfer: pairs of evenly lit frames, and the sensor measured from their noise."""

import math
from collections.abc import Iterator
from functools import partial
from textwrap import wrap

import numpy as np

from simulations.engine.accuracy import Accuracy
from simulations.engine.drawing import cased, circle, path, text
from simulations.engine.frame import Frame, Panel, Raster, format_number
from simulations.engine.handles import Handle, Point
from simulations.engine.instrument import Instrument
from simulations.engine.photograph import Whole
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import small_scale
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats, Mask
from simulations.models.color.srgb import encode_srgb
from simulations.models.sensor.photon_transfer_fit import SensorEstimate, characterise
from simulations.models.sensor.photon_transfer_pair import Level
from simulations.scenes.photon_transfer.frames import (
    LEVELS,
    SAMPLED,
    STAGES,
    Frames,
    Measured,
    Pair,
    Settings,
    read,
    sample,
)
from simulations.scenes.photon_transfer.results import EXPORTS, measured, readouts, sheet, value_of

SMALL = 0.1  # megapixels of the photograph that is looked at: it only chooses the pair
SIZE = WIDTH, HEIGHT = 400.0, 300.0
LEFT, RIGHT, FOOT, TOP = 50.0, 380.0, 228.0, 34.0
MEANS = small_scale("light: mean above black", "digital numbers (DN)")
ROWS, COLUMNS, GAP = 100, 66, 2  # of the part of a frame shown, and the space between two, in px
CELL = 3.0  # side of a pixel in the panel
SPREAD = 3.5  # standard deviations from mid-grey to white
BARS = 2.0  # standard errors shown
WORDS = 34  # letters in a line of a reason
# Upper ends of the axes of variance and of the pattern for the simulated sensor.
HIGHEST_DN2, HIGHEST_DN = 1100.0, 48.0


def transfer(
    measured: Measured, estimate: SensorEstimate, most: float, shown: int, simulated: bool
) -> Iterator[str]:
    """Noise of all pairs, with error bars, over the line through those that were fitted."""
    mean, reason = measured.mean_dn, estimate.gain.reason
    noise = np.array([level.noise_dn2 for level in measured.levels])
    error = BARS * np.array([level.noise_error_dn2 for level in measured.levels])
    room = 2.2 if reason else 1.1
    plot = plot_of(measured, room * (noise + error), HIGHEST_DN2 if simulated else 0.0)
    end, style = 0.01 * most * measured.saturation_dn, "error bold" if reason else "ray bold"
    yield plot.region(x=(end, measured.span_dn))
    yield plot.frame(MEANS, small_scale("variance of the noise", "DN²", 4))
    if estimate.noise:  # solid as far as it was fitted
        x = np.linspace(0.0, plot.x.high, 101)
        y = estimate.noise.at(x)
        yield plot.curve(x[x <= end], y[x <= end], style)
        yield plot.curve(x[x >= end], y[x >= end], f"{style} dashed")
    yield plot.upright(end, "camera dashed")
    bars = (noise - error, noise + error)
    yield from points(plot, mean, noise, bars, estimate.fitted, "image", shown if simulated else -1)
    if shown >= 0:  # a ring around the pair of the second panel
        place = plot.clamped(float(mean[shown]), float(noise[shown]))
        yield cased(circle, place, 8.0, style="image bold")
    if not reason:
        yield text((LEFT + 14, TOP + 26), value_of(estimate.gain), "ray large strong ground")
        yield text((LEFT + 14, TOP + 46), "electrons per digital number", "ray small ground")
    for number, words in enumerate(wrap(reason, WORDS)):
        yield text((LEFT + 10, TOP + 16 + 19 * number), words, "error small ground")
    entries = (
        Entry(f"pair ± {BARS:.0f} errors", "image", "dot"),
        Entry("fitted line", style, visible=estimate.noise is not None),
        Entry("end of the fit", "camera dashed"),
    )
    yield legend((LEFT, HEIGHT - 8), entries, "small", RIGHT - LEFT)


def pattern(
    measured: Measured, estimate: SensorEstimate, shown: int, simulated: bool
) -> Iterator[str]:
    """Standard deviation of what both frames share, against the mean."""
    variance = np.array([level.pattern_dn2 for level in measured.levels])
    error = BARS * np.array([level.pattern_error_dn2 for level in measured.levels])
    foot, root, top = (
        np.sqrt(np.maximum(each, 0.0)) for each in (variance - error, variance, variance + error)
    )
    plot = plot_of(measured, 1.1 * top, HIGHEST_DN if simulated else 0.0)
    yield plot.frame(MEANS, small_scale("pattern from cell to cell", "DN", 4))
    if estimate.pattern is not None:
        x = np.linspace(0.0, measured.span_dn, 101)
        shared = estimate.pattern.start + estimate.pattern.slope * x**2
        yield plot.curve(x, np.sqrt(np.maximum(shared, 0.0)), "ray bold")
    yield from points(plot, measured.mean_dn, root, (foot, top), estimate.fitted, "error")
    if shown >= 0:
        light, here = float(measured.mean_dn[shown]), float(root[shown])
        words = f"{format_number(here, 1)} DN in a light of {format_number(light, 0)} DN"
        yield cased(circle, plot.clamped(light, here), 8.0, style="error bold")
        yield text((LEFT + 14, TOP + 14), words, "error strong ground")
    entries = (
        Entry(f"pair ± {BARS:.0f} errors", "error", "dot"),
        Entry("DSNU and PRNU, fitted", "ray bold"),
    )
    yield legend((LEFT, HEIGHT - 8), entries, "small")


def plot_of(measured: Measured, values: Floats, highest: float) -> Plot:
    """Axes from 0 to the highest value, or to a fixed one."""
    if not highest:
        highest = float(np.max(values, initial=0.0)) or 1.0
    return Plot(Axis(0.0, measured.span_dn, LEFT, RIGHT), Axis(0.0, highest, FOOT, TOP))


def points(
    plot: Plot,
    x: Floats,
    y: Floats,
    bars: tuple[Floats, Floats],
    fitted: Mask,
    role: str,
    shown: int = -1,
) -> Iterator[str]:
    """Points with error bars; open where they were left out of the fit, and larger up to the pair
    that is ``shown``."""
    ends = zip(x.tolist(), *(end.tolist() for end in bars), strict=True)
    strokes = [[plot.clamped(u, low), plot.clamped(u, high)] for u, low, high in ends]
    if strokes:
        yield path(strokes, role)
    for k, (u, v, use) in enumerate(zip(x.tolist(), y.tolist(), fitted.tolist(), strict=True)):
        radius = 4.5 if k <= shown else 3.0
        yield plot.mark(u, v, role, radius) if use else circle(plot.clamped(u, v), radius, role)


def pair_pixels(frames: Frames, measured: Measured, shown: int) -> Raster:
    """(100, 134, 4) the middle of the first frame, as bright as it is, and of the difference.

    The difference is divided by √2, so that its noise is that of one frame, and has the same
    contrast for all pairs.
    """
    pixels = np.zeros((ROWS, 2 * COLUMNS + GAP, 4), np.uint8)
    pairs = frames.planes[frames.main]
    if shown < 0:
        return pixels
    pair = pairs[shown]
    top, left = (max(pair.shape[1] - ROWS, 0) // 2, max(pair.shape[2] - COLUMNS, 0) // 2)
    first, second = pair[:, top : top + ROWS, left : left + COLUMNS].astype(float)
    light = np.clip((first - measured.black_dn) / measured.span_dn, 0.0, 1.0)
    apart = (first - second - (first.mean() - second.mean())) / math.sqrt(2)
    unit = 2 * SPREAD * max(*(spread(each) for each in pairs), 0.1)
    height, width = light.shape
    bright = light if frames.response is not None else encode_srgb(light)
    for start, part in ((0, bright), (COLUMNS + GAP, np.clip(0.5 + apart / unit, 0.0, 1.0))):
        grey = np.repeat(part[..., None], 3, axis=2)
        pixels[:height, start : start + width] = to_rgba8(grey)
    return pixels


def spread(pair: Pair) -> float:
    """Standard deviation of the noise of one frame, by every fourth row, codes."""
    first, second = pair[:, ::4].astype(float)
    return float((first - second).std()) / math.sqrt(2)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """Variance against mean, a pair of frames, and the pattern that both share."""
    frames: Frames = outputs["frames"]
    sensor: SensorEstimate = outputs["sensor"][frames.main]
    levels: Measured = outputs["levels"][frames.main]
    simulated, shown = frames.is_simulated, outputs["shown"]
    noise = "".join(transfer(levels, sensor, settings.most, shown, simulated))
    shared = "".join(pattern(levels, sensor, shown, simulated))
    pixels = pair_pixels(frames, levels, shown)
    size = CELL * pixels.shape[1], CELL * pixels.shape[0]
    names = "".join(named(levels.levels[shown], levels.black_dn)) if shown >= 0 else ""
    what = f"{len(frames.names)} pairs of evenly lit frames"
    up_to = f"a line fitted up to {format_number(settings.most, 0)} % of saturation"
    return Frame(
        (
            Panel(
                "pair",
                "A pair of frames of an even wall",
                *size,
                pixels,
                overlay=names,
                pixelated=True,
                lead=True,
            ),
            Panel("transfer", "Noise of each pair, against its light", *SIZE, overlay=noise),
            Panel("pattern", "What both frames share", *SIZE, overlay=shared),
        ),
        readouts(outputs),
        (
            f"{what}, and {up_to}, give no conversion gain. {sensor.gain.reason}"
            if sensor.gain.reason
            else f"{what}: {up_to} gives a conversion gain of {value_of(sensor.gain)} e⁻/DN."
        )
        + f" {levels.note}".rstrip(),
    )


def named(level: Level, black_dn: float) -> Iterator[str]:
    """The two halves of the pair, each with its number."""
    noise = math.sqrt(max(level.noise_dn2, 0.0))
    for left, what, number in (
        (8.0, "one frame: its light", level.mean_dn - black_dn),
        (CELL * (COLUMNS + GAP) + 8.0, "difference of two: its noise", noise),
    ):
        words = f"{format_number(number, 0 if number >= 10 else 2)} DN"
        yield text((left, 22), what, "image small ground")
        yield text((left, HEIGHT - 14), words, "image large strong ground")


def end_at(settings: Settings, outputs: Outputs) -> Point:
    """The end of the fit on the axis of the mean."""
    frames: Frames = outputs["frames"]
    levels: Measured = outputs["levels"][frames.main]
    share = 0.01 * settings.most * levels.saturation_dn / levels.span_dn
    return LEFT + share * (RIGHT - LEFT), FOOT


def pair_at(_settings: Settings, outputs: Outputs) -> Point | None:
    """The pair shown of the simulated sensor, on the chart of the pattern."""
    frames: Frames = outputs["frames"]
    if not frames.is_simulated:
        return None
    levels: Measured = outputs["levels"][frames.main]
    light, level = levels.mean_dn[outputs["shown"]], levels.levels[outputs["shown"]]
    plot = plot_of(levels, levels.mean_dn, HIGHEST_DN)
    return plot.clamped(float(light), math.sqrt(max(level.pattern_dn2, 0.0)))


SCENE = Scene(
    "photon-transfer",
    "A Sensor Measured by Its Noise",
    Settings,
    draw,
    STAGES,
    (
        Handle(
            "end", "transfer", "End of the fit", ("most",), end_at, reach="press", role="camera"
        ),
        Handle("pair", "pattern", "Pair shown", ("light",), pair_at, reach="press", role="error"),
    ),
    instrument=Instrument(
        photograph=Whole(SMALL, mosaic=True),
        read=read,
        samples={
            f"true {SAMPLED.gain_e_per_dn:g} e⁻ per DN, {percent} % {'ab'[which]}.png": partial(
                sample, percent, which
            )
            for percent in (0, 3, 8, 18, 35, 60, 90)
            for which in (0, 1)
        },
        exports=EXPORTS,
        sheet=sheet,
        measured=measured,
    ),
    accuracy=Accuracy(levels=LEVELS),
    formula=characterise,
)
