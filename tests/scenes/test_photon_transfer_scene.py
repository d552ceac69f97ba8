"""The photon-transfer figure against known sensors, simulated and in files, and its refusals."""

import csv
import io
import json
from collections.abc import Callable, Sequence

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from support.charts import FILE_GAIN, SENSOR, as_srgb, light_of, pairs_of
from support.frames import frame_of, outputs_of, texts_at

from simulations.engine.photograph import Mosaic, Photograph
from simulations.engine.raster import opaque
from simulations.engine.reading import Reading, Readings, UnfitError
from simulations.engine.stages import Outputs, StageCache
from simulations.models.arrays import Floats
from simulations.models.sensor.bayer import mosaic
from simulations.models.sensor.demosaicing import demosaic
from simulations.scenes.photon_transfer.frames import SAMPLED, read
from simulations.scenes.photon_transfer.results import sheet
from simulations.scenes.photon_transfer.scene import SCENE

type Black = tuple[float, float, float, float]

LEVELS = (10.0, 30.0, 60.0, 100.0, 140.0, 200.0)
BLACK: Black = (64.0, 64.0, 64.0, 64.0)


@pytest.mark.parametrize("given", [{"pairs": n, "most": m} for n in (8, 24) for m in (40, 70)])
def test_gain_agrees_with_truth_within_three_errors(given: dict[str, object]) -> None:
    shown = texts_at(SCENE, **given)
    assert abs(float(shown["gain"]) - 4.0) < 3 * float(shown["gain_error"])


def photograph(number: int, codes: NDArray[np.uint8], **facts: float | str) -> Photograph:
    return Photograph(number, codes, f"{number}.png", facts)


def raw(number: int, codes: NDArray[np.uint16], black: Black = BLACK) -> Photograph:
    cells = Mosaic(codes, "RGGB", black, SENSOR.highest_dn)
    return Photograph(number, np.zeros((8, 8, 3), np.uint8), f"{number}.dng", {}, cells)


def readings_of(photographs: Sequence[Photograph]) -> Readings:
    """Readings in the form in which the page keeps them."""
    kept = [json.loads(json.dumps(read(each))) for each in photographs]
    pairs = zip(photographs, kept, strict=True)
    return tuple(Reading(each.number, each.name, data) for each, data in pairs)


def measured(photographs: Sequence[Photograph], looked_at: Photograph | None = None) -> Outputs:
    readings = readings_of(photographs)
    return SCENE.run(SCENE.check({}), "", StageCache(), looked_at, readings).outputs


def levels_of(develop: Callable[[Floats], NDArray[np.uint8]]) -> list[Photograph]:
    numbered = [(k, level) for k, level in enumerate(np.repeat(LEVELS, 2).tolist())]
    return [photograph(k, develop(light_of(level, k))) for k, level in numbered]


CURVES: dict[str, Callable[[Floats], Floats]] = {
    "steeper middle tones": lambda codes: codes - 0.1 / (2 * np.pi) * np.sin(2 * np.pi * codes),
    "gamma": lambda codes: codes**1.15,
    "shoulder": lambda codes: 1 - (1 - codes) ** 1.2,
    "slight shoulder": lambda codes: 1 - (1 - codes) ** 1.08,
}


@pytest.mark.parametrize("name", CURVES)
def test_colour_file_with_a_tone_curve_gives_no_gain(name: str) -> None:
    """It would be off by 7 to 35 %, and the bend be called the sensor's."""
    toned = measured(
        levels_of(lambda light: np.rint(255 * CURVES[name](as_srgb(light) / 255)).astype(np.uint8))
    )
    for sensor in toned["sensor"].values():
        assert "tone curve" in sensor.gain.reason
        assert "tone curve" in sensor.bend.reason


def grey(level: float, seed: tuple[int, int]) -> NDArray[np.uint8]:
    rng = np.random.default_rng(seed)
    light = rng.poisson(level * 5.0, (200, 200)) / 5.0 + rng.normal(16.0, 1.0, (200, 200))
    codes = np.rint(np.clip(light, 0, 255)).astype(np.uint8)
    return np.repeat(codes[..., None], 3, axis=2)


GREY = [
    photograph(2 * k + i, grey(level, (k, i)))
    for k, level in enumerate((0.0, *LEVELS))
    for i in (0, 1)
]
SAMPLES = [
    photograph(k, opaque(make())[..., :3])
    for k, make in enumerate(SCENE.instrument.samples.values())
]
RAW = [raw(2 * k + i, pair[i]) for k, pair in enumerate(pairs_of(256, 7)) for i in (0, 1)]


@pytest.mark.parametrize(
    ("photographs", "planes", "gain", "read_noise"),
    [
        (levels_of(as_srgb), ["red", "green", "blue"], FILE_GAIN, None),
        (GREY, None, 5.0, 5.0),
        (SAMPLES, None, SAMPLED.gain_e_per_dn, SAMPLED.read_noise_e),
        (
            RAW,
            ["red", "green, row 0", "green, row 1", "blue"],
            SENSOR.gain_e_per_dn,
            SENSOR.read_noise_e,
        ),
    ],
    ids=["colour", "grey", "samples", "raw"],
)
def test_files_give_the_true_gain_and_read_noise(
    photographs: list[Photograph], planes: list[str] | None, gain: float, read_noise: float | None
) -> None:
    outputs = measured(photographs)
    assert planes is None or list(outputs["sensor"]) == planes
    for name, sensor in outputs["sensor"].items():
        assert sensor.gain.value == pytest.approx(gain, abs=3 * sensor.gain.error), name
        if read_noise:
            error = sensor.read_noise.error
            assert sensor.read_noise.value == pytest.approx(read_noise, abs=3 * error), name
    lines = {line.name: line.text for line in sheet(SCENE.check({}), outputs)}
    assert lines["pairs"] == str(len(photographs) // 2)
    if photographs is RAW:
        assert (lines["pixels"], lines["scale"]) == ("green, row 0", "64.0 and 4095 DN")


def demosaiced(light: Floats) -> NDArray[np.uint8]:
    return as_srgb(demosaic(mosaic(light / 255)) * 255)


def compressed(light: Floats) -> NDArray[np.uint8]:
    file = io.BytesIO()
    Image.fromarray(as_srgb(light)).save(file, "JPEG", quality=85)
    return np.asarray(Image.open(file))


@pytest.mark.parametrize("develop", [demosaiced, compressed])
def test_interpolated_or_compressed_files_give_no_gain(
    develop: Callable[[Floats], NDArray[np.uint8]],
) -> None:
    outputs = measured(levels_of(develop))
    sensor = outputs["sensor"]["green"]
    assert "Neighbouring pixels" in sensor.gain.reason
    assert sensor.gain.reason in SCENE.draw(SCENE.check({}), outputs).description
    if develop is demosaiced:  # half of the pixels are means of four
        assert 1 / sensor.noise.slope == pytest.approx(1.6 * FILE_GAIN, rel=0.03)
    lines = {line.name: line for line in sheet(SCENE.check({}), outputs)}
    assert float(lines["noise"].text) > 0


def test_each_cell_is_measured_above_its_own_black_level() -> None:
    shifts = np.tile(np.array([[0, 6], [3, 9]], np.uint16), (64, 64))
    frames = [frame for pair in pairs_of(128, 3) for frame in pair]
    shifted = [np.minimum(frame + shifts, 4095).astype(np.uint16) for frame in frames]
    black = (64.0, 70.0, 67.0, 73.0)
    levels = measured([raw(k, codes, black) for k, codes in enumerate(shifted)])["levels"].values()
    assert [level.black_dn for level in levels] == pytest.approx(black, abs=0.1)
    assert not any(level.note for level in levels)
    off = measured([raw(k, codes, (65.0, *black[1:])) for k, codes in enumerate(shifted)])
    assert "65.0 by the file" in off["levels"]["red"].note
    np.testing.assert_allclose([level.mean_dn[0] for level in levels], 0.0, atol=0.3)


PAIR = [as_srgb(light_of(50.0, seed)) for seed in (1, 2)]
CELLS = pairs_of(128, 1, count=1)[0]
LIKE_CELLS = np.repeat(CELLS[0, ..., None] // 16, 3, axis=2).astype(np.uint8)


@pytest.mark.parametrize(
    ("photographs", "left_over"),
    [
        (
            [
                photograph(1, PAIR[0], iso=400.0),
                photograph(2, PAIR[1], iso=400.0),
                photograph(3, PAIR[1], iso=800.0),
                photograph(4, as_srgb(light_of(50.0, 4, 100)), iso=400.0),
            ],
            2,
        ),
        ([raw(1, CELLS[0]), photograph(3, LIKE_CELLS), raw(2, CELLS[1])], 1),
    ],
    ids=["cameras and sizes", "kinds of file"],
)
def test_unlike_photographs_make_no_pair(photographs: list[Photograph], left_over: int) -> None:
    outputs = measured(photographs)
    assert outputs["frames"].left_over == left_over
    assert SCENE.instrument.measured
    assert SCENE.instrument.measured(outputs) == (1, 2)
    lines = [line.name for line in sheet(SCENE.check({}), outputs)]
    assert lines.index("left_over") <= 3  # in sight


def test_pair_of_the_selected_photograph_is_ringed() -> None:
    photographs = levels_of(as_srgb)[:6]
    for number in (3, 5):
        looked_at = photograph(number, np.zeros((8, 8, 3), np.uint8))
        assert measured(photographs, looked_at)["shown"] == number // 2


EDGE = as_srgb(light_of(100.0, 1))
EDGE[:, 90:] //= 2
RAW_EDGE = pairs_of(128, 1, count=2)[1][0] // 2
RAW_EDGE[:, 50:] //= 2


@pytest.mark.parametrize(
    ("unfit", "words"),
    [
        (photograph(1, np.zeros((1, 1, 3), np.uint8)), "smaller"),
        (photograph(1, EDGE), "not evenly lit"),
        (photograph(1, as_srgb(light_of(100.0, 1)), full_width=6000.0), "scaled down"),
        (photograph(1, as_srgb(light_of(100.0, 1)), raw=1), "no mosaic"),
        (raw(1, RAW_EDGE), "not evenly lit"),
        (raw(1, CELLS[0][:100]), "smaller"),
    ],
)
def test_unfit_photograph_is_refused(unfit: Photograph, words: str) -> None:
    with pytest.raises(UnfitError, match=words):
        read(unfit)


def test_large_photograph_is_cut_to_256_pixels() -> None:
    kept = read(photograph(1, np.zeros((3000, 4001, 3), np.uint8)))
    assert kept["shape"] == [256, 256, 3]


def test_files_agree_with_the_figure() -> None:
    outputs = outputs_of(SCENE)
    files = {
        export.name: export.make(SCENE.check({}), outputs) for export in SCENE.instrument.exports
    }
    rows = list(csv.DictReader(io.StringIO(files["photon-transfer"])))
    assert (len(rows), sum(int(row["fitted"]) for row in rows)) == (12, 8)
    sensor = json.loads(files["sensor"])["planes"]["simulated"]
    assert f"{sensor['gain']['value']:.3f}" == texts_at(SCENE)["gain"]
    assert "saturated" in frame_of(SCENE, most=100).panels[1].overlay
