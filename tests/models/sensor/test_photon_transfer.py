"""The curve that measures a sensor's gain, and the fit to it."""

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.sensor.photon_counting import Sensor
from simulations.models.sensor.photon_transfer import estimate_gain, photon_transfer, straight_part


def rng() -> np.random.Generator:
    return np.random.default_rng(7)


LEVELS = {
    "even": np.linspace(500, 15_000, 20),
    "by ratio": np.geomspace(10, 15_000, 20),
    "dim": np.linspace(100, 2000, 10),
    "up to the well": np.linspace(500, 20_000, 20),
    "at the well's edge": np.linspace(15_000, 20_000, 20),
    "one at the edge": np.array([500.0, 2000.0, 19_900.0]),
    "two": np.array([2000.0, 13_000.0]),
    "close together": np.array([5000.0, 5050.0, 9000.0]),
}


@pytest.mark.parametrize("levels", LEVELS.values(), ids=LEVELS)
@pytest.mark.parametrize("gain", [0.5, 5.0, 20.0, 50.0, 120.0, 400.0])
def test_a_gain_is_within_a_few_standard_errors_of_the_truth_or_refused(
    gain: float, levels: Floats
) -> None:
    """No layout of the levels and no coarseness of the codes gives a wrong gain in silence."""
    sensor, told = Sensor(gain_e_per_dn=gain, bits=16), []
    for seed in range(6):
        curve = photon_transfer(levels, sensor, np.random.default_rng(seed), samples=5000)
        try:
            found = estimate_gain(*curve, samples=5000)
        except ValueError:
            continue
        told.append((found.e_per_dn - gain) / found.error_e_per_dn)
        assert found.error_e_per_dn < 0.1 * found.e_per_dn
    assert np.all(np.abs(told) < 4)
    if levels is LEVELS["even"] and gain <= 50:
        assert len(told) == 6
    if levels is LEVELS["at the well's edge"] or gain == 400:
        assert not told


@pytest.mark.parametrize("gain", [0.31, 0.62, 1.24, 2.48])
def test_few_electrons_on_few_codes_do_not_bend_the_gain(gain: float) -> None:
    """Nothing but shot noise spreads them, and whole electrons meet whole codes."""
    sensor = Sensor(read_noise_e=0.0, gain_e_per_dn=gain, bits=14, black_level_dn=256.0)
    levels = np.geomspace(0.2, 600, 24)
    told = []
    for seed in range(12):
        curve = photon_transfer(levels, sensor, np.random.default_rng(seed), samples=1600)
        found = estimate_gain(*curve, samples=1600)
        told.append((found.e_per_dn - gain) / found.error_e_per_dn)
    assert abs(np.mean(told)) < 1.0  # the standard error of this mean is 0.3
    assert levels[straight_part(*curve)].min() > 9.0


def test_levels_on_the_straight_part_are_those_of_the_standard() -> None:
    mean = np.array([1.0, 10.0, 50.0, 70.0, 71.0, 100.0, 110.0])
    variance = np.array([0.4, 0.6, 3.0, 4.0, 4.1, 6.0, 1.0])
    assert straight_part(mean, variance).tolist() == [0, 1, 1, 1, 0, 0, 0]
    assert straight_part([], []).tolist() == []


def test_the_photon_transfer_curve_has_the_variances_of_its_sources() -> None:
    sensor = Sensor(read_noise_e=10.0, gain_e_per_dn=2.0, full_well_e=1e6, black_level_dn=50)
    levels = np.array([0.0, 100.0, 4000.0])
    mean, variance = photon_transfer(levels, sensor, rng(), samples=100_000)
    np.testing.assert_allclose(mean, levels / 2, atol=0.2)
    np.testing.assert_allclose(variance, (levels + 100) / 4 + 1 / 12, rtol=0.02)
    assert photon_transfer(5.0, sensor, rng(), samples=2)[0].shape == (1,)


def test_the_gain_is_one_over_the_slope_whatever_the_offset() -> None:
    mean = np.array([10.0, 20.0, 50.0])
    assert estimate_gain(mean, 3.0 + mean / 4).e_per_dn == pytest.approx(4.0)


def test_a_fit_trusts_small_variances_more() -> None:
    """Weights of one over the variance of each point: the residuals' weighted sums vanish."""
    mean, variance = np.array([10.0, 20.0, 40.0, 80.0]), np.array([3.0, 4.0, 11.0, 19.0])
    beyond = np.array([150.0]), np.array([40.0])
    found = estimate_gain(np.append(mean, beyond[0]), np.append(variance, beyond[1]))
    slope = 1 / found.e_per_dn
    weight = variance**-2
    centre_x, centre_y = np.average(mean, weights=weight), np.average(variance, weights=weight)
    expected = (weight * (mean - centre_x) * (variance - centre_y)).sum() / (
        weight * (mean - centre_x) ** 2
    ).sum()
    assert slope == pytest.approx(expected)
    moment = (weight * (mean - centre_x) ** 2).sum()
    assert found.error_e_per_dn * slope**2 == pytest.approx(np.sqrt(2 / 19_999 / moment))


def test_both_exposures_of_a_transfer_curve_count() -> None:
    """The mean of two fields of two samples has a quarter of the variance of one sample."""
    sensor = Sensor(read_noise_e=0.0, gain_e_per_dn=1.0, bits=16, full_well_e=1e5)
    mean, variance = photon_transfer(np.full(20_000, 400.0), sensor, rng(), samples=2)
    assert mean.var() == pytest.approx(400 / 4, rel=0.05)
    assert variance.mean() == pytest.approx(400, rel=0.05)


@pytest.mark.parametrize("scale", [40.0, 1e5, 1e150, 1e300])
def test_no_scale_of_the_mean_overflows(scale: float) -> None:
    """Warnings are errors here."""
    mean = scale * np.array([1.0, 2.0, 4.0, 7.0])
    found = estimate_gain(mean, [100.0, 200.0, 400.0, 700.0])
    assert found.e_per_dn == pytest.approx(scale / 100, rel=1e-12)
