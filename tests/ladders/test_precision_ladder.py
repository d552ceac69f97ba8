"""Precision lost far from the origin is lost to cancellation, and one subtraction saves it."""

from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from support.ladder_run import LadderRun

from simulations.ladders.precision import (
    FOCAL_PX,
    LADDER,
    TURN,
    UNIT_M,
    Place,
    rms_far_px,
    rms_near_px,
)
from simulations.models.projection.pinhole import relative_to_camera, rigid_pose, world_to_camera

RUN = LadderRun(LADDER)


@cache
def far_px() -> dict[str, float]:
    return RUN.measured(rms_far_px)


@cache
def near_px() -> dict[str, float]:
    return RUN.measured(rms_near_px)


def test_the_camera_is_turned_by_a_rotation() -> None:
    assert np.array_equal(TURN @ TURN.T, 225 * np.eye(3))
    assert np.linalg.det(TURN) > 0


@pytest.mark.parametrize("at", ["near", "far"])
def test_float64_holds_the_points_exactly(at: str) -> None:
    place: Place = getattr(RUN.work, at)
    np.testing.assert_array_equal((place.points - place.centre) / UNIT_M, RUN.work.steps)


@pytest.mark.parametrize("index", [0, 1, 9_999])
def test_the_reference_is_right_in_exact_fractions(index: int) -> None:
    step = [int(each) for each in RUN.work.steps[index]]
    x, _, z = (sum(int(a) * b for a, b in zip(row, step, strict=True)) for row in TURN)
    assert RUN.truth[index, 0] == pytest.approx(float(Fraction(1000 * x, z)), rel=3e-16)


def test_all_points_are_seen() -> None:
    assert np.abs(RUN.truth).max() < 0.51 * FOCAL_PX


def test_float32_does_well_near_the_origin_and_fails_far_from_it() -> None:
    assert near_px()["float32"] < 1e-3
    assert far_px()["float32"] > 10.0


@pytest.mark.parametrize("tier", ["relative-32", "relative-64"])
def test_a_camera_at_the_origin_feels_no_distance(tier: str) -> None:
    np.testing.assert_array_equal(RUN.results[tier][0], RUN.results[tier][1])


def test_the_float64_tiers_do_as_the_projection_model_does() -> None:
    for place, plain, relative in zip(
        (RUN.work.near, RUN.work.far),
        RUN.results["float64"],
        RUN.results["relative-64"],
        strict=True,
    ):
        pose = rigid_pose(RUN.work.rotation, -RUN.work.rotation @ place.centre)
        moved = world_to_camera(place.points, pose)
        np.testing.assert_allclose(plain, FOCAL_PX * moved[:, :2] / moved[:, 2:], atol=1e-5)
        near = relative_to_camera(place.points, RUN.work.rotation, place.centre)
        np.testing.assert_allclose(relative, FOCAL_PX * near[:, :2] / near[:, 2:], atol=1e-11)


def test_one_subtraction_makes_float32_a_thousandth_of_a_pixel() -> None:
    assert far_px()["relative-32"] < 1e-3
    assert far_px()["float32"] > 1e5 * far_px()["relative-32"]


def test_float64_loses_as_many_digits_as_the_origin_is_far() -> None:
    farther = 16.0 * RUN.work.far.centre
    other = replace(RUN.work, far=Place(farther, farther + RUN.work.steps * UNIT_M))
    growth = rms_far_px(LADDER.tier("float64").run(other), RUN.truth, other) / far_px()["float64"]
    assert 8.0 < growth < 32.0
    np.testing.assert_array_equal(
        LADDER.tier("relative-64").run(other)[1], RUN.results["relative-64"][1]
    )


def test_each_step_up_buys_digits() -> None:
    order = [far_px()[name] for name in ("float32", "relative-32", "float64", "relative-64")]
    assert all(worse > 100 * better for worse, better in pairwise(order))


def test_a_lost_point_counts_a_thousand_pixels() -> None:
    lost = RUN.truth.copy()
    lost[0] = np.nan
    expected = FOCAL_PX / np.sqrt(len(RUN.truth))
    assert rms_far_px((RUN.truth, lost), RUN.truth, RUN.work) == pytest.approx(expected)
    assert rms_near_px((RUN.truth, lost), RUN.truth, RUN.work) == 0.0
