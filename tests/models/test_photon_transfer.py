"""The curve that measures a sensor's gain, and the fit to it."""

import numpy as np
import pytest

from simulations.models.sensor import Sensor, estimate_gain, expose, photon_transfer, with_iso


def rng():
    return np.random.default_rng(7)


def test_gain_is_measured_within_one_percent():
    mean, variance = photon_transfer(np.linspace(500, 15_000, 20), Sensor(), rng())
    assert estimate_gain(mean, variance) == pytest.approx(5.0, rel=0.01)


def test_the_photon_transfer_curve_has_the_variances_of_its_sources():
    sensor = Sensor(read_noise_e=10.0, gain_e_per_dn=2.0, full_well_e=1e6, black_level_dn=50)
    levels = np.array([0.0, 100.0, 4000.0])
    mean, variance = photon_transfer(levels, sensor, rng(), samples=100_000)
    np.testing.assert_allclose(mean, levels / 2, atol=0.2)
    np.testing.assert_allclose(variance, (levels + 100) / 4 + 1 / 12, rtol=0.02)
    assert photon_transfer(5.0, sensor, rng(), samples=2)[0].shape == (1,)
    with pytest.raises(ValueError, match="samples"):
        photon_transfer(levels, sensor, rng(), samples=1)


def test_the_gain_is_one_over_the_slope_whatever_the_offset():
    mean = np.array([10.0, 20.0, 50.0])
    assert estimate_gain(mean, 3.0 + mean / 4) == pytest.approx(4.0)
    assert estimate_gain(mean[:2], mean[:2]) == pytest.approx(1.0)
    for levels in ([5.0], [5.0, 5.0]):
        with pytest.raises(ValueError, match="levels"):
            estimate_gain(levels, levels)


def test_a_fit_trusts_small_variances_more():
    """Weights of one over the variance of each point: the residuals' weighted sums vanish."""
    mean, variance = np.array([10.0, 20.0, 40.0, 80.0]), np.array([3.0, 4.0, 11.0, 19.0])
    slope = 1 / estimate_gain(mean, variance)
    weight = variance**-2
    centre_x, centre_y = np.average(mean, weights=weight), np.average(variance, weights=weight)
    expected = (weight * (mean - centre_x) * (variance - centre_y)).sum() / (
        weight * (mean - centre_x) ** 2
    ).sum()
    assert slope == pytest.approx(expected)


def test_both_exposures_of_a_transfer_curve_count():
    """The mean of two fields of two samples has a quarter of the variance of one sample."""
    sensor = Sensor(read_noise_e=0.0, gain_e_per_dn=1.0, bits=16, full_well_e=1e5)
    mean, variance = photon_transfer(np.full(20_000, 400.0), sensor, rng(), samples=2)
    assert mean.var() == pytest.approx(400 / 4, rel=0.05)
    assert variance.mean() == pytest.approx(400, rel=0.05)


def test_what_is_asked_of_a_sensor_is_refused_by_name():
    with pytest.raises(ValueError, match=r"^iso 0; legal: above 0$"):
        with_iso(Sensor(), 0)
    with pytest.raises(ValueError, match=r"^exposure_s inf; legal: "):
        expose(1.0, np.inf, Sensor())
    with pytest.raises(ValueError, match=r"^samples 1; legal: 2 or more$"):
        photon_transfer([1.0], Sensor(), rng(), samples=1)


def test_a_transfer_curve_has_twenty_thousand_samples_a_level_unless_told_otherwise():
    levels = [50.0, 400.0]
    usual, stated = (
        photon_transfer(levels, Sensor(), rng()),
        photon_transfer(levels, Sensor(), rng(), 20_000),
    )
    np.testing.assert_array_equal(usual, stated)


@pytest.mark.parametrize(
    ("mean", "variance", "message"),
    [
        ([1.0, 2.0], [3.0, 3.0], "variance of 3 to 3 does not rise with the mean"),
        ([1.0, 2.0], [3.0, 2.0], "variance of 2 to 3 does not rise with the mean"),
        ([1.0, 2.0], [-3.0, -3.0 + 2e-9], "variance of -3 to -3 does not rise with the mean"),
        ([0.0, 1.0, 2.0], [1e-3, 1e3, 1e-3 + 1e-8], "does not rise with the mean"),
        ([1.0, np.nan], [1.0, 2.0], "not finite"),
        ([1.0, 2.0], [1.0, np.inf], "not finite"),
        ([1.0, 2.0, 3.0], [1.0, 2.0], r"both \(N,\)"),
        ([[1.0, 2.0]], [[1.0, 2.0]], r"both \(N,\)"),
    ],
)
def test_a_curve_without_shot_noise_has_no_gain(mean, variance, message):
    with pytest.raises(ValueError, match=message):
        estimate_gain(mean, variance)


def test_a_variance_rises_if_it_does_so_by_a_billionth_of_itself():
    mean = np.array([1.0, 11.0])
    assert estimate_gain(mean, [3.0, 3.0 + 3.1e-9]) == pytest.approx(10 / 3.1e-9, rel=1e-5)
    with pytest.raises(ValueError, match="does not rise"):
        estimate_gain(mean, [3.0, 3.0 + 2.9e-9])
