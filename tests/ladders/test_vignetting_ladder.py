"""The ways to compute cos⁴ err by their table's step, their terms or their floats."""

from fractions import Fraction

import numpy as np
import pytest

from simulations.ladders.vignetting import (
    LADDER,
    TABLE_ENTRIES,
    prepare,
    profile_coefficients,
    reference,
    worst_error,
    worst_stops,
)

RADIUS = prepare()
TRUTH = reference(RADIUS)
WORST = {tier.id: worst_error(tier.run(RADIUS), TRUTH, RADIUS) for tier in LADDER.tiers}


@pytest.mark.parametrize("place", [(0, 0), (255, 255), (0, 255), (100, 17)])
def test_the_reference_is_right_in_exact_fractions(place: tuple[int, int]) -> None:
    exact = 1 / (1 + Fraction(float(RADIUS[place])) ** 2) ** 2
    assert float(TRUTH[place]) == pytest.approx(float(exact), rel=3e-16)


def test_the_picture_reaches_from_full_light_to_two_stops_less() -> None:
    assert 0.9999 < TRUTH.max() <= 1.0
    assert 0.25 < TRUTH.min() < 0.252


@pytest.mark.parametrize("tier", ["algebraic", "by-angle"])
def test_closed_forms_err_by_rounding(tier: str) -> None:
    assert WORST[tier] < 4 * np.finfo(float).eps


def test_float32_errs_by_its_rounding() -> None:
    assert 1e-8 < WORST["algebraic-32"] < 4 * np.finfo(np.float32).eps


def test_the_table_errs_by_half_a_step_where_the_curve_is_steepest() -> None:
    # |d/ds (1 + s)⁻²| = 2 at s = 0.
    assert WORST["table"] == pytest.approx(2.0 * 0.5 / (TABLE_ENTRIES - 1), rel=0.05)


def test_each_term_of_a_profile_gains_a_factor_of_about_six() -> None:
    # The pole at r² = −1 lies on the ellipse of Bernstein parameter 3 + 2√2 = 5.8.
    s = np.linspace(0.0, 1.0, 1001)
    errors = []
    for terms in (2, 3, 4, 5):
        powers = np.stack([s ** (power + 1) for power in range(terms)], axis=-1)
        fitted = 1.0 + powers @ profile_coefficients(terms)
        errors.append(np.abs(fitted - (1.0 + s) ** -2).max())
    gains = np.array(errors[:-1]) / errors[1:]
    assert np.all((gains > 4.0) & (gains < 7.0))
    assert errors[1] == pytest.approx(WORST["profile"], rel=0.05)


def test_the_default_is_better_than_everything_cheaper() -> None:
    default = [tier.id for tier in LADDER.tiers].index(LADDER.default_tier)
    assert all(WORST[tier.id] > WORST[LADDER.default_tier] for tier in LADDER.tiers[:default])


def test_the_metrics_measure_a_known_loss() -> None:
    assert worst_stops(TRUTH / 2, TRUTH, RADIUS) == pytest.approx(1.0)
    assert worst_error(TRUTH - 0.125, TRUTH, RADIUS) == pytest.approx(0.125)
