"""The stages of the photon-transfer figure: pairs of frames, their levels, and the sensor."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.photograph import Photograph
from simulations.engine.reading import Readings
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.sensor.photon_counting import Sensor
from simulations.models.sensor.photon_transfer_file import (
    COLOURS,
    HIGHEST,
    SRGB_DN,
    pair_up,
)
from simulations.models.sensor.photon_transfer_fit import SensorEstimate, characterise
from simulations.models.sensor.photon_transfer_frames import (
    Cells,
    counted_pair,
    read_pair,
    unequal_cells,
)
from simulations.models.sensor.photon_transfer_pair import Level, measure_pair
from simulations.scenes.photon_transfer.reading import kept_of, taken_of

SIDE, DRAFT_SIDE = 100, 60
"""Of a simulated frame: its 10 000 cells tell a variance to 1.4 %; those of a draft to 2.4 %."""
DRAFT = "small"
"""The draft while the count of pairs is dragged."""
FULL_WELL_E, GAIN_E_PER_DN = 15_000.0, 4.0
BRIGHTEST_E = 1.1 * FULL_WELL_E
PRNU, DSNU_E = 0.01, 4.0
SIMULATED = "simulated"
"""Name of the only plane of the simulated sensor, which sees no colour."""

type Pair = NDArray[np.unsignedinteger]


@dataclass(frozen=True, slots=True)
class Frames:
    """Pairs of evenly lit frames (2, h, w), of each plane of the file."""

    planes: Mapping[str, tuple[Pair, ...]]
    names: tuple[tuple[str, str], ...]
    """Of the two files of each pair."""
    numbers: tuple[tuple[int, int], ...]
    """Of the two photographs of each pair; none are simulated."""
    left_over: int
    """Photographs without a partner."""
    highest: int
    """The largest code."""
    response: Floats | None
    """(highest + 1,) light of each code in DN; ``None`` if they are in proportion."""
    black: Mapping[str, float]
    """Code without light of each plane, where the files say."""

    @property
    def is_simulated(self) -> bool:
        """Whether they are the book's, whose truth is known."""
        return SIMULATED in self.planes

    @property
    def main(self) -> str:
        """The plane that the figure shows: green, or the second cell of a mosaic, green in most."""
        names = list(self.planes)
        greens = [name for name in names if name.startswith(COLOURS[1])]
        return greens[0] if greens else names[min(1, len(names) - 1)]


@dataclass(frozen=True, slots=True)
class Measured:
    """What the pairs of one plane say."""

    levels: tuple[Level, ...]
    black_dn: float
    """Code without light: 0 in an sRGB file, in a raw file what that says, and otherwise the mean
    of the darkest pair."""
    span_dn: float
    """Codes above black."""

    @property
    def mean_dn(self) -> Floats:
        """(N,) above black."""
        return np.array([level.mean_dn for level in self.levels]) - self.black_dn


def sensor_of(read_noise: float) -> Sensor:
    """The simulated sensor: 12 bits, black at 64, and full before its converter is."""
    return Sensor(
        full_well_e=FULL_WELL_E, read_noise_e=read_noise, gain_e_per_dn=GAIN_E_PER_DN, bits=12
    )


def _cells(tier: str) -> Cells:
    side = DRAFT_SIDE if tier == DRAFT else SIDE
    return unequal_cells((side, side), PRNU, DSNU_E, np.random.default_rng(0))


def _electrons(cells: Cells, pairs: int) -> tuple[Floats, ...]:
    """Pairs from the lens cap to a tenth above the full well."""
    sensor = sensor_of(0.0)
    return tuple(
        counted_pair(mean, cells, sensor, np.random.default_rng((1, k)))
        for k, mean in enumerate(np.linspace(0.0, BRIGHTEST_E, pairs).tolist())
    )


def _codes(electrons: tuple[Floats, ...], cells: Cells, read_noise: float) -> tuple[Pair, ...]:
    """The grain of the amplifier is the same for every read noise."""
    sensor = sensor_of(read_noise)
    return tuple(
        read_pair(counted, cells, sensor, np.random.default_rng((2, k)))
        for k, counted in enumerate(electrons)
    )


def _frames(codes: tuple[Pair, ...], readings: Readings) -> Frames:
    if not readings:
        names = tuple((f"{k}a", f"{k}b") for k in range(len(codes)))
        return Frames({SIMULATED: codes}, names, (), 0, sensor_of(0.0).highest_dn, None, {})
    kept = [kept_of(reading) for reading in readings]
    pairs = pair_up([taken_of(*one) for one in zip(readings, kept, strict=True)])
    chosen = [(kept[i], kept[j]) for i, j in pairs]
    first = chosen[0][0] if chosen else kept[0]
    return Frames(
        planes={
            plane: tuple(np.stack([one.planes[plane] for one in pair]) for pair in chosen)
            for plane in (first.planes if chosen else COLOURS[1:2])
        },
        names=tuple((readings[i].name, readings[j].name) for i, j in pairs),
        numbers=tuple((readings[i].number, readings[j].number) for i, j in pairs),
        left_over=len(readings) - 2 * len(pairs),
        highest=first.highest if chosen else HIGHEST,
        response=SRGB_DN if first.kind == "colour" or not chosen else None,
        black={
            plane: float(np.mean([one.black[plane] for pair in chosen for one in pair]))
            for plane in first.black
            if chosen
        },
    )


def _levels(frames: Frames) -> dict[str, Measured]:
    return {plane: _measured(frames, plane, pairs) for plane, pairs in frames.planes.items()}


def _measured(frames: Frames, plane: str, pairs: tuple[Pair, ...]) -> Measured:
    levels = tuple(measure_pair(pair, frames.highest, frames.response) for pair in pairs)
    black = frames.black.get(plane, 0.0)
    if frames.response is None and levels and plane not in frames.black:
        black = min(level.mean_dn for level in levels)
    if black >= frames.highest:  # all white
        black = 0.0
    return Measured(levels, black, frames.highest - black)


def _sensor(levels: dict[str, Measured], most: int) -> dict[str, SensorEstimate]:
    return {
        plane: characterise(
            measured.levels, measured.black_dn, measured.black_dn + measured.span_dn, most / 100
        )
        for plane, measured in levels.items()
    }


def _shown(frames: Frames, sensor: dict[str, SensorEstimate], photograph: Photograph | None) -> int:
    """Index of the pair that is shown: that of the photograph looked at, or else the brightest that
    was fitted, or the middle one; −1 if there is none."""
    if photograph is not None:
        for pair, numbers in enumerate(frames.numbers):
            if photograph.number in numbers:
                return pair
    fitted = np.flatnonzero(sensor[frames.main].fitted)
    return int(fitted[-1]) if fitted.size else math.ceil(len(frames.names) / 2) - 1


STAGES = (
    Stage("cells", _cells),
    Stage("electrons", _electrons, ("cells",)),
    Stage("codes", _codes, ("electrons", "cells")),
    Stage("frames", _frames, ("codes",)),
    Stage("levels", _levels, ("frames",)),
    Stage("sensor", _sensor, ("levels",)),
    Stage("shown", _shown, ("frames", "sensor")),
)
