"""The tone curve that the noise instrument fits to exposures of a wall, in the instrument that
measures the sharpness of an edge."""

import json
import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from support.charts import gaussian_edge, gaussian_half, grain

from simulations.engine.photograph import Photograph
from simulations.engine.reading import Reading
from simulations.engine.stages import StageCache
from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.color.tone_curve import tone_by_exposures, tone_curve
from simulations.scenes.photon_transfer.frames import read
from simulations.scenes.photon_transfer.results import json_file
from simulations.scenes.photon_transfer.scene import SCENE as NOISE
from simulations.scenes.slanted_edge.edge import Sharpness
from simulations.scenes.slanted_edge.scene import SCENE as SHARPNESS

CAMERA: dict[str, float | str] = {"make": "A", "model": "B"}
SECONDS = 2.0 ** np.arange(-5.0, 1.0)
SEEDS = range(16)


def developed(light: Floats, strength: float) -> NDArray[np.uint8]:
    codes = tone_curve(encode_srgb(np.clip(light, 0, 1)), strength)
    return np.repeat(np.rint(255 * codes).astype(np.uint8)[..., None], 3, axis=2)


def sensor_file(strength: float) -> dict[str, object]:
    """The file that the noise instrument saves for pairs of a nearly neutral white wall."""
    wall = [
        Photograph(
            2 * k + i,
            developed(0.7 * seconds + grain((160, 160), 0.01, 2 * k + i), strength)
            + np.array([0, 0, 1], np.uint8),
            f"{k}{i}.jpg",
            {**CAMERA, "exposure_s": float(seconds), "iso": 100.0},
        )
        for k, seconds in enumerate(SECONDS)
        for i in (0, 1)
    ]
    readings = tuple(Reading(each.number, each.name, read(each)) for each in wall)
    settings = NOISE.check({})
    outputs = NOISE.run(settings, "", StageCache(), None, readings).outputs
    return dict(json.loads(json_file(settings, outputs)))


def apart_from_unseen(found: Sharpness) -> float:
    """The error of MTF50 without the share of sharpening that would not show."""
    return math.sqrt(found.half.error**2 - found.unseen**2)


@pytest.mark.parametrize("strength", [-0.3, 0.2, 0.5, 0.8])
def test_measured_tone_curve_gives_the_true_sharpness_with_less_error(strength: float) -> None:
    """Apart from sharpening that would not show, MTF50 agrees within three errors, less than an
    eighth of those with an unknown curve."""
    given = sensor_file(strength)
    for seed in SEEDS:
        light = 0.05 + 0.7 * gaussian_edge(300, 400, 5.0, 1.0 + 0.05 * seed)
        codes = developed(light + grain(light.shape, 0.004, seed), strength)
        edge = Photograph(1, codes, "edge.jpg", {**CAMERA, "iso": 800.0})
        runs = (
            SHARPNESS.run(SHARPNESS.check({}), "", StageCache(), edge, readings)
            for readings in ((Reading(1, "given", given),), ())
        )
        known, unknown = (run.outputs["sharpness"] for run in runs)
        true = gaussian_half(1.0 + 0.05 * seed)
        assert abs(known.half.frequency - true) < 3 * apart_from_unseen(known)
        assert apart_from_unseen(known) < apart_from_unseen(unknown) / 8
        assert known.half.error < unknown.half.error


def test_curve_of_another_camera_is_ignored() -> None:
    given = {**sensor_file(0.8), "model": "A, C"}
    edge = Photograph(1, developed(0.05 + 0.7 * gaussian_edge(300, 400, 5.0), 0.0), "", CAMERA)
    readings = (Reading(1, "given", given),)
    outputs = SHARPNESS.run(SHARPNESS.check({}), "", StageCache(), edge, readings).outputs
    assert outputs["tone"].strength == 0


@pytest.mark.parametrize(
    "curve",
    [
        lambda codes: 0.4 * codes + 0.6 * codes**2 * (3 - 2 * codes),
        lambda codes: codes**1.2,
        lambda codes: 1 - (1 - codes) ** 1.3,
    ],
    ids=["S", "toe", "shoulder"],
)
def test_error_covers_curves_of_another_family(curve: Callable[[Floats], Floats]) -> None:
    """The sharpness of a 20 : 1 edge under the fitted curve agrees within 2.5 errors."""
    seconds = 0.5 ** np.arange(1, 10)
    fitted = tone_by_exposures(decode_srgb(curve(encode_srgb(0.9 * 2 * seconds))), seconds)
    assert fitted is not None
    given = {"value": fitted[0], "standard_error": fitted[1]}
    light = 0.04 + 0.76 * gaussian_edge(300, 400, 5.0, 0.9)
    codes = np.rint(255 * curve(encode_srgb(light))).astype(np.uint8)
    edge = Photograph(1, np.repeat(codes[..., None], 3, axis=2), "", CAMERA)
    readings = (Reading(1, "given", {"model": "A, B", "tone_curve": given}),)
    outputs = SHARPNESS.run(SHARPNESS.check({}), "", StageCache(), edge, readings).outputs
    found = outputs["sharpness"]
    assert outputs["tone"].strength == fitted[0]
    assert abs(found.half.frequency - gaussian_half(0.9)) < 2.5 * apart_from_unseen(found)


@pytest.mark.parametrize("frames", [4, 6, 12])
def test_strength_agrees_within_two_errors_for_nine_in_ten_cameras(frames: int) -> None:
    """Cameras of 64 strengths, whose shutters are off by a twentieth of a stop."""
    hits = 0
    for seed in range(64):
        rng = np.random.default_rng((frames, seed))
        strength, stops = rng.uniform(-0.5, 0.9), np.linspace(-3, 0, frames)
        seen = decode_srgb(tone_curve(encode_srgb(0.6 * 2**stops), strength))
        found = tone_by_exposures(seen, 2 ** (stops + rng.normal(0, 0.05, frames)))
        assert found is not None
        hits += abs(found[0] - strength) < 2 * found[1]
    assert hits >= 0.9 * 64
