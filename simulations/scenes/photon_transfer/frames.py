"""Pairs of evenly lit frames, simulated or from the reader's photographs, and the sensor measured
from them.

The middle of each photograph is kept, so that two of the same light can be compared.
"""

import base64
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from simulations.engine.accuracy import columns
from simulations.engine.frame import format_number
from simulations.engine.photograph import Facts, Mosaic, Photograph
from simulations.engine.reading import Reading, Readings, UnfitError
from simulations.engine.settings import action, slider
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.tone_curve import FEWEST, tone_by_exposures
from simulations.models.sensor import photon_transfer_file as files
from simulations.models.sensor.photon_counting import Sensor
from simulations.models.sensor.photon_transfer_file import COLOURS, HIGHEST
from simulations.models.sensor.photon_transfer_fit import (
    BEND,
    LOSSY,
    SURE,
    Estimate,
    SensorEstimate,
    black_of_dark,
    characterise,
    refused,
    saturation_above,
    single_cells,
)
from simulations.models.sensor.photon_transfer_frames import (
    Cells,
    counted_pair,
    read_pair,
    unequal_cells,
)
from simulations.models.sensor.photon_transfer_pair import Level, measure_pair

type Codes = NDArray[np.unsignedinteger]
type Pair = Codes
"""(2, h, w)"""

# Cells across a simulated frame: 10 000 in all give a variance to 1.4 %, 3600 to 2.4 %.
LEVELS = columns(60, 100, label="Frames of {0} × {0} cells")
FULL_WELL_E, GAIN_E_PER_DN = 15_000.0, 4.0
BRIGHTEST_PERCENT = 110
BRIGHTEST_E = BRIGHTEST_PERCENT / 100 * FULL_WELL_E
PRNU, DSNU_E = 0.01, 4.0
SAMPLED = Sensor(
    full_well_e=1800.0, read_noise_e=10.0, gain_e_per_dn=8.0, bits=8, black_level_dn=8.0
)
"""The sensor of the photographs to try."""
SIMULATED = "simulated"  # name of the only plane of the simulated sensor, which sees no colour

STORED_SIDE = 256  # of the square in the middle, in px; a smaller photograph is kept whole
SMALLEST = 64
WORTH_SAYING_DN = 0.2  # difference of two black levels
DARK = 0.01 * HIGHEST
"""Added to the mean of a raw file's light for the test whether that is even: with black taken off,
a dark picture has nothing but noise."""
MOST_BENT, MOST_TONED = 0.05, 0.02
"""Bend of the response, and strength of a tone curve by exposures, above which a colour file does
not have the light of sRGB; the gain would be off by twice as much."""
TONED = (
    "The file has a tone curve on top of sRGB, so that its codes do not tell the light: take raw "
    "files, or the camera’s neutral style."
)
TOO_FEW = f"A tone curve needs {FEWEST} exposures whose files say how long they were."
TOO_SMALL = f"The photograph is smaller than {SMALLEST} × {SMALLEST} pixels; take a larger one."
NO_MOSAIC = (
    "The file has no mosaic of 2 × 2 cells, red, green and blue; take a raw file of another "
    "camera, or a JPEG or PNG."
)
SCALED = (
    "The photograph was scaled down, which averages its noise; save the middle of it as a file of "
    "at most 24 megapixels, without scaling."
)
UNEVEN = (
    "The middle of the photograph is not evenly lit; photograph a white wall or the cloudy sky, "
    "out of focus."
)


@dataclass(frozen=True, slots=True)
class Settings:
    """Pairs and read noise are those of the simulated sensor."""

    brighten: int = action("Grow brighter", "Pause", drives="light", effect="play", seconds=7.0)
    light: int = slider("Light of the pair shown", 70, 0, BRIGHTEST_PERCENT, 1, unit="% of full")
    most: int = slider("Fit up to", 70, 5, 100, 1, unit="% of full")
    pairs: int = slider("Pairs of frames", 12, 4, 24, 1)
    read_noise: float = slider("Read noise", 10, 0, 40, 1, unit="e⁻")


def read(photograph: Photograph) -> Mapping[str, Any]:
    """The codes of the middle, and how the photograph was taken.

    Returns
    -------
    ``codes``, base64 of ``shape`` (h, w, 3) codes; ``mean_code``, that of green;
    ``camera`` by the file; ``exposure_s`` or ``None``. Of a raw file the codes are (h, w), of 16
    bits, ``cells`` has their ``colours``, ``black`` and ``white``, and ``mean_code`` is the mean
    above black, in 255ths of white.

    Raises
    ------
    UnfitError
        For a photograph that is too small, scaled down, or unevenly lit.
    """
    if photograph.mosaic is not None:
        return read_cells(photograph.mosaic, photograph.facts)
    codes, facts = photograph.codes, photograph.facts
    if "raw" in facts:
        raise UnfitError(NO_MOSAIC)
    if min(codes.shape[:2]) < SMALLEST:
        raise UnfitError(TOO_SMALL)
    if photograph.is_scaled:
        raise UnfitError(SCALED)
    middle = middle_of(codes)
    if max(map(files.unevenness, files.planes_of(middle).values())) > files.MOST_UNEVEN:
        raise UnfitError(UNEVEN)
    return facts_of(middle, float(middle[..., 1].mean()), facts)


def read_cells(mosaic: Mosaic, facts: Facts) -> Mapping[str, Any]:
    if min(mosaic.codes.shape) < 2 * SMALLEST:
        raise UnfitError(TOO_SMALL)
    middle = np.minimum(middle_of(mosaic.codes), np.uint16(mosaic.white))
    light = [
        HIGHEST * (cell.astype(float) - black) / (mosaic.white - black)
        for cell, black in zip(
            files.cells_of(middle, mosaic.colours).values(), mosaic.black, strict=True
        )
    ]
    if max(files.unevenness(cell, DARK) for cell in light) > files.MOST_UNEVEN:
        raise UnfitError(UNEVEN)
    about = {"colours": mosaic.colours, "black": list(mosaic.black), "white": mosaic.white}
    return {**facts_of(middle, float(np.mean(light)), facts), "cells": about}


def middle_of[T: np.generic](codes: NDArray[T]) -> NDArray[T]:
    """The middle, from an even row and column on, so that cells of a mosaic keep their names."""
    top, left = (max(side - STORED_SIDE, 0) // 4 * 2 for side in codes.shape[:2])
    return np.ascontiguousarray(codes[top : top + STORED_SIDE, left : left + STORED_SIDE])


def facts_of(middle: Codes, mean_code: float, facts: Facts) -> dict[str, Any]:
    return {
        "codes": base64.b64encode(middle.tobytes()).decode(),
        "shape": list(middle.shape),
        "mean_code": round(mean_code, 4),
        "camera": files.camera_of(facts),
        "model": files.model_of(facts),
        "exposure_s": float(facts["exposure_s"]) if "exposure_s" in facts else None,
    }


@dataclass(frozen=True, slots=True)
class StoredMiddle:
    """The middle of a photograph, as codes again."""

    kind: Literal["colour", "grey", "raw"]
    planes: Mapping[str, Codes]
    """(h, w) each, by name."""
    highest: int = HIGHEST
    """The largest code."""
    black: Mapping[str, float] = field(default_factory=dict)
    """Code without light of each plane, if the file gives it."""


def stored_middle(reading: Reading) -> StoredMiddle:
    data = reading.data
    shape, stored = tuple(map(int, data["shape"])), base64.b64decode(data["codes"])
    if "cells" not in data:
        codes = np.frombuffer(stored, np.uint8).reshape(shape)
        return StoredMiddle("grey" if files.is_grey(codes) else "colour", files.planes_of(codes))
    about = data["cells"]
    cells = files.cells_of(np.frombuffer(stored, np.uint16).reshape(shape), about["colours"])
    black = dict(zip(cells, about["black"], strict=True))
    return StoredMiddle("raw", cells, int(about["white"]), black)


def taken_of(reading: Reading, stored: StoredMiddle) -> files.Taken:
    """Kind and size of the file are of the camera as well: only what is alike makes a pair."""
    data = reading.data
    camera = (
        f"{data['camera']} {data['shape']} {stored.kind} {list(stored.planes)} {stored.highest}"
    )
    exposure = math.nan if data["exposure_s"] is None else float(data["exposure_s"])
    return files.Taken(float(data["mean_code"]), camera, exposure)


@dataclass(frozen=True, slots=True)
class Frames:
    """Pairs of evenly lit frames (2, h, w), of each plane of the file."""

    planes: Mapping[str, tuple[Pair, ...]]
    names: tuple[tuple[str, str], ...]
    """Names of the two files of each pair."""
    numbers: tuple[tuple[int, int], ...]
    """Numbers of the two photographs of each pair; none if they are simulated."""
    left_over: int
    """Photographs without a partner."""
    highest: int
    """The largest code."""
    response: Floats | None
    """(highest + 1,) light of each code in DN; ``None`` if they are in proportion."""
    black: Mapping[str, float]
    """Code without light of each plane, where the files give it."""
    exposures: tuple[float, ...]
    """Seconds of each pair, NaN where the files do not say; any unit if they are simulated."""
    camera: str = ""
    """Maker, model and ISO by the files."""
    model: str = ""
    """Maker and model."""

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
    """The levels of the pairs of one plane."""

    levels: tuple[Level, ...]
    black_dn: float
    """Code without light: 0 in an sRGB file, and otherwise the mean of the darkest pair. In a raw
    file as stated there, if that pair has light."""
    span_dn: float
    """Codes above black."""
    dark: bool
    """Whether the black is measured, or by definition of the file."""
    note: str = ""
    """A sentence if the dark pair and the file differ, or codes are missing."""

    @property
    def mean_dn(self) -> Floats:
        """(N,) above black."""
        return np.array([level.mean_dn for level in self.levels]) - self.black_dn

    @property
    def saturation_dn(self) -> float:
        """Above black."""
        return saturation_above(self.levels, self.black_dn, self.black_dn + self.span_dn)


def sensor_of(read_noise: float) -> Sensor:
    """The simulated sensor: 12 bits, black at 64, and full before its converter is."""
    return Sensor(
        full_well_e=FULL_WELL_E, read_noise_e=read_noise, gain_e_per_dn=GAIN_E_PER_DN, bits=12
    )


def sensor_cells(columns: int) -> Cells:
    return unequal_cells((columns, columns), PRNU, DSNU_E, np.random.default_rng(0))


def count(cells: Cells, pairs: int) -> tuple[Floats, ...]:
    """Pairs from the lens cap to a tenth above the full well."""
    sensor = sensor_of(0.0)
    return tuple(
        counted_pair(mean, cells, sensor, np.random.default_rng((1, k)))
        for k, mean in enumerate(np.linspace(0.0, BRIGHTEST_E, pairs).tolist())
    )


def read_out(electrons: tuple[Floats, ...], cells: Cells, read_noise: float) -> tuple[Pair, ...]:
    """The grain of the amplifier is the same for every read noise."""
    sensor = sensor_of(read_noise)
    return tuple(
        read_pair(counted, cells, sensor, np.random.default_rng((2, k)))
        for k, counted in enumerate(electrons)
    )


def sample(percent: int, which: int) -> Codes:
    """(256, 256, 1) one of two photographs by `SAMPLED`, of light in % of its full well."""
    cells = unequal_cells((STORED_SIDE, STORED_SIDE), PRNU, 0.0, np.random.default_rng(0))
    rng = np.random.default_rng((3, percent))
    counted = counted_pair(0.01 * percent * SAMPLED.full_well_e, cells, SAMPLED, rng)
    return read_pair(counted, cells, SAMPLED, rng)[which, ..., None].astype(np.uint8)


def pair_up(codes: tuple[Pair, ...], readings: Readings) -> Frames:
    """Pairs of the readings, or if there are none, the simulated ones."""
    if not readings:
        names = tuple((f"{k}a", f"{k}b") for k in range(len(codes)))
        highest, exposures = sensor_of(0.0).highest_dn, tuple(map(float, range(len(codes))))
        return Frames({SIMULATED: codes}, names, (), 0, highest, None, {}, exposures)
    stored = [stored_middle(reading) for reading in readings]
    taken = [taken_of(*one) for one in zip(readings, stored, strict=True)]
    pairs = files.pair_up(taken)
    chosen = [(stored[i], stored[j]) for i, j in pairs]
    first = chosen[0][0] if chosen else stored[0]
    return Frames(
        planes={
            plane: tuple(np.stack([one.planes[plane] for one in pair]) for pair in chosen)
            for plane in (first.planes if chosen else COLOURS[1:2])
        },
        names=tuple((readings[i].name, readings[j].name) for i, j in pairs),
        numbers=tuple((readings[i].number, readings[j].number) for i, j in pairs),
        left_over=len(readings) - 2 * len(pairs),
        highest=first.highest if chosen else HIGHEST,
        response=files.SRGB_DN if first.kind == "colour" or not chosen else None,
        black={
            plane: float(np.mean([one.black[plane] for pair in chosen for one in pair]))
            for plane in first.black
            if chosen
        },
        exposures=tuple(taken[i].exposure_s for i, _ in pairs),
        camera=str(readings[pairs[0][0]].data["camera"]) if pairs else "",
        model=str(readings[pairs[0][0]].data["model"]) if pairs else "",
    )


def measure_planes(frames: Frames) -> dict[str, Measured]:
    return {plane: measure(frames, plane, pairs) for plane, pairs in frames.planes.items()}


def measure(frames: Frames, plane: str, pairs: tuple[Pair, ...]) -> Measured:
    levels = tuple(measure_pair(pair, frames.highest, frames.response) for pair in pairs)
    black, dark, note = 0.0, True, ""
    if plane in frames.black:
        stated = frames.black[plane]
        black = black_of_dark(levels, stated, frames.highest)
        dark = not math.isnan(black)
        black = black if dark else stated
        if abs(black - stated) >= WORTH_SAYING_DN:
            found, stated_dn = (format_number(dn, 1) for dn in (black, stated))
            note = (
                f"Black is {found} DN by the dark pair, which counts, and {stated_dn} by the file. "
            )
    elif frames.response is None and levels:
        black = min(level.mean_dn for level in levels)
    if black >= frames.highest:  # all white
        black = 0.0
    steps = [level.step for level in levels]
    if frames.response is None and max(steps, default=1.0) > LOSSY * min(steps, default=1.0):
        note += (
            f"The file is lossy: bright light has one code in {format_number(max(steps), 1)}; the "
            "rounding is taken off the noise."
        )
    return Measured(levels, black, frames.highest - black, dark, note)


def fit(levels: dict[str, Measured], frames: Frames, most: int) -> dict[str, SensorEstimate]:
    """The simulated sensor's response is known to be straight. Of colour files the light is known
    only if they have no tone curve: a sensor does not bend so much, nor by the exposures."""
    single = None
    if frames.response is None and not frames.is_simulated:
        single = single_cells([level for plane in levels.values() for level in plane.levels])
    found = {
        plane: characterise(
            measured.levels,
            measured.black_dn,
            measured.black_dn + measured.span_dn,
            most / 100,
            dark=measured.dark,
            bend=0.0 if frames.is_simulated else BEND,
            single=single,
        )
        for plane, measured in levels.items()
    }
    if frames.response is None or not frames.names:
        return found
    tone, main = tone_of(frames, levels), found[frames.main]
    is_toned = abs(tone.value) > max(MOST_TONED, SURE * tone.error)  # false for NaN
    if is_toned or abs(main.bend.value) > MOST_BENT:
        return {
            plane: refused(sensor, sensor.gain.reason or TONED) for plane, sensor in found.items()
        }
    return found


def tone_of(frames: Frames, levels: Mapping[str, Measured]) -> Estimate:
    """How much steeper the middle tones of the files are than those of sRGB."""
    if frames.response is None or frames.is_simulated:
        return Estimate.unknown("Only pictures with codes in sRGB have a tone curve.")
    main = levels[frames.main]
    found = tone_by_exposures(main.mean_dn / main.span_dn, np.array(frames.exposures))
    return Estimate(*found) if found else Estimate.unknown(TOO_FEW)


def choose(frames: Frames, photograph: Photograph | None, light: int) -> int:
    """Index of the pair that is shown: that of the photograph looked at, or else the one at that
    part of the way from dark to bright; −1 if there is none."""
    if photograph is not None:
        for pair, numbers in enumerate(frames.numbers):
            if photograph.number in numbers:
                return pair
    return round(light / BRIGHTEST_PERCENT * (len(frames.names) - 1)) if frames.names else -1


STAGES = (
    Stage("cells", sensor_cells),
    Stage("electrons", count, ("cells",)),
    Stage("codes", read_out, ("electrons", "cells")),
    Stage("frames", pair_up, ("codes",)),
    Stage("levels", measure_planes, ("frames",)),
    Stage("sensor", fit, ("levels", "frames")),
    Stage("shown", choose, ("frames",)),
)
