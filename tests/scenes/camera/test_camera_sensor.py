"""The camera's sensor: light, noise of the stated sizes, and the bytes that are made of them."""

import math
from functools import partial

import numpy as np
import pytest
from support.frames import frame_of, outputs_of, pixels_of, texts_at

from simulations.engine.controls import Value
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.scenes.camera.scene import SCENE
from simulations.scenes.camera.sensor import (
    ADC,
    BYTE_OF_CODE,
    FULL_WELL_E,
    encode,
    quantise,
    read_noise_e,
    shutter_s,
)

type Setting = dict[str, Value]


shown = partial(frame_of, SCENE)


outputs = partial(outputs_of, SCENE, "layers")


def test_read_noise_has_the_stated_sigma() -> None:
    result = outputs(noise_sigma=12, shot_noise=False)
    noise = result["read noise"] - result["exposure"]
    assert noise.std() == pytest.approx(read_noise_e(12), rel=0.01)
    assert noise.mean() == pytest.approx(0, abs=read_noise_e(12) * 0.02)
    assert read_noise_e(255) == FULL_WELL_E


def test_shot_noise_has_the_variance_of_its_mean() -> None:
    result = outputs(noise_sigma=0, exposure=-1)
    mean = result["exposure"]
    normalised = (result["shot noise"] - mean) / np.sqrt(np.maximum(mean, 1))
    assert normalised[mean > 50].var() == pytest.approx(1, abs=0.02)


def test_taking_it_again_changes_only_the_noise() -> None:
    first, second = outputs(new_noise=0), outputs(new_noise=1)
    assert np.array_equal(first["exposure"], second["exposure"])
    assert np.corrcoef(
        (first["shot noise"] - first["exposure"]).ravel(),
        (second["shot noise"] - second["exposure"]).ravel(),
    )[0, 1] == pytest.approx(0, abs=0.02)


def test_one_stop_more_doubles_the_light_where_nothing_is_clipped() -> None:
    quiet: Setting = {"noise_sigma": 0, "shot_noise": False}
    dim, bright = (pixels_of(shown(exposure=stops, **quiet)) for stops in (-2, -1))
    mid = (dim[..., :3] > 60) & (bright[..., :3] < 240)
    ratio = decode_srgb(bright[..., :3] / 255.0)[mid] / decode_srgb(dim[..., :3] / 255.0)[mid]
    assert np.median(ratio) == pytest.approx(2, rel=0.01)


readouts = partial(texts_at, SCENE)


def test_the_automatic_makes_good_what_focus_and_aperture_take_away() -> None:
    """Light on the axis goes as the solid angle of the opening seen from the sensor."""
    for focal_length, aperture, focus in ((50, 8, 10.0), (135, 8, 1.0), (135, 2, 1.0)):
        sensor_mm = 1 / (1 / focal_length - 1 / (1000 * focus))
        gathered = (focal_length / aperture / sensor_mm) ** 2
        assert shutter_s(focal_length, aperture, focus, 0.0) * gathered == pytest.approx(
            shutter_s(50, 8, math.inf, 0.0) / 8**2
        )
    assert readouts(focal_length=135, focus=1)["shutter"] != readouts(focal_length=135)["shutter"]


def test_the_byte_of_each_code_is_that_of_its_light() -> None:
    linear = (np.arange(4096) - ADC.black_level_dn) / (4095 - ADC.black_level_dn)
    exact = 255 * encode_srgb(np.clip(linear, 0, 1))
    np.testing.assert_array_equal(BYTE_OF_CODE, np.rint(exact))
    assert BYTE_OF_CODE[[0, 512, 4095]].tolist() == [0, 0, 255]


def test_more_than_a_full_well_is_white_and_less_than_nothing_black() -> None:
    electrons = np.array([-1e4, 0.0, FULL_WELL_E, 1e6], np.float32).reshape(1, 2, 2)
    electrons = np.repeat(electrons, 3, axis=0)
    picture = encode(quantise(electrons))
    assert picture[..., 0].ravel().tolist() == [0, 0, 255, 255]
    assert (picture[..., 3] == 255).all()
