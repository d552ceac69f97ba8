"""The picture of the step wedge, what is drawn anew for it, and that of a reader's own light."""

from functools import partial

import numpy as np
import pytest
from support.frames import frame_of, outputs_of, pixels_of

from simulations.engine.frame import Frame
from simulations.engine.photograph import Photograph
from simulations.engine.stages import Outputs, StageCache
from simulations.models.color.srgb import encode_srgb
from simulations.models.sensor.photon_counting import develop
from simulations.models.sensor.poisson import largest_chance_gap
from simulations.scenes.sensor_noise.error import EXPOSURES
from simulations.scenes.sensor_noise.scene import SCENE
from simulations.scenes.sensor_noise.stages import (
    FULL_WELL_E,
    Transfer,
    sensor_of,
)

frame = partial(frame_of, SCENE)


def test_patches_of_the_picture_are_in_order_of_their_light() -> None:
    shown = pixels_of(frame(read_noise=0))[..., 0].astype(float)
    tiles = shown.reshape(4, 40, 6, 40).mean(axis=(1, 3)).ravel()
    assert (np.diff(tiles[2:]) < 0).all()
    assert tiles[0] == 255


def test_taking_it_again_draws_other_noise_of_the_same_light() -> None:
    first, second = pixels_of(frame()), pixels_of(frame(new_noise=1))
    assert not np.array_equal(first, second)
    assert np.array_equal(first, pixels_of(frame()))


@pytest.mark.parametrize("bits", [4, 12, 14])
def test_the_picture_is_the_codes_developed_and_encoded(bits: int) -> None:
    done = outputs_of(SCENE, bits=bits)
    linear = develop(done["codes"][0], sensor_of(bits, "100", 0))
    expected = np.rint(255 * encode_srgb(np.clip(linear, 0, 1)))
    shown = done["picture"][..., 0].reshape(4, 40, 6, 40).swapaxes(1, 2).reshape(24, 1600)
    np.testing.assert_array_equal(shown, expected)


def ramp() -> Photograph:
    """A picture with detail of its own in every patch: a slant ramp over fine stripes."""
    y, x = np.mgrid[:160, :240]
    levels = np.clip(20 + 0.4 * x + 0.3 * y + 25 * (x % 4 < 2), 0, 255).astype(np.uint8)
    return Photograph(1, np.stack([levels, levels, levels], axis=-1))


def of_own(**given: object) -> tuple[Outputs, Frame]:
    settings, cache = SCENE.check(given), StageCache()
    done = SCENE.run(settings, "quantile", cache, ramp())
    return done.outputs, SCENE.render(settings, "quantile", cache, ramp())


def test_the_light_of_a_reader_s_picture_fills_the_well_where_it_is_white() -> None:
    done, _ = of_own(exposure=-1)
    codes = ramp().codes[..., 0] / 255
    linear = np.where(codes <= 0.04045, codes / 12.92, ((codes + 0.055) / 1.055) ** 2.4)
    tile = linear[40:80, 80:120].ravel()
    assert done["light"][8] == pytest.approx(FULL_WELL_E / 2 * tile, rel=1e-3)


@pytest.mark.parametrize("iso", ["100", "1600"])
def test_a_reader_s_picture_tells_the_gain_although_it_has_detail_of_its_own(iso: str) -> None:
    done, shown = of_own(exposure=-4 if iso == "1600" else 0, iso=iso)
    measured: Transfer = done["transfer"]
    assert measured.gain is not None
    truth = sensor_of(12, iso, 10).gain_e_per_dn
    assert abs(measured.gain.e_per_dn / truth - 1) < 0.15
    assert shown.description.startswith(f"Your own picture at ISO {iso}")
    assert "wedge" not in shown.description
    assert {place.name for place in shown.handles} == {"patch"}


def test_a_reader_s_picture_is_judged_by_even_patches_as_bright() -> None:
    told = list(SCENE.estimates(SCENE.check({}), "quantile", StageCache(), ramp()))
    assert len(told) == EXPOSURES
    assert float(told[-1].text) < 1.6 * largest_chance_gap(24, 1600 * EXPOSURES)


@pytest.mark.parametrize("patch", [1, 9, 24])
def test_the_enlarged_patch_is_as_bright_whatever_its_light(patch: int) -> None:
    enlarged = pixels_of(frame(iso="400", exposure=-2, patch=patch, read_noise=3), 1)
    levels = enlarged[..., 0] / 255
    linear = np.where(levels <= 0.04045, levels / 12.92, ((levels + 0.055) / 1.055) ** 2.4)
    assert linear.mean() == pytest.approx(0.2, abs=0.02)


def test_the_light_of_the_patch_is_led_along_the_axis_by_the_exposure() -> None:
    given = {"iso": "3200", "exposure": -5, "patch": 13}
    (level,) = (place for place in frame(**given).handles if place.name == "level")
    assert SCENE.pull(SCENE.check(given), "level", (level.x, level.y)) == {"exposure": -5}
    (brighter,) = (p for p in frame(**{**given, "exposure": -3}).handles if p.name == "level")
    assert SCENE.pull(SCENE.check(given), "level", (brighter.x, level.y)) == {"exposure": -3}
