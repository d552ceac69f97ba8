"""Averages of instants, against the exact integral over the exposure."""

from functools import cache

import numpy as np
import pytest

from simulations.engine.ladder import pareto_front
from simulations.ladders.exposure_blur import LADDER, prepare, reference, rms, worst
from simulations.pictures import moving_ball

WORK = prepare()
TRUTH = reference(WORK)
WALL = moving_ball.wall(WORK.x, WORK.y)
RMS = {tier.id: rms(tier.run(WORK), TRUTH, WORK) for tier in LADDER.tiers}


@cache
def brute_force(power: int = 1, count: int = 400) -> np.ndarray:
    """Mean over many instants of the picture, or of its square."""
    times = (np.arange(count) + 0.5) / count
    pictures = (moving_ball.instant(WORK.x, WORK.y, time, WALL) ** power for time in times)
    return np.asarray(sum(pictures) / count)


def test_the_reference_agrees_with_four_hundred_instants() -> None:
    """A pixel changes ten times at most, each time by 0.8 at most, and each costs 1/800."""
    assert worst(brute_force(), TRUTH, WORK) < 10 * 0.8 / 800
    assert rms(brute_force(), TRUTH, WORK) < 0.5 / 400


def test_where_the_ball_never_passes_the_wall_is_untouched() -> None:
    np.testing.assert_allclose(TRUTH.picture[~TRUTH.swept], WALL[~TRUTH.swept], atol=1e-15)
    length = 2 * moving_ball.RADIUS * moving_ball.TRAVEL
    assert TRUTH.swept.sum() == pytest.approx(length + np.pi * moving_ball.RADIUS**2, rel=0.01)


def test_light_is_neither_made_nor_lost_by_motion() -> None:
    """The ball covers the same area at every moment: its share of the exposure adds up to it."""
    ball = np.where(TRUTH.swept, TRUTH.picture, 0).sum()
    instants = [
        np.where(TRUTH.swept, moving_ball.instant(WORK.x, WORK.y, time, WALL), 0).sum()
        for time in np.linspace(0.01, 0.99, 50)
    ]
    assert np.mean(instants) == pytest.approx(ball, rel=2e-3)


def test_the_integral_is_exact() -> None:
    assert worst(LADDER.tier("integral").run(WORK), TRUTH, WORK) < 1e-13


def test_the_error_falls_in_inverse_proportion_to_the_number_of_instants() -> None:
    counts = np.array([1, 4, 16, 64])
    errors = [RMS[f"instants-{count}"] for count in counts]
    assert np.polyfit(np.log(counts), np.log(errors), 1)[0] == pytest.approx(-1, abs=0.15)
    assert np.all((counts * errors > 0.2) & (counts * errors < 0.5))


def test_random_instants_err_by_the_spread_of_the_light_over_the_root_of_their_number() -> None:
    variance = brute_force(power=2) - brute_force() ** 2
    expected = np.sqrt(variance[TRUTH.swept].mean() / 16)
    assert RMS["random-16"] == pytest.approx(expected, rel=0.03)
    assert RMS["random-16"] > 2 * RMS["instants-16"]


def test_an_instant_in_each_share_of_the_time_is_nearly_as_good_as_even_ones() -> None:
    assert RMS["instants-16"] < RMS["jittered-16"] < 1.2 * RMS["instants-16"]


def test_a_smear_stays_within_the_outline_that_the_ball_has_at_half_time() -> None:
    smeared = LADDER.tier("smear").run(WORK)
    outside = ~moving_ball.on_ball(WORK.x, WORK.y, 0.5)
    np.testing.assert_array_equal(smeared[outside], WALL[outside])
    assert RMS["instants-4"] < RMS["smear"] < RMS["instants-1"] / 2


def test_on_a_ball_that_fills_its_row_a_smear_is_the_true_blur_of_the_stripes() -> None:
    """A pixel so deep in the ball that no wall enters: the mean of bars over the travel."""
    smeared = LADDER.tier("smear").run(WORK)
    row, column = 47, round(moving_ball.START_X + moving_ball.TRAVEL / 2)
    assert smeared[row, column] == pytest.approx(TRUTH.picture[row, column], abs=0.02)


def test_the_metrics_notice_an_exposure_that_begins_too_late() -> None:
    late = LADDER.tier("integral").run(type(WORK)(WORK.x - 0.5, WORK.y))
    assert rms(late, TRUTH, WORK) > 0.01
    assert worst(late, TRUTH, WORK) > 0.05


def test_the_default_is_not_beaten_in_both_work_and_error() -> None:
    work = {"instants-1": 1, "smear": 2, "integral": 1.5, "instants-4": 4}
    work |= {"random-16": 16, "jittered-16": 16, "instants-16": 16, "instants-64": 64}
    front = pareto_front([(cost, RMS[tier]) for tier, cost in work.items()])
    assert front[list(work).index(LADDER.default_tier)]
