"""Averages of instants, against the exact integral over the exposure."""

from functools import cache

import numpy as np
import pytest
from support.ladder_run import LadderRun

from simulations.ladders.exposure_blur import LADDER, rms, worst
from simulations.pictures import moving_ball

RUN = LadderRun(LADDER)


@cache
def wall() -> np.ndarray:
    return moving_ball.wall(RUN.work.x, RUN.work.y)


@cache
def tier_rms() -> dict[str, float]:
    return RUN.measured(rms)


@cache
def brute_force(power: int = 1, count: int = 400) -> np.ndarray:
    """Mean over many instants of the picture, or of its square."""
    times = (np.arange(count) + 0.5) / count
    pictures = (
        moving_ball.instant(RUN.work.x, RUN.work.y, time, wall()) ** power for time in times
    )
    return np.asarray(sum(pictures) / count)


def test_the_reference_agrees_with_four_hundred_instants() -> None:
    """A pixel changes ten times at most, each time by 0.8 at most, and each costs 1/800."""
    assert worst(brute_force(), RUN.truth, RUN.work) < 10 * 0.8 / 800
    assert rms(brute_force(), RUN.truth, RUN.work) < 0.5 / 400


def test_where_the_ball_never_passes_the_wall_is_untouched() -> None:
    np.testing.assert_allclose(
        RUN.truth.picture[~RUN.truth.swept], wall()[~RUN.truth.swept], atol=1e-15
    )
    length = 2 * moving_ball.RADIUS * moving_ball.TRAVEL
    assert RUN.truth.swept.sum() == pytest.approx(length + np.pi * moving_ball.RADIUS**2, rel=0.01)


def test_light_is_neither_made_nor_lost_by_motion() -> None:
    """The ball covers the same area at every moment: its share of the exposure adds up to it."""
    ball = np.where(RUN.truth.swept, RUN.truth.picture, 0).sum()
    instants = [
        np.where(
            RUN.truth.swept, moving_ball.instant(RUN.work.x, RUN.work.y, time, wall()), 0
        ).sum()
        for time in np.linspace(0.01, 0.99, 50)
    ]
    assert np.mean(instants) == pytest.approx(ball, rel=2e-3)


def test_the_integral_is_exact() -> None:
    assert worst(LADDER.tier("integral").run(RUN.work), RUN.truth, RUN.work) < 1e-13


def test_the_error_falls_in_inverse_proportion_to_the_number_of_instants() -> None:
    counts = np.array([1, 4, 16, 64])
    errors = [tier_rms()[f"instants-{count}"] for count in counts]
    assert np.polyfit(np.log(counts), np.log(errors), 1)[0] == pytest.approx(-1, abs=0.15)
    assert np.all((counts * errors > 0.2) & (counts * errors < 0.5))


def test_random_instants_err_by_the_spread_of_the_light_over_the_root_of_their_number() -> None:
    variance = brute_force(power=2) - brute_force() ** 2
    expected = np.sqrt(variance[RUN.truth.swept].mean() / 16)
    assert tier_rms()["random-16"] == pytest.approx(expected, rel=0.03)
    assert tier_rms()["random-16"] > 2 * tier_rms()["instants-16"]


def test_an_instant_in_each_share_of_the_time_is_nearly_as_good_as_even_ones() -> None:
    assert tier_rms()["instants-16"] < tier_rms()["jittered-16"] < 1.2 * tier_rms()["instants-16"]


def test_a_smear_stays_within_the_outline_that_the_ball_has_at_half_time() -> None:
    smeared = LADDER.tier("smear").run(RUN.work)
    outside = ~moving_ball.on_ball(RUN.work.x, RUN.work.y, 0.5)
    np.testing.assert_array_equal(smeared[outside], wall()[outside])
    assert tier_rms()["instants-4"] < tier_rms()["smear"] < tier_rms()["instants-1"] / 2


def test_on_a_ball_that_fills_its_row_a_smear_is_the_true_blur_of_the_stripes() -> None:
    """A pixel so deep in the ball that no wall enters: the mean of bars over the travel."""
    smeared = LADDER.tier("smear").run(RUN.work)
    row, column = 47, round(moving_ball.START_X + moving_ball.TRAVEL / 2)
    assert smeared[row, column] == pytest.approx(RUN.truth.picture[row, column], abs=0.02)


def test_the_metrics_notice_an_exposure_that_begins_too_late() -> None:
    late = LADDER.tier("integral").run(type(RUN.work)(RUN.work.x - 0.5, RUN.work.y))
    assert rms(late, RUN.truth, RUN.work) > 0.01
    assert worst(late, RUN.truth, RUN.work) > 0.05
