"""The step wedge obeys the noise theory that the chapter states, and measures its own gain."""

import itertools
import math
from functools import partial

import numpy as np
import pytest
from support.frames import outputs_of, texts_at

from simulations.scenes.sensor_noise.scene import SCENE
from simulations.scenes.sensor_noise.stages import (
    FULL_WELL_E,
    Transfer,
    patch_means_e,
    sensor_of,
)

texts = partial(texts_at, SCENE)


def transfer(**given: object) -> Transfer:
    measured: Transfer = outputs_of(SCENE, "poisson", **given)["transfer"]
    return measured


def test_neighbouring_patches_are_half_a_stop_apart() -> None:
    means = patch_means_e(0)
    assert means[::2] == pytest.approx(40_000 / 2.0 ** np.arange(12))
    assert patch_means_e(-1) == pytest.approx(means / 2)


@pytest.mark.parametrize(("iso", "bits"), [("100", 12), ("800", 12), ("100", 14), ("400", 10)])
def test_the_slope_of_the_transfer_curve_is_the_gain(iso: str, bits: int) -> None:
    """1600 pixels know a variance to 3.5 %; a line through a dozen patches to about 2 %."""
    truth = sensor_of(bits, iso, 10).gain_e_per_dn
    gain = transfer(iso=iso, bits=bits).gain
    assert gain is not None
    assert gain.e_per_dn == pytest.approx(truth, rel=0.06)


@pytest.mark.parametrize("unequal", [1, 5])
def test_two_frames_measure_the_gain_of_unequal_cells_and_one_frame_does_not(
    unequal: float,
) -> None:
    truth = sensor_of(12, "100", 10).gain_e_per_dn
    even, measured = transfer(), transfer(unequal=unequal)
    assert measured.gain is not None
    assert measured.gain.e_per_dn == pytest.approx(truth, rel=0.06)
    inside = measured.fitted & even.fitted
    pattern = (unequal / 100 * measured.mean_dn[inside]) ** 2
    np.testing.assert_allclose(
        measured.one_frame_dn2[inside] - measured.variance_dn[inside],
        pattern,
        rtol=0.1,
        atol=4 * math.sqrt(2 / 1600) * measured.one_frame_dn2[inside].max(),
    )


def test_the_pattern_of_the_cells_stays_from_take_to_take() -> None:
    """The takes of one patch are correlated by as much of their variance as the pattern makes."""
    takes = [outputs_of(SCENE, "poisson", unequal=5, new_noise=n)["codes"][0, 4] for n in (0, 1)]
    shared = (0.05 * patch_means_e(0)[4]) ** 2
    expected = shared / (shared + patch_means_e(0)[4])
    assert np.corrcoef(*takes)[0, 1] == pytest.approx(expected, abs=0.05)


def test_patch_variances_are_shot_plus_read_plus_rounding() -> None:
    measured = transfer(bits=14, read_noise=20)
    gain = sensor_of(14, "100", 20).gain_e_per_dn
    expected = (patch_means_e(0) + 20**2) / gain**2 + 1 / 12
    inside = ~measured.clipped
    assert np.count_nonzero(inside) > 18
    # Four standard deviations of a variance from 1600 samples.
    assert measured.one_frame_dn2[inside] == pytest.approx(
        expected[inside], rel=4 * math.sqrt(2 / 1600)
    )
    assert measured.variance_dn[inside] == pytest.approx(
        expected[inside], rel=4 * math.sqrt(2 / 1600)
    )


def test_dark_signal_leaves_the_means_and_lifts_the_variances() -> None:
    without, with_dark = transfer(bits=14), transfer(bits=14, dark=2000)
    gain = sensor_of(14, "100", 10).gain_e_per_dn
    dim = slice(12, 24)
    assert with_dark.mean_dn[dim] == pytest.approx(without.mean_dn[dim], abs=5 / gain)
    lift = (with_dark.variance_dn - without.variance_dn)[dim].mean() * gain**2
    assert lift == pytest.approx(2000, rel=0.04)


def test_raising_the_iso_leaves_the_signal_to_noise_ratio() -> None:
    base, high = (float(texts(iso=iso, patch=13)["snr"]) for iso in ("100", "800"))
    assert base == pytest.approx(23.2, rel=0.08)
    assert high == pytest.approx(23.2, rel=0.08)


def test_saturated_patches_are_left_out_of_the_fit() -> None:
    measured = transfer()
    assert measured.clipped[:3].all()
    assert not measured.fitted[:3].any()


@pytest.mark.parametrize("iso", ["100", "800", "6400"])
@pytest.mark.parametrize("bits", [4, 6, 8, 10, 12, 14])
def test_a_gain_is_told_to_within_a_few_of_its_standard_errors_or_not_at_all(
    iso: str, bits: int
) -> None:
    """Coarse codes, hot sensors and full wells once gave gains up to twice the truth, or none."""
    for exposure, dark, read_noise in itertools.product((0, -3, -6), (0, 2000), (0, 10, 60)):
        given = {"iso": iso, "bits": bits, "exposure": exposure}
        measured = transfer(**given, dark=dark, read_noise=read_noise)
        if measured.gain is None:
            continue
        off = measured.gain.e_per_dn - sensor_of(bits, iso, read_noise).gain_e_per_dn
        assert abs(off) < 3.5 * measured.gain.error_e_per_dn, (given, dark, read_noise)
        assert measured.gain.error_e_per_dn < 0.1 * measured.gain.e_per_dn


def test_a_well_that_heat_has_filled_is_left_out_of_the_fit_although_no_code_is_the_last() -> None:
    """The light of a full cell stops 2000 electrons below the top code, nearly without noise."""
    hot = transfer(dark=2000)
    assert not hot.clipped[3]
    full = np.flatnonzero(patch_means_e(0) + 2000 > FULL_WELL_E)
    assert not hot.fitted[full].any()
