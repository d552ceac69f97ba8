"""Truncated rotations err by the terms that were left out."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from simulations.ladders.small_rotations import (
    ANGLE_RAD,
    LADDER,
    prepare,
    reference,
    rms_frobenius,
    worst_distortion,
)

VECTORS = prepare()
TRUTH = reference(VECTORS)
RESULT = {tier.id: tier.run(VECTORS) for tier in LADDER.tiers}
RMS = {name: rms_frobenius(result, TRUTH, VECTORS) for name, result in RESULT.items()}
DISTORTION = {name: worst_distortion(result, TRUTH, VECTORS) for name, result in RESULT.items()}
SINE_TERM = ANGLE_RAD - np.sin(ANGLE_RAD)
VERSINE = 1.0 - np.cos(ANGLE_RAD)
# For a unit axis, [n]× and [n]×² are orthogonal matrices of Frobenius norm √2.
THEORY = {
    "first-order": np.sqrt(2.0) * np.hypot(SINE_TERM, VERSINE),
    "second-order": np.sqrt(2.0) * np.hypot(SINE_TERM, ANGLE_RAD**2 / 2.0 - VERSINE),
    "cayley": 2.0 * np.sqrt(2.0) * np.sin((ANGLE_RAD - 2.0 * np.arctan(ANGLE_RAD / 2.0)) / 2.0),
}


def test_the_reference_is_scipys_rotation() -> None:
    oracle = Rotation.from_rotvec(VECTORS).as_matrix()
    np.testing.assert_allclose(TRUTH.astype(float), oracle, atol=1e-15)


@pytest.mark.parametrize("tier", THEORY)
def test_a_truncated_rotation_errs_by_what_was_left_out(tier: str) -> None:
    assert RMS[tier] == pytest.approx(THEORY[tier], rel=1e-9)


def test_cayley_errs_half_as_much_as_the_second_order() -> None:
    assert RMS["second-order"] / RMS["cayley"] == pytest.approx(2.0, rel=0.01)


@pytest.mark.parametrize("tier", ["exact", "quaternion"])
def test_closed_forms_err_by_rounding(tier: str) -> None:
    assert RMS[tier] < 1e-15


def test_the_first_order_stretches_by_the_square_of_the_angle() -> None:
    # (I + K)ᵀ(I + K) = I − K²
    assert DISTORTION["first-order"] == pytest.approx(np.sqrt(2.0) * ANGLE_RAD**2, rel=1e-9)


def test_the_second_order_stretches_by_a_quarter_of_the_fourth_power() -> None:
    # (I − K + K²/2)(I + K + K²/2) = I + K⁴/4
    expected = np.sqrt(2.0) * ANGLE_RAD**4 / 4.0
    assert DISTORTION["second-order"] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("tier", ["cayley", "exact", "quaternion"])
def test_true_rotations_keep_lengths_and_right_angles(tier: str) -> None:
    assert DISTORTION[tier] < 1e-15


def test_the_default_is_better_than_everything_cheaper() -> None:
    default = [tier.id for tier in LADDER.tiers].index(LADDER.default_tier)
    assert all(RMS[tier.id] > RMS[LADDER.default_tier] for tier in LADDER.tiers[:default])


def test_the_metric_notices_a_turn_by_a_billionth_more() -> None:
    other = LADDER.tier("exact").run(VECTORS * (1.0 + 1e-9))
    # A change δ of the angle changes the matrix by √2 δ.
    assert rms_frobenius(other, TRUTH, VECTORS) == pytest.approx(
        np.sqrt(2.0) * ANGLE_RAD * 1e-9, rel=1e-3
    )
