"""One count from each normal deviate, at every mean: SciPy's Poisson quantiles are the oracle."""

import numpy as np
import pytest
from scipy import stats

from simulations.models.arrays import Floats
from simulations.models.sensor.photon_counting import (
    shot_noise_from_normal,
)
from simulations.models.sensor.poisson_quantile import FEW, normal_tail, poisson_from_normal

STEPS = 400_000
PROBABILITY = (np.arange(STEPS) + 0.5) / STEPS
EVEN = stats.norm.ppf(PROBABILITY)
"""Deviates that cut the normal into equal parts: what they give is a distribution, not a sample."""
MEANS = (1e-12, 1e-6, 1e-3, 0.05, 0.3, 1.0, 3.0, 9.999, 10.0, 30.0, 1e2, 1e3, 1e4, 1e5)


def counted(mean: float, z: Floats = EVEN) -> Floats:
    return poisson_from_normal(np.full(z.shape, mean, z.dtype), z)


def whole_numbers(mean: float) -> Floats:
    """All that can matter."""
    reach = 9 * np.sqrt(mean) + 12
    return np.arange(max(0, int(mean - reach)), int(mean + reach), dtype=float)


@pytest.mark.parametrize("mean", MEANS)
def test_it_is_scipy_s_quantile_deviate_by_deviate(mean: float) -> None:
    k = whole_numbers(mean)  # the first whose probability is reached: 500 times as quick as `ppf`
    off = counted(mean) - k[np.searchsorted(stats.poisson.cdf(k, mean), PROBABILITY)]
    assert np.abs(off).max() <= 1
    assert np.mean(off != 0) < (1e-5 if mean < FEW else 0.003)


def test_an_electron_in_a_billion_is_drawn_where_it_is_due() -> None:
    """Far out on the tail, where probabilities near 1 have no digits left."""
    mean = np.array([1e-12, 1e-9, 1e-6, 1e-3])
    due = stats.norm.isf(-np.expm1(-mean))
    assert poisson_from_normal(mean, due - 1e-3).tolist() == [0, 0, 0, 0]
    assert poisson_from_normal(mean, due + 1e-3).tolist() == [1, 1, 1, 1]


def test_more_light_never_takes_electrons_away_and_nothing_jumps() -> None:
    """The same deviates in light that rises through the border between sums and expansion."""
    z = np.linspace(-5, 5, 2001)
    means = np.linspace(0.9 * FEW, 1.1 * FEW, 101)
    path = poisson_from_normal(means[:, None], z[None])
    steps = np.diff(path, axis=0)
    assert set(np.unique(steps)) <= {-1.0, 0.0, 1.0}
    # Only at the border itself, and there for few, a count may fall.
    falls = np.flatnonzero((steps < 0).any(axis=1))
    assert all(means[at] < FEW <= means[at + 1] for at in falls)
    border = poisson_from_normal(np.array([[np.nextafter(FEW, 0)], [FEW]]), EVEN[None])
    assert np.mean(border[0] != border[1]) < 0.003
    assert np.mean(border[0] > border[1]) == pytest.approx(1 / 800, rel=0.1)


@pytest.mark.parametrize("mean", [0.0, 0.5, 1e4])
def test_deviates_out_of_all_proportion_give_whole_numbers_of_zero_or_more(mean: float) -> None:
    counts = counted(mean, np.array([-1e3, -40.0, 40.0]))
    assert np.isfinite(counts).all()
    assert (counts >= 0).all()
    assert (counts == np.rint(counts)).all()
    assert counts[0] == 0 or mean > 0


def test_float32_counts_as_float64_does() -> None:
    mean = np.geomspace(1e-3, 3e4, 50_000)
    z = np.random.default_rng(5).standard_normal(mean.size).astype(np.float32)
    single = poisson_from_normal(mean.astype(np.float32), z)
    double = poisson_from_normal(mean, z.astype(float))
    assert single.dtype == np.float32
    assert np.abs(single - double).max() <= 1
    assert np.mean(single != double) < 0.002


def test_the_tail_of_the_normal_is_scipy_s() -> None:
    z = np.linspace(-8, 8, 10_001)
    np.testing.assert_allclose(normal_tail(z), stats.norm.sf(z), rtol=1.3e-7)


def test_a_well_holds_what_is_counted_and_no_more() -> None:
    z = np.array([0.0, 3.0, 3.0])
    held = shot_noise_from_normal([5.0, 5.0, 1e9], z, 8.0)
    assert held.tolist() == [stats.poisson.ppf(0.5, 5.0), 8.0, 8.0]
