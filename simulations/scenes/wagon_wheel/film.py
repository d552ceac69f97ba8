"""The film of the wagon wheel: frames exposed by one of several rules, and their errors.

Angles are clockwise, as for a wheel that rolls to the right. Time counts in film frames, so that
one step of it is one frame; a frame is exposed from its start for the shutter's share of the frame
time, and then shown until the next.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.frame import Raster, Readout, format_magnitude
from simulations.engine.settings import action, slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.sensor.exposure import (
    mean_of_instants,
    mean_of_jittered_instants,
    mean_of_random_instants,
)
from simulations.pictures import spoked_wheel
from simulations.pictures.spoked_wheel import Bars, Canvas, Exposure

FRAMES = 96
PLAYED_PER_S = 6.0  # film frames a second: a quarter of the cinema's
TIERS = (
    "instants-1", "integral", "instants-4", "instants-16", "random-16", "jittered-16",
    "instants-64",
)  # fmt: skip
"""Rungs of the ladder `exposure-blur`, without the smear, which needs motion in a straight line."""
PARTS = 12  # steps of the error estimate: each takes a few milliseconds


@dataclass(frozen=True, slots=True)
class Settings:
    play: int = action(
        *("Play", "Pause"),
        drives="time",
        effect="play",
        seconds=FRAMES / PLAYED_PER_S,
        arrival=True,
    )
    speed: float = slider("Speed", 2.9, -6, 6, 0.05, unit="turns/s")
    shutter: float = slider("Shutter open for", 0.1, 0, 1, 0.05, unit="of a frame")
    frame_rate: float = slider("Frame rate", 24, 8, 60, 1, unit="frames/s")
    spokes: int = slider("Spokes", 8, 2, 16, 1)
    time: float = slider("Time", 4, 0, FRAMES, 0.05, unit="frames")

    @property
    def turn_per_frame(self) -> float:
        """Turn of the wheel, radians."""
        return 2 * math.pi * self.speed / self.frame_rate

    @property
    def frame(self) -> int:
        """Number of the current film frame; frame 0 starts at time 0."""
        return math.floor(self.time + 1e-9)


def exposure_of(tier: str, frame: int) -> Exposure:
    """The tier's mean over the exposure; random instants differ between frames."""
    kind, _, count = tier.partition("-")
    match kind:
        case "integral":
            return spoked_wheel.exposure_mean
        case "instants":
            return lambda row: mean_of_instants(partial(spoked_wheel.at_moment, row), int(count))
        case "random" | "jittered":
            rng = np.random.default_rng((frame, 11))
            mean = mean_of_random_instants if kind == "random" else mean_of_jittered_instants
            return lambda row: mean(
                partial(spoked_wheel.at_moment, row), int(count), row.place.shape, rng
            )
    raise ValueError(f"tier {tier!r}; legal: {', '.join(TIERS)}")


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


STAGES = (Stage("canvas", spoked_wheel.build_canvas), Stage("film", film, ("canvas",)))


def estimate(settings: Settings, outputs: Outputs, tier: str) -> Iterator[Readout]:
    """RMS error of the current frame against the integral over its exposure, of the cover by
    spokes, over the pixels where spokes pass; more pixels with each step."""
    canvas: Canvas = outputs["canvas"]
    turn, frame = settings.turn_per_frame, settings.frame
    row = spoked_wheel.bars(canvas, settings.spokes, turn * frame, turn * settings.shutter)
    filmed = exposure_of(tier, frame)(row)
    free = 1.0 - canvas.solid[canvas.between]
    squares, pixels = 0.0, 0
    for part in range(PARTS):
        some = slice(part, None, PARTS)
        truth = by_changes(Bars(row.place[some], row.duty[some], row.pixel[some], row.swept))
        off = (filmed[some] - truth) * free[some]
        squares, pixels = squares + float(off @ off), pixels + off.size
        text = format_magnitude(math.sqrt(squares / pixels), 1e-12)
        yield Readout(
            "error", "RMS error where spokes pass", text, "of full contrast", role="error"
        )


def by_changes(row: Bars) -> Floats:
    """Mean over every moment at which an edge of a spoke meets an edge of a pixel, in order.

    Between two of them the covered share changes evenly, so that its value halfway is its mean.
    """
    times = moments(row)
    halfway = 0.5 * (times[1:] + times[:-1])
    return (np.diff(times, axis=0) * overlap(row, halfway)).sum(axis=0)


def moments(row: Bars) -> Floats:
    """(m, n) times from 0 to 1, in order, between which no edge meets another."""
    ends = [np.zeros_like(row.place), np.ones_like(row.place)]
    if row.swept == 0.0:
        return np.array(ends)
    direction = math.copysign(1.0, row.swept)
    for pixel_edge in (-0.5, 0.5):
        for spoke_edge in (-0.5, 0.5):
            # Distance of the nearest such pair of edges; the next ones are a spacing behind.
            phase = direction * (row.place + pixel_edge * row.pixel - spoke_edge * row.duty) % 1.0
            ends += [(phase + k) / abs(row.swept) for k in range(math.ceil(abs(row.swept)))]
    return np.sort(np.minimum(ends, 1.0), axis=0)


def overlap(row: Bars, time: Floats) -> Floats:
    """(m, n) share of each pixel under the nearest spoke and its two neighbours."""
    place = row.place - row.swept * time
    place = place - np.round(place)
    low, high = place - 0.5 * row.pixel, place + 0.5 * row.pixel
    covered = np.zeros_like(place)
    half = np.minimum(row.duty, 1.0) / 2.0
    for spoke in (-1.0, 0.0, 1.0):
        covered += np.maximum(np.minimum(high, spoke + half) - np.maximum(low, spoke - half), 0.0)
    return covered / row.pixel
