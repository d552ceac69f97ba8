"""Straight lines between orientations lag by a known angle; great circles do not."""

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp
from support.ladder_run import LadderRun

from simulations.ladders.rotation_interpolation import (
    LADDER,
    errors_deg,
    worst_deg,
    worst_small_deg,
)
from simulations.models.geometry.quaternion_blends import STRAIGHT

RUN = LadderRun(LADDER)


@cache
def worst() -> dict[str, float]:
    return RUN.measured(worst_deg)


def straight_line_error_deg(angle_deg: np.ndarray, share: np.ndarray) -> np.ndarray:
    """(pairs, shares): a point on the chord of the arc Ω is seen at atan2 from its centre."""
    arc = np.radians(angle_deg)[:, None] / 2.0
    seen = np.arctan2(share * np.sin(arc), 1.0 - share + share * np.cos(arc))
    error_deg: np.ndarray = np.degrees(2.0 * np.abs(seen - share * arc))
    return error_deg


@pytest.mark.parametrize("pair", [1, 10, 90, 179])
def test_the_reference_is_scipys_slerp(pair: int) -> None:
    ends = np.stack([RUN.work.start[pair, 0], RUN.work.end[pair, 0]])
    path = Slerp([0.0, 1.0], Rotation.from_quat(ends, scalar_first=True))
    between = path(RUN.work.share).inv() * Rotation.from_quat(
        RUN.truth[pair].astype(float), scalar_first=True
    )
    assert between.magnitude().max() < 1e-14


def test_the_reference_moves_at_an_even_speed() -> None:
    steps = np.diff(RUN.truth.astype(float), axis=1)
    chords = np.linalg.norm(steps, axis=-1)
    np.testing.assert_allclose(chords, np.broadcast_to(chords[:, :1], chords.shape), atol=1e-14)


def test_the_straight_line_errs_as_the_chord_of_the_arc() -> None:
    theory = straight_line_error_deg(RUN.work.angle_deg, RUN.work.share)
    np.testing.assert_allclose(errors_deg(RUN.results["nlerp"], RUN.truth), theory, atol=1e-12)
    assert worst()["nlerp"] == pytest.approx(7.98, abs=0.01)
    assert worst_small_deg(RUN.results["nlerp"], RUN.truth, RUN.work) == pytest.approx(
        0.00122, abs=1e-5
    )


def test_the_straight_lines_error_grows_with_the_cube_of_the_angle() -> None:
    small = straight_line_error_deg(np.array([5.0, 10.0]), RUN.work.share).max(axis=1)
    assert small[1] / small[0] == pytest.approx(8.0, rel=0.01)
    measured = errors_deg(RUN.results["nlerp"], RUN.truth).max(axis=1)[[5, 10]]
    np.testing.assert_allclose(measured, small, rtol=1e-6)


def test_pacing_takes_out_99_parts_of_a_hundred() -> None:
    assert 100 * worst()["paced-nlerp"] < worst()["nlerp"]


def test_the_customary_threshold_costs_what_the_straight_line_errs_just_below_it() -> None:
    below = RUN.work.angle_deg[np.cos(np.radians(RUN.work.angle_deg / 2.0)) > STRAIGHT]
    assert below.max() == 3.0
    theory = straight_line_error_deg(below, RUN.work.share).max()
    assert worst()["slerp-threshold"] == pytest.approx(theory, rel=1e-6)


def test_the_great_circle_errs_by_rounding_even_where_the_two_are_one() -> None:
    assert RUN.work.angle_deg[0] == 0.0
    assert worst()["slerp"] < 1e-12


def test_the_metric_is_the_angle_of_rotation_and_takes_q_for_minus_q() -> None:
    identity = np.array([[[1.0, 0.0, 0.0, 0.0]]])
    half = np.radians(30.0) / 2.0
    turned = np.array([[[np.cos(half), 0.0, np.sin(half), 0.0]]])
    assert worst_deg(turned, identity, RUN.work) == pytest.approx(30.0)
    assert worst_deg(-turned, identity, RUN.work) == pytest.approx(30.0)
