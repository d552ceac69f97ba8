"""Precision lost far from the origin is lost to cancellation, and one subtraction saves it."""

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from simulations.ladders.precision import (
    FOCAL_PX,
    LADDER,
    TURN,
    UNIT_M,
    Place,
    prepare,
    reference,
    rms_far_px,
    rms_near_px,
)
from simulations.models.projection.pinhole import relative_to_camera, rigid_pose, world_to_camera

WORK = prepare()
TRUTH = reference(WORK)
RESULT = {tier.id: tier.run(WORK) for tier in LADDER.tiers}
FAR_PX = {name: rms_far_px(result, TRUTH, WORK) for name, result in RESULT.items()}
NEAR_PX = {name: rms_near_px(result, TRUTH, WORK) for name, result in RESULT.items()}


def test_the_camera_is_turned_by_a_rotation() -> None:
    assert np.array_equal(TURN @ TURN.T, 225 * np.eye(3))
    assert np.linalg.det(TURN) > 0


@pytest.mark.parametrize("place", [WORK.near, WORK.far])
def test_float64_holds_the_points_exactly(place: Place) -> None:
    np.testing.assert_array_equal((place.points - place.centre) / UNIT_M, WORK.steps)


@pytest.mark.parametrize("index", [0, 1, 9_999])
def test_the_reference_is_right_in_exact_fractions(index: int) -> None:
    step = [int(each) for each in WORK.steps[index]]
    x, _, z = (sum(int(a) * b for a, b in zip(row, step, strict=True)) for row in TURN)
    assert TRUTH[index, 0] == pytest.approx(float(Fraction(1000 * x, z)), rel=3e-16)


def test_all_points_are_seen() -> None:
    assert np.abs(TRUTH).max() < 0.51 * FOCAL_PX


def test_float32_does_well_near_the_origin_and_fails_far_from_it() -> None:
    assert NEAR_PX["float32"] < 1e-3
    assert FAR_PX["float32"] > 10.0


@pytest.mark.parametrize("tier", ["relative-32", "relative-64"])
def test_a_camera_at_the_origin_feels_no_distance(tier: str) -> None:
    np.testing.assert_array_equal(RESULT[tier][0], RESULT[tier][1])


def test_the_float64_tiers_do_as_the_projection_model_does() -> None:
    for place, plain, relative in zip(
        (WORK.near, WORK.far), RESULT["float64"], RESULT["relative-64"], strict=True
    ):
        pose = rigid_pose(WORK.rotation, -WORK.rotation @ place.centre)
        moved = world_to_camera(place.points, pose)
        np.testing.assert_allclose(plain, FOCAL_PX * moved[:, :2] / moved[:, 2:], atol=1e-5)
        near = relative_to_camera(place.points, WORK.rotation, place.centre)
        np.testing.assert_allclose(relative, FOCAL_PX * near[:, :2] / near[:, 2:], atol=1e-11)


def test_one_subtraction_makes_float32_a_thousandth_of_a_pixel() -> None:
    assert FAR_PX["relative-32"] < 1e-3
    assert FAR_PX["float32"] > 1e5 * FAR_PX["relative-32"]


def test_float64_loses_as_many_digits_as_the_origin_is_far() -> None:
    farther = 16.0 * WORK.far.centre
    other = replace(WORK, far=Place(farther, farther + WORK.steps * UNIT_M))
    growth = rms_far_px(LADDER.tier("float64").run(other), TRUTH, other) / FAR_PX["float64"]
    assert 8.0 < growth < 32.0
    np.testing.assert_array_equal(
        LADDER.tier("relative-64").run(other)[1], RESULT["relative-64"][1]
    )


def test_each_step_up_buys_digits() -> None:
    order = [FAR_PX[name] for name in ("float32", "relative-32", "float64", "relative-64")]
    assert all(worse > 100 * better for worse, better in pairwise(order))


def test_the_default_is_better_than_everything_cheaper() -> None:
    default = [tier.id for tier in LADDER.tiers].index(LADDER.default_tier)
    assert all(FAR_PX[tier.id] > FAR_PX[LADDER.default_tier] for tier in LADDER.tiers[:default])


def test_a_lost_point_counts_a_thousand_pixels() -> None:
    lost = TRUTH.copy()
    lost[0] = np.nan
    expected = FOCAL_PX / np.sqrt(len(TRUTH))
    assert rms_far_px((TRUTH, lost), TRUTH, WORK) == pytest.approx(expected)
    assert rms_near_px((TRUTH, lost), TRUTH, WORK) == 0.0
