"""The Poisson distribution against scipy's, and the distance of samples from it."""

import math

import numpy as np
import pytest
from scipy import stats

from simulations.models.sensor.poisson import (
    gap_from_poisson,
    largest_chance_gap,
    poisson_cumulative,
)


@pytest.mark.parametrize("mean", [0.0, *np.geomspace(1e-3, 1e6, 28)])
def test_the_cumulative_is_scipys_and_nothing_worth_counting_lies_beyond(mean: float) -> None:
    first, cumulative = poisson_cumulative(mean)
    last = first + cumulative.size - 1
    counts = np.arange(first, last + 1)
    # scipy's own error grows with the mean, as does that of a sum of so many ratios.
    np.testing.assert_allclose(
        cumulative, stats.poisson.cdf(counts, mean), atol=1e-15 * (10 + math.sqrt(mean))
    )
    assert stats.poisson.cdf(first - 1, mean) < 1e-20
    assert stats.poisson.sf(last, mean) < 1e-20


@pytest.mark.parametrize(("mean", "size"), [(0, 1), (5e-324, 31), (1e-300, 31)])
def test_without_light_nothing_is_counted(mean: float, size: int) -> None:
    first, cumulative = poisson_cumulative(mean)
    assert (first, cumulative.size) == (0, size)
    assert (cumulative == 1).all()


def test_the_window_is_ten_standard_deviations_and_thirty_counts_each_way() -> None:
    first, cumulative = poisson_cumulative(10_000)
    assert (first, first + cumulative.size - 1) == (10_000 - 1030, 10_000 + 1030)


@pytest.mark.parametrize("mean", [0.3, 7.0, 300.0])
def test_the_gap_is_the_kolmogorov_smirnov_distance(mean: float) -> None:
    counted = np.random.default_rng(1).poisson(1.1 * mean, 500)
    every = np.arange(counted.max() + 2)
    share = np.searchsorted(np.sort(counted), every, side="right") / counted.size
    expected = np.abs(share - stats.poisson.cdf(every, mean)).max()
    assert gap_from_poisson(counted.astype(np.float32), mean) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("off", [-1e6, 1e6])
def test_counts_beyond_all_reason_are_wholly_apart(off: float) -> None:
    assert gap_from_poisson(np.full(10, 1e7 + off), 1e7) == pytest.approx(1, abs=1e-12)


def test_a_full_well_holds_all_that_would_be_more() -> None:
    spilt = np.minimum(np.random.default_rng(2).poisson(100.0, 40_000), 100)
    assert gap_from_poisson(spilt, 100.0, full_well=100) < 0.01
    # Without the well those at 100 would be all of the upper half.
    above = 1 - stats.poisson.cdf(100, 100.0)
    assert gap_from_poisson(spilt, 100.0) == pytest.approx(above, abs=0.01)


def test_a_well_that_always_overflows_leaves_no_gap() -> None:
    assert gap_from_poisson(np.full(7, 50.0), 1000.0, full_well=50) == 0


@pytest.mark.parametrize(("distributions", "samples"), [(1, 400), (24, 400), (24, 6400)])
def test_half_of_all_tries_exceed_the_chance_gap(distributions: int, samples: int) -> None:
    """Kolmogorov's own distribution, from scipy: the median of the largest of several."""
    median = stats.kstwobign.ppf(0.5 ** (1 / distributions)) / math.sqrt(samples)
    assert largest_chance_gap(distributions, samples) == pytest.approx(median, rel=0.01)
