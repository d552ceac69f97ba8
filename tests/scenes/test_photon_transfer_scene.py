"""The photon-transfer figure: its sensor is found again, on files as well, or it says why not."""

import csv
import io
import json
from functools import partial

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from support.flat_fields import FILE_GAIN, as_srgb, light_of
from support.frames import computed_in, frame_of, texts_at

from simulations.engine.frame import Frame
from simulations.engine.photograph import Photograph
from simulations.engine.reading import Reading, Readings, UnfitError
from simulations.engine.stages import Outputs, StageCache
from simulations.models.arrays import Floats
from simulations.models.sensor.bayer import mosaic
from simulations.models.sensor.demosaicing import demosaic
from simulations.scenes.photon_transfer.reading import read
from simulations.scenes.photon_transfer.results import sheet
from simulations.scenes.photon_transfer.scene import SCENE

texts = partial(texts_at, SCENE)


@pytest.mark.parametrize("pairs", [4, 8, 12, 24])
@pytest.mark.parametrize("most", [30, 70, 90])
def test_the_gain_is_found_within_its_error(pairs: int, most: int) -> None:
    shown = texts(pairs=pairs, most=most)
    if shown["gain"] != "cannot be told":
        assert abs(float(shown["gain"]) - 4.0) < 3 * float(shown["gain_error"])


@pytest.mark.parametrize("read_noise", [4, 10, 25, 40])
def test_the_read_noise_is_found_within_its_error(read_noise: int) -> None:
    value, error = texts(read_noise=read_noise)["read"].split(" ± ")
    assert abs(float(value) - read_noise) < 3 * float(error)


def test_full_cells_among_the_fitted_give_no_number() -> None:
    frame = frame_of(SCENE, most=95)
    assert "saturated" in frame.description
    assert "saturated" in frame.panels[0].overlay


def test_moving_the_end_of_the_fit_measures_no_frame_again() -> None:
    cache = StageCache()
    frame_of(SCENE, "", cache)
    assert computed_in(frame_of(SCENE, "", cache, most=40)) == ("sensor", "shown")
    assert "electrons" not in computed_in(frame_of(SCENE, "", cache, read_noise=20))


def reading_of(number: int, codes: NDArray[np.uint8], **facts: float | str) -> Reading:
    name = f"{number}.png"
    return Reading(number, name, read(Photograph(number, codes, name, facts)))


def shown_of(readings: Readings, **given: object) -> tuple[Frame, Outputs]:
    settings = SCENE.check(given)
    outputs = SCENE.run(settings, "", StageCache(), None, readings).outputs
    return SCENE.draw(settings, outputs), outputs


LEVELS = (10.0, 30.0, 60.0, 100.0, 140.0, 200.0)


def test_a_file_of_single_cells_gives_the_gain_of_each_colour() -> None:
    readings = tuple(
        reading_of(2 * k + i, as_srgb(light_of(level, 2 * k + i)), exposure_s=level / 1000)
        for k, level in enumerate(LEVELS)
        for i in (0, 1)
    )
    _, outputs = shown_of(readings)
    for name, sensor in outputs["sensor"].items():
        assert sensor.gain.value == pytest.approx(FILE_GAIN, rel=0.02), name
        assert sensor.gain.value == pytest.approx(FILE_GAIN, abs=3 * sensor.gain.error), name
    lines = {line.name: line for line in sheet(SCENE.check({}), outputs)}
    assert lines["pairs"].text == "6"
    assert lines["pixels"].text == "green"


def test_a_grey_file_is_measured_cell_by_cell_above_its_darkest_pair() -> None:
    readings = []
    for k, level in enumerate((0.0, *LEVELS)):
        for i in (0, 1):
            rng = np.random.default_rng((k, i))
            light = rng.poisson(level * 5.0, (200, 200)) / 5.0 + rng.normal(16.0, 1.0, (200, 200))
            codes = np.rint(np.clip(light, 0, 255)).astype(np.uint8)
            readings.append(reading_of(2 * k + i, np.repeat(codes[..., None], 3, axis=2)))
    _, outputs = shown_of(tuple(readings))
    assert len(outputs["sensor"]) == 4
    for sensor in outputs["sensor"].values():
        assert sensor.gain.value == pytest.approx(5.0, abs=3 * sensor.gain.error)
        assert sensor.read_noise.value == pytest.approx(5.0, abs=3 * sensor.read_noise.error)


def test_interpolated_colours_and_compressed_files_are_told_by_their_neighbours() -> None:
    for develop in (demosaiced, compressed):
        readings = tuple(
            reading_of(2 * k + i, develop(light_of(level, 2 * k + i)))
            for k, level in enumerate(LEVELS)
            for i in (0, 1)
        )
        frame, outputs = shown_of(readings)
        assert "Neighbouring pixels" in frame.description
        sensor = outputs["sensor"]["green"]
        assert sensor.gain.reason
        if develop is demosaiced:  # half of the pixels are means of four
            assert 1 / sensor.noise.slope == pytest.approx(1.6 * FILE_GAIN, rel=0.03)
        lines = {line.name: line for line in sheet(SCENE.check({}), outputs)}
        assert float(lines["noise"].text) > 0


def demosaiced(light: Floats) -> NDArray[np.uint8]:
    return as_srgb(demosaic(mosaic(light / 255)) * 255)


def compressed(light: Floats) -> NDArray[np.uint8]:
    file = io.BytesIO()
    Image.fromarray(as_srgb(light)).save(file, "JPEG", quality=85)
    return np.asarray(Image.open(file))


def test_one_photograph_is_no_pair_and_says_so() -> None:
    frame, outputs = shown_of((reading_of(1, as_srgb(light_of(100.0, 1))),))
    assert "There is no pair" in frame.description
    assert sheet(SCENE.check({}), outputs) == ()
    for export in SCENE.exports:
        assert export.make(SCENE.check({}), outputs)


def test_pictures_of_other_cameras_and_sizes_are_left_over() -> None:
    pair = [as_srgb(light_of(level, seed)) for level, seed in ((50.0, 1), (50.0, 2))]
    readings = (
        reading_of(1, pair[0], iso=400.0),
        reading_of(2, pair[1], iso=400.0),
        reading_of(3, pair[1], iso=800.0),
        reading_of(4, as_srgb(light_of(50.0, 4, 100)), iso=400.0),
    )
    _, outputs = shown_of(readings)
    assert outputs["frames"].names == (("1.png", "2.png"),)
    assert outputs["frames"].left_over == 2
    assert SCENE.measured
    assert SCENE.measured(outputs) == (1, 2)


def test_the_pair_of_the_photograph_looked_at_is_ringed() -> None:
    readings = tuple(
        reading_of(2 * k + i, as_srgb(light_of(level, 2 * k + i)))
        for k, level in enumerate(LEVELS[:3])
        for i in (0, 1)
    )
    looked_at = Photograph(3, np.zeros((8, 8, 3), np.uint8))
    outputs = SCENE.run(SCENE.check({}), "", StageCache(), looked_at, readings).outputs
    assert outputs["shown"] == 1
    assert SCENE.run(SCENE.check({}), "", StageCache(), None, readings).outputs["shown"] == 2


def test_unfit_photographs_say_what_to_do() -> None:
    edge = as_srgb(light_of(100.0, 1))
    edge[:, 90:] //= 2
    for codes, facts, words in (
        (np.zeros((1, 1, 3), np.uint8), {}, "smaller"),
        (edge, {}, "not evenly lit"),
        (as_srgb(light_of(100.0, 1)), {"full_width": 6000.0}, "scaled down"),
    ):
        with pytest.raises(UnfitError, match=words):
            read(Photograph(1, codes, "it.png", facts))


def test_a_large_photograph_is_kept_by_its_middle() -> None:
    codes = np.zeros((3000, 4001, 3), np.uint8)
    kept = read(Photograph(1, codes))
    assert kept["shape"] == [256, 256, 3]
    assert json.dumps(kept)


def test_the_files_have_what_the_figure_shows() -> None:
    settings = SCENE.check({})
    outputs = SCENE.run(settings, "", StageCache()).outputs
    files = {export.name: export.make(settings, outputs) for export in SCENE.exports}
    rows = list(csv.DictReader(io.StringIO(files["photon-transfer"])))
    assert len(rows) == 12
    assert sum(int(row["fitted"]) for row in rows) == 8
    sensor = json.loads(files["sensor"])["planes"]["simulated"]
    assert f"{sensor['gain']['value']:.3f}" == texts()["gain"]
