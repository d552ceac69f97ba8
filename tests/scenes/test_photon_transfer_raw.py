"""Raw files in the photon-transfer figure: each kind of cell is measured above its own black."""

import json

import numpy as np
import pytest
from numpy.typing import NDArray
from support.flat_fields import SENSOR, pairs_of

from simulations.engine.photograph import Mosaic, Photograph
from simulations.engine.reading import Reading, UnfitError
from simulations.engine.stages import Outputs, StageCache
from simulations.scenes.photon_transfer.reading import read
from simulations.scenes.photon_transfer.results import sheet
from simulations.scenes.photon_transfer.scene import SCENE

type Black = tuple[float, float, float, float]

BLACK: Black = (64.0, 64.0, 64.0, 64.0)
PICTURE = np.zeros((8, 8, 3), np.uint8)


def reading_of(number: int, codes: NDArray[np.uint16], black: Black = BLACK) -> Reading:
    mosaic = Mosaic(codes, "RGGB", black, SENSOR.highest_dn)
    photograph = Photograph(number, PICTURE, f"{number}.dng", {}, mosaic)
    kept = json.loads(json.dumps(read(photograph)))  # as the page keeps it
    return Reading(number, photograph.name, kept)


def measured(readings: tuple[Reading, ...]) -> Outputs:
    return SCENE.run(SCENE.check({}), "", StageCache(), None, readings).outputs


def test_a_sensor_is_found_by_its_raw_files_without_a_dark_picture() -> None:
    pairs = pairs_of(256, 7)[1:]
    outputs = measured(
        tuple(reading_of(2 * k + i, pair[i]) for k, pair in enumerate(pairs) for i in (0, 1))
    )
    assert list(outputs["sensor"]) == ["red", "green, row 0", "green, row 1", "blue"]
    for name, sensor in outputs["sensor"].items():
        assert sensor.gain.value == pytest.approx(SENSOR.gain_e_per_dn, rel=0.02), name
        assert sensor.read_noise.value == pytest.approx(
            SENSOR.read_noise_e, abs=3 * sensor.read_noise.error
        ), name
    lines = {line.name: line.text for line in sheet(SCENE.check({}), outputs)}
    assert lines["pixels"] == "green, row 0"
    assert lines["scale"] == "64 and 4095"


def test_cells_of_other_blacks_are_each_measured_above_their_own() -> None:
    shifts = np.array([[0, 6], [3, 9]], np.uint16)
    readings = tuple(
        reading_of(
            2 * k + i,
            np.minimum(pair[i] + np.tile(shifts, (64, 64)), 4095).astype(np.uint16),
            black=(64.0, 70.0, 67.0, 73.0),
        )
        for k, pair in enumerate(pairs_of(128, 3))
        for i in (0, 1)
    )
    outputs = measured(readings)
    black = [level.black_dn for level in outputs["levels"].values()]
    assert black == [64.0, 70.0, 67.0, 73.0]
    dark = [level.mean_dn[0] for level in outputs["levels"].values()]
    np.testing.assert_allclose(dark, 0.0, atol=0.3)


def test_levels_of_black_may_be_whole_numbers() -> None:
    (pair,) = pairs_of(128, 1, count=2)[1:]
    bright, whole = np.minimum(pair[0], 3000), (64, 64, 64, 64)
    assert reading_of(1, bright, whole).data == reading_of(1, bright).data


def test_raw_files_and_others_make_no_pair() -> None:
    (pair,) = pairs_of(128, 1, count=1)
    grey = np.repeat(pair[0, ..., None] // 16, 3, axis=2).astype(np.uint8)
    other = Reading(3, "3.png", read(Photograph(3, grey)))
    outputs = measured((reading_of(1, pair[0]), other, reading_of(2, pair[1])))
    assert outputs["frames"].names == (("1.dng", "2.dng"),)
    assert outputs["frames"].left_over == 1


def test_dark_raw_files_are_even_and_an_edge_is_not() -> None:
    dark = pairs_of(128, 1, count=1)[0][0]
    assert reading_of(1, dark)
    bright = pairs_of(128, 1, count=2)[1][0] // 2
    bright[:, 50:] //= 2
    with pytest.raises(UnfitError, match="not evenly lit"):
        reading_of(1, bright)
    with pytest.raises(UnfitError, match="smaller"):
        reading_of(1, dark[:100])


@pytest.mark.parametrize(
    ("codes", "black", "legal"),
    [
        (np.zeros((4, 4), np.uint8), BLACK, r"\(H, W\) uint16"),
        (np.zeros((1, 4), np.uint16), BLACK, r"\(H, W\) uint16"),
        (np.zeros((4, 4), np.uint16), (4095.0,) * 4, "black < white"),
    ],
)
def test_no_other_mosaics_are_taken(codes: NDArray[np.uint16], black: Black, legal: str) -> None:
    with pytest.raises(ValueError, match=legal):
        Mosaic(codes, "RGGB", black, 4095)
