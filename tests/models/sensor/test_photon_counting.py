"""Light counted, read out with noise and rounded to codes, against SciPy’s distributions."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy import stats

from simulations.models.arrays import Floats
from simulations.models.sensor.exposure import (
    mean_of_instants,
    mean_of_jittered_instants,
    mean_of_random_instants,
)
from simulations.models.sensor.photon_counting import (
    SHOT_MODELS,
    Sensor,
    ShotModel,
    develop,
    expose,
    quantise,
    read_out,
    shot_noise,
    shot_noise_from_normal,
    signal_to_noise,
    with_iso,
)
from simulations.models.sensor.poisson import (
    gap_from_poisson,
    largest_chance_gap,
    poisson_cumulative,
)
from simulations.models.sensor.poisson_quantile import FEW, normal_tail, poisson_from_normal


def rng() -> np.random.Generator:
    return np.random.default_rng(7)


def test_exposure_adds_photoelectrons_and_dark_current() -> None:
    sensor = Sensor(quantum_efficiency=0.5, dark_current_e_per_s=2.0)
    assert expose(100.0, 3.0, sensor) == pytest.approx(156)


def test_iso_divides_the_electrons_per_code() -> None:
    sensor = Sensor(gain_e_per_dn=6.0)
    assert with_iso(sensor, 400).gain_e_per_dn == 1.5
    assert with_iso(sensor, 400, 200).gain_e_per_dn == 3.0
    assert with_iso(sensor, 0.5).gain_e_per_dn == 1200.0


def test_read_out_divides_by_the_gain_and_adds_noise_and_black() -> None:
    sensor = Sensor(read_noise_e=4.0, gain_e_per_dn=2.0, black_level_dn=64.0)
    signal = read_out(np.full(200_000, 100.0), sensor, rng())
    assert signal.mean() == pytest.approx(114.0, abs=0.03)
    assert signal.std() == pytest.approx(2.0, rel=0.02)
    silent = Sensor(read_noise_e=0.0, gain_e_per_dn=2.0)
    np.testing.assert_array_equal(read_out([100.0, 0.0], silent, rng()), [114.0, 64.0])


def test_quantisation_rounds_to_the_nearest_code_and_clips() -> None:
    signal = [-np.inf, -5, np.nan, 2.4, 2.6, 6.7, 8.0, 1e9, np.inf]
    np.testing.assert_array_equal(quantise(signal, 3), [0, 0, 0, 2, 3, 7, 7, 7, 7])
    assert quantise(1e9, 16) == 65535
    assert Sensor(bits=1, black_level_dn=0).highest_dn == 1


def test_developing_inverts_gain_and_black_level() -> None:
    sensor = Sensor(bits=10, black_level_dn=23.0)
    np.testing.assert_allclose(develop([23.0, 523.0, 1023.0, 0.0], sensor), [0, 0.5, 1, -0.023])


def test_signal_to_noise_ratio_adds_all_variances() -> None:
    """The root of 400 + 3² + 6²/12 is √412."""
    sensor = Sensor(read_noise_e=3.0, gain_e_per_dn=6.0)
    assert signal_to_noise(400.0, sensor) == pytest.approx(400 / np.sqrt(412))
    assert signal_to_noise(1.0, Sensor(read_noise_e=1e15)) == pytest.approx(1e-15)
    bare = Sensor(read_noise_e=0, gain_e_per_dn=1e-6, black_level_dn=0)
    assert signal_to_noise(10_000, bare) == pytest.approx(100)


@pytest.mark.parametrize("model", SHOT_MODELS)
def test_electrons_lie_between_zero_and_the_full_well(model: ShotModel) -> None:
    electrons = shot_noise([0.0, 1e9, 1e300, np.inf], rng(), 1000.0, model)
    np.testing.assert_array_equal(electrons, [0, 1000, 1000, 1000])
    # Without a full well, the most that a sampler can draw.
    assert shot_noise([1e300, np.inf], rng(), model=model) == pytest.approx([1e13, 1e13], rel=1e-5)


@pytest.mark.parametrize("model", SHOT_MODELS)
@pytest.mark.parametrize("mean", [30.0, 400.0])
def test_every_model_of_shot_noise_has_the_mean_and_variance_of_poisson(
    model: ShotModel, mean: float
) -> None:
    counted = shot_noise(np.full(200_000, mean), rng(), model=model)
    assert np.array_equal(counted, np.rint(counted))
    assert counted.mean() == pytest.approx(mean, abs=5 * np.sqrt(mean / 200_000))
    assert counted.var() == pytest.approx(mean, rel=0.02)


def test_counts_from_given_normals_agree_with_the_same_draws() -> None:
    mean = np.linspace(0, 1500, 4000, dtype=np.float32)
    z = rng().standard_normal(mean.shape, np.float32)
    counted = shot_noise_from_normal(mean, z, 1000.0)
    np.testing.assert_array_equal(counted, shot_noise(mean, rng(), 1000.0, model="quantile"))
    assert counted[0] == 0
    assert counted.max() == 1000


def test_skewed_model_adds_the_second_cornish_fisher_term() -> None:
    """Cornish and Fisher: m + sqrt(m) z + (z^2 - 1) / 6, rounded."""
    z = rng().standard_normal(1000)
    expected = np.rint(100 + 10 * z + (z**2 - 1) / 6)
    drawn = shot_noise(np.full(1000, 100.0), rng(), model="skewed")
    np.testing.assert_array_equal(drawn, expected)


@pytest.mark.parametrize("mean", [0.0, *np.geomspace(1e-3, 1e6, 28)])
def test_cumulative_poisson_agrees_with_scipy_and_covers_all_counts(mean: float) -> None:
    first, cumulative = poisson_cumulative(mean)
    last = first + cumulative.size - 1
    counts = np.arange(first, last + 1)
    # scipy's own error grows with the mean, and so does the rounding of our sum.
    np.testing.assert_allclose(
        cumulative, stats.poisson.cdf(counts, mean), atol=1e-15 * (10 + math.sqrt(mean))
    )
    assert stats.poisson.cdf(first - 1, mean) < 1e-20
    assert stats.poisson.sf(last, mean) < 1e-20


@pytest.mark.parametrize("mean", [0.3, 7.0, 300.0])
def test_gap_from_poisson_is_the_kolmogorov_smirnov_distance(mean: float) -> None:
    counted = np.random.default_rng(1).poisson(1.1 * mean, 500)
    every = np.arange(counted.max() + 2)
    share = np.searchsorted(np.sort(counted), every, side="right") / counted.size
    expected = np.abs(share - stats.poisson.cdf(every, mean)).max()
    assert gap_from_poisson(counted.astype(np.float32), mean) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(("distributions", "samples"), [(1, 400), (24, 400), (24, 6400)])
def test_chance_gap_is_the_median_of_kolmogorovs_distribution(
    distributions: int, samples: int
) -> None:
    """Of the largest gap among several distributions."""
    median = stats.kstwobign.ppf(0.5 ** (1 / distributions)) / math.sqrt(samples)
    assert largest_chance_gap(distributions, samples) == pytest.approx(median, rel=0.01)


STEPS = 400_000
PROBABILITY = (np.arange(STEPS) + 0.5) / STEPS

EVEN = stats.norm.ppf(PROBABILITY)
"""Deviates that divide the normal into equal parts, which give a distribution, not a sample."""

MEANS = (1e-12, 1e-6, 1e-3, 0.05, 0.3, 1.0, 3.0, 9.999, 10.0, 30.0, 1e2, 1e3, 1e4, 1e5)


def counted(mean: float, z: Floats = EVEN) -> Floats:
    return poisson_from_normal(np.full(z.shape, mean, z.dtype), z)


def whole_numbers(mean: float) -> Floats:
    """All counts with a probability that matters."""
    reach = 9 * np.sqrt(mean) + 12
    return np.arange(max(0, int(mean - reach)), int(mean + reach), dtype=float)


@pytest.mark.parametrize("mean", MEANS)
def test_poisson_quantile_agrees_with_scipy_deviate_by_deviate(mean: float) -> None:
    k = whole_numbers(mean)  # the first whose probability is reached: 500 times as quick as `ppf`
    off = counted(mean) - k[np.searchsorted(stats.poisson.cdf(k, mean), PROBABILITY)]
    assert np.abs(off).max() <= 1
    assert np.mean(off != 0) < (1e-5 if mean < FEW else 0.003)


def test_normal_tail_agrees_with_scipy() -> None:
    z = np.linspace(-8, 8, 10_001)
    np.testing.assert_allclose(normal_tail(z), stats.norm.sf(z), rtol=1.3e-7)


def test_mean_of_instants_has_the_midpoint_rules_error() -> None:
    """∫t² dt = 1/3, and n midpoints fall short by 1/(12 n²)."""
    for count in (1, 3, 10):
        found = mean_of_instants(lambda time: np.array([time * time]), count)
        assert found[0] == pytest.approx(1 / 3 - 1 / (12 * count**2), abs=1e-15)


@pytest.mark.parametrize(
    ("mean", "shares"),
    [(mean_of_random_instants, 1), (mean_of_jittered_instants, 5)],
    ids=["random", "one in each share"],
)
def test_every_pixel_draws_its_own_times(mean: Callable[..., Floats], shares: int) -> None:
    requested: list[Floats] = []

    def record(times: Floats) -> Floats:
        requested.append(times)
        return times

    found = mean(record, 5, (40, 30), np.random.default_rng(3))
    times = np.array(requested)
    assert times.shape == (5, 40, 30)
    assert np.unique(times).size == times.size
    assert np.histogram(times, 10, (0, 1))[0] == pytest.approx(times.size / 10, rel=0.2)
    np.testing.assert_allclose(found, times.mean(axis=0))
    share = np.floor(shares * times)
    assert (share == np.arange(5)[:, None, None] * (shares > 1)).all()
