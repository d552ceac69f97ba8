"""Bell curves for photon counts miss by what their own distributions say."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy import stats
from support.ladder_run import LadderRun

from simulations.ladders.shot_noise import (
    LADDER,
    LEVELS_E,
    SAMPLES,
    distances,
    worst_bias_percent,
    worst_distance,
)

RUN = LadderRun(LADDER)
SAMPLING = 1.63 / np.sqrt(SAMPLES)
"""What 99 of 100 samples of the right distribution stay below (Kolmogorov)."""


@cache
def worst() -> dict[str, float]:
    return RUN.measured(worst_distance)


def rounded_normal_cumulative(mean: float) -> np.ndarray:
    k = np.arange(RUN.truth.shape[1])
    below: np.ndarray = stats.norm.cdf(k + 0.5, loc=mean, scale=np.sqrt(mean))
    return below


@pytest.mark.parametrize(("row", "mean"), list(enumerate(LEVELS_E)))
def test_the_reference_is_scipys_poisson(row: int, mean: float) -> None:
    oracle = stats.poisson.cdf(np.arange(RUN.truth.shape[1]), mean)
    np.testing.assert_allclose(RUN.truth[row], oracle, atol=1e-14)


@pytest.mark.parametrize("tier", ["quantile", "poisson"])
def test_exact_counts_and_quantiles_are_no_farther_off_than_samples_must_be(tier: str) -> None:
    assert np.all(distances(RUN.results[tier], RUN.truth) < SAMPLING)


def test_the_workload_holds_light_below_one_electron_and_light_where_all_tiers_agree() -> None:
    assert LEVELS_E[0] == 0.1
    brightest = {name: distances(counted, RUN.truth)[-1] for name, counted in RUN.results.items()}
    assert all(distance < SAMPLING for distance in brightest.values())


@pytest.mark.parametrize(("row", "mean"), list(enumerate(LEVELS_E)))
def test_the_rounded_gaussian_is_as_far_off_as_its_own_distribution(row: int, mean: float) -> None:
    theory = np.abs(rounded_normal_cumulative(mean) - RUN.truth[row]).max()
    measured = distances(RUN.results["gaussian"], RUN.truth)[row]
    assert measured == pytest.approx(theory, abs=SAMPLING)


def test_the_gaussians_distance_falls_with_the_root_of_the_light() -> None:
    many = np.array([10.0, 40.0])
    k = np.arange(200)
    gaps = [
        np.abs(stats.norm.cdf(k + 0.5, mean, np.sqrt(mean)) - stats.poisson.cdf(k, mean)).max()
        for mean in many
    ]
    np.testing.assert_allclose(gaps * np.sqrt(many), 0.0665, rtol=0.05)
    row = LEVELS_E.index(10.0)
    measured = distances(RUN.results["gaussian"], RUN.truth)[row]
    assert measured == pytest.approx(0.0665 / np.sqrt(10.0), abs=SAMPLING)


def test_cutting_the_gaussian_at_zero_brightens_one_electron_by_seven_percent() -> None:
    above = 1.0 - rounded_normal_cumulative(1.0)
    theory = 100.0 * (above.sum() - 1.0)
    assert theory == pytest.approx(7.0, abs=0.5)
    measured = RUN.results["gaussian"][LEVELS_E.index(1.0)].mean(dtype=float)
    assert 100 * (measured - 1) == pytest.approx(theory, abs=1.2)


def test_the_lean_invents_light_where_there_is_least() -> None:
    """At 0.1 electrons 45 % too many, by the normal's own probabilities."""
    z = np.linspace(-9, 9, 2_000_001)
    held = np.clip(np.rint(0.1 + np.sqrt(0.1) * z + (z * z - 1) / 6), 0, None)
    theory = 100 * (np.trapezoid(held * stats.norm.pdf(z), z) / 0.1 - 1)
    assert theory == pytest.approx(45, abs=1)
    chance = 100 * 4 * np.sqrt(0.15 / SAMPLES) / 0.1
    measured = worst_bias_percent(RUN.results["skewed"], RUN.truth, RUN.work)
    assert measured == pytest.approx(theory, abs=chance)
    for tier in ("quantile", "poisson"):
        assert worst_bias_percent(RUN.results[tier], RUN.truth, RUN.work) < 400 / np.sqrt(
            0.1 * SAMPLES
        )


def test_skew_correction_takes_out_most_of_the_distance_from_one_electron_on() -> None:
    from_one = slice(LEVELS_E.index(1.0), LEVELS_E.index(30.0))
    plain, leaning = (
        distances(RUN.results[t], RUN.truth)[from_one] for t in ("gaussian", "skewed")
    )
    assert np.all(leaning < plain / 4)
    assert worst()["gaussian"] > 2 * worst()["skewed"] > 10 * worst()["poisson"]


def test_the_distance_of_counts_one_too_high_is_the_largest_probability() -> None:
    shifted = distances(RUN.results["poisson"] + 1, RUN.truth)
    largest = [stats.poisson.pmf(int(mean), mean) for mean in LEVELS_E]
    np.testing.assert_allclose(shifted, largest, atol=SAMPLING)


def test_the_metrics_notice_two_percent_more_light() -> None:
    brighter = LADDER.tier("poisson").run(
        replace(RUN.work, mean_e=RUN.work.mean_e * np.float32(1.02))
    )
    assert worst_distance(brighter, RUN.truth, RUN.work) > 2 * SAMPLING
    assert worst_bias_percent(brighter, RUN.truth, RUN.work) > 1.5
