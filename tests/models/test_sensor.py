"""The sensor against the Poisson distribution and the laws of its noise."""

import numpy as np
import pytest
from scipy import stats

from simulations.models.sensor import (
    Sensor,
    capture,
    estimate_gain,
    expose,
    photon_transfer,
    quantise,
    shot_noise,
    signal_to_noise,
    with_iso,
)


def rng():
    return np.random.default_rng(7)


def ks_distance(samples, mean):
    """Largest gap between the samples' distribution and the Poisson's, at whole numbers."""
    codes = np.arange(0, samples.max() + 1)
    empirical = np.searchsorted(np.sort(samples), codes, side="right") / samples.size
    return np.abs(empirical - stats.poisson.cdf(codes, mean)).max()


@pytest.mark.parametrize("mean", [0.5, 4.0, 60.0])
def test_shot_noise_follows_the_poisson_distribution(mean):
    samples = shot_noise(np.full(50_000, mean), rng())
    assert ks_distance(samples, mean) < 1.63 / np.sqrt(50_000)  # the 1 % bound of the test


def test_the_skewed_normal_is_nearer_to_poisson_than_the_plain_one():
    gaps = {
        model: ks_distance(shot_noise(np.full(200_000, 9.0), rng(), model=model), 9.0)
        for model in ("gaussian", "skewed")
    }
    assert gaps["skewed"] < 0.5 * gaps["gaussian"]
    assert gaps["gaussian"] == pytest.approx(0.0665 / 3, rel=0.3)


def test_no_light_frees_no_electron_and_any_light_is_held_by_the_well():
    for model in ("poisson", "skewed", "gaussian"):
        held = shot_noise([0.0, 1e300, np.inf], rng(), 1000.0, model)
        np.testing.assert_array_equal(held, [0, 1000, 1000])


def test_gain_is_measured_within_one_percent():
    mean, variance = photon_transfer(np.linspace(500, 15_000, 20), Sensor(), rng())
    assert estimate_gain(mean, variance) == pytest.approx(5.0, rel=0.01)


def test_rounding_adds_one_twelfth_of_variance():
    signal = rng().uniform(100, 900, 200_000)
    assert np.var(quantise(signal, 10) - signal) == pytest.approx(1 / 12, rel=0.01)


def test_quantise_is_defined_for_everything():
    codes = quantise([-5, 0.4, 0.6, 1e9, np.nan, np.inf], 1)
    np.testing.assert_array_equal(codes, [0, 0, 1, 1, 0, 1])
    assert quantise(1e9, 16) == 65535


def test_exposure_counts_light_and_warmth():
    sensor = Sensor(quantum_efficiency=0.5, dark_current_e_per_s=2.0)
    assert expose(100.0, 3.0, sensor) == pytest.approx(156)


def test_signal_to_noise_of_shot_noise_is_the_root_of_the_electrons():
    bare = Sensor(read_noise_e=0, gain_e_per_dn=1e-6, black_level_dn=0)
    assert signal_to_noise(10_000, bare) == pytest.approx(100)
    assert signal_to_noise(0, Sensor()) == 0


def test_twice_the_iso_doubles_the_codes():
    sensor = Sensor(black_level_dn=0)
    light = np.full(20_000, 4000.0)
    single = capture(light, 1.0, sensor, rng()).mean()
    assert capture(light, 1.0, with_iso(sensor, 200), rng()).mean() == pytest.approx(
        2 * single, rel=0.01
    )


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: shot_noise([-1.0], rng()), "mean_e"),
        (lambda: shot_noise([np.nan], rng()), "mean_e"),
        (lambda: shot_noise([1.0], rng(), model="fast"), "fast"),
        (lambda: Sensor(bits=17), "bits"),
        (lambda: Sensor(bits=4), "black_level_dn"),
        (lambda: quantise(1.0, 0), "bits"),
        (lambda: expose(1.0, -1.0, Sensor()), "exposure_s"),
    ],
)
def test_meaningless_parameters_are_refused_by_name(call, message):
    with pytest.raises(ValueError, match=message):
        call()
