"""The Poisson distribution against scipy's, and the distance of samples from it."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from simulations.models.sensor.poisson import (
    gap_from_poisson,
    largest_chance_gap,
    poisson_cumulative,
)


@given(st.floats(1e-3, 1e6))
def test_the_cumulative_is_scipys(mean: float) -> None:
    first, cumulative = poisson_cumulative(mean)
    counts = first + np.arange(cumulative.size)
    # scipy's own error grows with the mean, as does that of a sum of so many ratios.
    np.testing.assert_allclose(
        cumulative, stats.poisson.cdf(counts, mean), atol=1e-15 * (10 + math.sqrt(mean))
    )


@given(st.floats(0, 1e8))
def test_nothing_worth_counting_lies_beyond_either_end(mean: float) -> None:
    first, cumulative = poisson_cumulative(mean)
    assert stats.poisson.cdf(first - 1, mean) < 1e-20
    assert stats.poisson.sf(first + cumulative.size - 1, mean) < 1e-20
    assert cumulative[-1] == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize(("mean", "size"), [(0, 1), (5e-324, 31), (1e-300, 31)])
def test_without_light_nothing_is_counted(mean: float, size: int) -> None:
    first, cumulative = poisson_cumulative(mean)
    assert (first, cumulative.size) == (0, size)
    assert (cumulative == 1).all()


def test_the_window_is_ten_standard_deviations_and_thirty_counts_each_way() -> None:
    first, cumulative = poisson_cumulative(10_000)
    assert (first, first + cumulative.size - 1) == (10_000 - 1030, 10_000 + 1030)


def test_the_largest_mean_is_still_answered() -> None:
    first, cumulative = poisson_cumulative(1e10)
    assert first + np.searchsorted(cumulative, 0.5) == pytest.approx(1e10, abs=1)


@pytest.mark.parametrize("mean", [-1.0, math.nan, math.inf, 1.1e10])
def test_a_mean_that_makes_no_sense_is_refused(mean: float) -> None:
    with pytest.raises(ValueError, match="legal: 0 to 1e10"):
        poisson_cumulative(mean)


@pytest.mark.parametrize("mean", [0.3, 7.0, 300.0])
def test_the_gap_is_the_kolmogorov_smirnov_distance(mean: float) -> None:
    counted = np.random.default_rng(1).poisson(1.1 * mean, 500)
    every = np.arange(counted.max() + 2)
    share = np.searchsorted(np.sort(counted), every, side="right") / counted.size
    expected = np.abs(share - stats.poisson.cdf(every, mean)).max()
    assert gap_from_poisson(counted.astype(np.float32), mean) == pytest.approx(expected, abs=1e-12)


def test_two_values_by_hand() -> None:
    """Half of the pixels count 0 and half 1, with one expected: e⁻¹ below and 2e⁻¹ up to 1."""
    gap = gap_from_poisson([0, 1, 1, 0], 1.0)
    assert gap == pytest.approx(1 - 2 / math.e)


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


def test_exact_samples_of_many_distributions_stay_about_the_chance_gap() -> None:
    rng = np.random.default_rng(3)
    gaps = [
        max(gap_from_poisson(rng.poisson(1000.0, 1600), 1000.0) for _ in range(24))
        for _ in range(20)
    ]
    assert np.median(gaps) == pytest.approx(largest_chance_gap(24, 1600), rel=0.15)


@pytest.mark.parametrize(("distributions", "samples"), [(0, 10), (10, 0)])
def test_no_samples_leave_no_chance(distributions: int, samples: int) -> None:
    with pytest.raises(ValueError, match="legal: 1 or more"):
        largest_chance_gap(distributions, samples)


@pytest.mark.parametrize("counts", [[], [1.0, np.nan]])
def test_counts_must_be_there_and_be_numbers(counts: list[float]) -> None:
    with pytest.raises(ValueError, match="legal: one number or more"):
        gap_from_poisson(counts, 3.0)
