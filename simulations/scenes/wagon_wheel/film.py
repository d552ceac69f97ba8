"""The film of the wagon wheel: frames exposed by one of several rules, and their errors."""

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from simulations.engine.frame import Raster, Readout, format_magnitude
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.sensor.exposure import (
    mean_of_instants,
    mean_of_jittered_instants,
    mean_of_random_instants,
)
from simulations.pictures import spoked_wheel
from simulations.pictures.spoked_wheel import Bars, Canvas, Exposure

TIERS = (
    "instants-1",
    "integral",
    "instants-4",
    "instants-16",
    "random-16",
    "jittered-16",
    "instants-64",
)
"""Rungs of the ladder `exposure-blur`, without the smear, which needs motion in a straight line."""
PARTS = 12
"""Steps of the error estimate: each takes a few milliseconds."""


def exposure_of(tier: str, frame: int) -> Exposure:
    """The tier's mean over the exposure; random instants differ between frames."""
    kind, _, count = tier.partition("-")
    match kind:
        case "integral":
            return spoked_wheel.throughout
        case "instants":
            return lambda row: mean_of_instants(partial(spoked_wheel.at_moment, row), int(count))
        case "random" | "jittered":
            rng = np.random.default_rng((frame, 11))
            mean = mean_of_random_instants if kind == "random" else mean_of_jittered_instants
            return lambda row: mean(
                partial(spoked_wheel.at_moment, row), int(count), row.place.shape, rng
            )
    raise ValueError(f"tier {tier!r}; legal: {', '.join(TIERS)}")


def frame_at(time: float) -> int:
    """Number of the current film frame; frame 0 starts at time 0."""
    return math.floor(time + 1e-9)


def film(
    canvas: Canvas,
    spokes: int,
    speed: float,
    frame_rate: float,
    shutter: float,
    frame: int,
    tier: str,
) -> Raster:
    """The picture of film frame ``frame``, (H, W, 4) bytes."""
    turn_per_frame = 2 * math.pi * speed / frame_rate
    first, swept = turn_per_frame * frame, turn_per_frame * shutter
    return spoked_wheel.render(canvas, spokes, first, swept, exposure_of(tier, frame))


STAGES = (
    Stage("canvas", spoked_wheel.build_canvas),
    Stage("film", film, ("canvas",)),
)


def estimates(
    canvas: Canvas, spokes: int, turn_per_frame: float, shutter: float, time: float, tier: str
) -> Iterator[Readout]:
    """RMS error over the pixels where spokes pass, of the light between wall and wood; more pixels
    with each step."""
    frame = frame_at(time)
    swept = turn_per_frame * shutter
    row = spoked_wheel.bars(canvas, spokes, turn_per_frame * frame, swept)
    shown = exposure_of(tier, frame)(row)
    free = 1.0 - canvas.solid[canvas.between]
    squares, pixels = 0.0, 0
    for part in range(PARTS):
        some = slice(part, None, PARTS)
        truth = by_changes(Bars(row.place[some], row.duty[some], row.pixel[some], row.swept))
        off = (shown[some] - truth) * free[some]
        squares, pixels = squares + float(off @ off), pixels + off.size
        text = format_magnitude(math.sqrt(squares / pixels), 1e-12)
        yield Readout("error", "RMS error where spokes pass", text, "of full contrast", "error")


def by_changes(row: Bars) -> Floats:
    """Every moment at which an edge of a spoke meets an edge of a pixel, in order.

    Between two of them the covered share changes evenly, so that its value halfway is its mean.
    """
    times = _moments(row)
    halfway = 0.5 * (times[1:] + times[:-1])
    return (np.diff(times, axis=0) * _overlap(row, halfway)).sum(axis=0)


def _moments(row: Bars) -> Floats:
    """(m, n) times from 0 to 1, in order, between which no edge meets another."""
    ends = [np.zeros_like(row.place), np.ones_like(row.place)]
    if row.swept == 0.0:
        return np.array(ends)
    direction = math.copysign(1.0, row.swept)
    for pixel_edge in (-0.5, 0.5):
        for spoke_edge in (-0.5, 0.5):
            # Distance of the nearest such pair of edges; the next ones are a spacing behind.
            way = direction * (row.place + pixel_edge * row.pixel - spoke_edge * row.duty) % 1.0
            ends += [(way + k) / abs(row.swept) for k in range(math.ceil(abs(row.swept)))]
    return np.sort(np.minimum(ends, 1.0), axis=0)


def _overlap(row: Bars, time: Floats) -> Floats:
    """(m, n) share of each pixel under the nearest spoke and its two neighbours."""
    place = row.place - row.swept * time
    place = place - np.round(place)
    low, high = place - 0.5 * row.pixel, place + 0.5 * row.pixel
    covered = np.zeros_like(place)
    half = np.minimum(row.duty, 1.0) / 2.0
    for spoke in (-1.0, 0.0, 1.0):
        covered += np.maximum(np.minimum(high, spoke + half) - np.maximum(low, spoke - half), 0.0)
    return covered / row.pixel
