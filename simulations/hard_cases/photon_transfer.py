"""Pairs of frames from which a sensor cannot be measured, or only in part."""

import numpy as np

from simulations.engine.hard_cases import HardCase, HardCases, exactly, refused
from simulations.models.sensor import photon_transfer_file, photon_transfer_fit
from simulations.models.sensor.photon_counting import Sensor
from simulations.models.sensor.photon_transfer_fit import SensorEstimate, characterise
from simulations.models.sensor.photon_transfer_frames import (
    counted_pair,
    read_pair,
    unequal_cells,
)
from simulations.models.sensor.photon_transfer_pair import measure_pair

SENSOR = Sensor(full_well_e=15_000.0, read_noise_e=10.0, gain_e_per_dn=4.0)
SIDE = 64


def _pairs(prnu: float = 0.01, brightest: float = 1.1) -> list[np.ndarray]:
    rng = np.random.default_rng(3)
    cells = unequal_cells((SIDE, SIDE), prnu, 0.0, rng)
    means = np.linspace(0.0, brightest * SENSOR.full_well_e, 12)
    return [read_pair(counted_pair(mean, cells, SENSOR, rng), cells, SENSOR, rng) for mean in means]


def _sensor(pairs: list[np.ndarray], most: float = 0.7) -> SensorEstimate:
    levels = [measure_pair(pair, 4095) for pair in pairs]
    return characterise(levels, levels[0].mean_dn if levels else 0.0, 4095, most)


def _smoothed(pairs: list[np.ndarray]) -> list[np.ndarray]:
    """Each pixel the mean of two neighbours."""
    return [((pair[..., 1:] + pair[..., :-1]) // 2).astype(np.uint16) for pair in pairs]


def _gain_of_one_frame(pairs: list[np.ndarray]) -> float:
    """Mean over variance of single frames, as if the cells were equal."""
    black = pairs[0].mean()
    return float(np.mean([(pair[0].mean() - black) / pair[0].var() for pair in pairs[4:8]]))


PAIRS = _pairs()

TABLE = HardCases(
    id="photon-transfer",
    title="A sensor from pairs of frames",
    names={
        **vars(photon_transfer_fit),
        **vars(photon_transfer_file),
        "measure_pair": measure_pair,
        "sensor": _sensor,
        "smoothed": _smoothed,
        "PAIRS": PAIRS,
        "IN_FOCUS": _pairs(prnu=0.08),
        "DIM": _pairs(brightest=0.5),
        "gain_of_one_frame": _gain_of_one_frame,
        "zeros": lambda *shape: np.zeros(shape, np.uint8),
    },
    cases=(
        HardCase(
            id="unequal-cells",
            call="sensor(PAIRS).gain.value",
            why="Cells that differ by 1 % vary as much as bright light does.",
            returns="The gain of 4 e⁻/DN within 3 %, from the differences of pairs.",
            expected=lambda got: abs(got - 4.0) < 0.12,
            naive="gain_of_one_frame(PAIRS)",
        ),
        HardCase(
            id="fit-to-the-full-well",
            call="sensor(PAIRS, most=1.0).gain.reason",
            why="Where the well is full, the noise is gone, and the line is pulled down.",
            returns="No gain. The sentence says that the points lie off the line.",
            expected=lambda got: "saturated" in got,
        ),
        HardCase(
            id="smoothed-file",
            call="sensor(smoothed(PAIRS)).gain.reason",
            why="Means of neighbours have less noise, and still lie on a line.",
            returns="No gain: neighbours share their noise.",
            expected=lambda got: "Neighbouring pixels" in got,
            naive="1 / sensor(smoothed(PAIRS)).noise.slope",
        ),
        HardCase(
            id="surface-in-focus",
            call="sensor(IN_FOCUS).prnu.reason",
            why="The grain of paper is the same in both frames, as the cells are.",
            returns="No PRNU, but the gain, which the difference still has.",
            expected=lambda got: "surface" in got,
        ),
        HardCase(
            id="never-full",
            call="sensor(DIM).saturation.bound",
            why="The brightest pair fills half of the well.",
            returns="No full well: only that it is above what the brightest pair holds, 7500 e⁻.",
            expected=lambda got: got == "above",
        ),
        HardCase(
            id="two-exposures",
            call="sensor(PAIRS[:2]).gain.reason",
            why="A line goes through any two points.",
            returns="No gain: three exposures are needed.",
            expected=lambda got: "three exposures" in got,
        ),
        HardCase(
            id="the-same-file-twice",
            call="measure_pair(zeros(2, 8, 8) + 100, 255).noise_in_codes",
            why="A copy differs from its original by nothing.",
            returns="0, a level that no fit uses, as its noise is less than a code.",
            expected=exactly(0.0),
        ),
        HardCase(
            id="one-pixel",
            call="measure_pair(zeros(2, 1, 1), 255)",
            why="One pixel has no variance.",
            returns="Refused.",
            expected=refused("64 pixels"),
        ),
        HardCase(
            id="third-of-a-kind",
            call="pair_up([Taken(50.0), Taken(50.1), Taken(50.2)])",
            why="Three pictures of one exposure.",
            returns="One pair; the third is left over.",
            expected=lambda got: got == ((0, 1),),
        ),
    ),
)
