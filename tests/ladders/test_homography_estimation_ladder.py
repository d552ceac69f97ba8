"""Which homography one gets from noisy points is ruled by the error that is minimised."""

import cv2
import numpy as np
import pytest

from simulations.ladders.homography_estimation import (
    LADDER,
    NOISE_PX,
    VIEWS,
    Matches,
    View,
    prepare,
    reference,
    rms_px,
    true_map,
)

WORK = prepare()
TRUTH = reference(WORK)
RESULT = {tier.id: tier.run(WORK) for tier in LADDER.tiers}
NAMES = [view.name for view in VIEWS]


def error_px(tier: str, *views: str) -> float:
    return rms_px(RESULT[tier], TRUTH, WORK, views=views)


def least_error_px(view: View, matches: Matches) -> float:
    """Cramér–Rao: the RMS error that no unbiased estimate can beat, from numeric derivatives."""
    h = np.array(view.homography)

    def slopes(points: np.ndarray) -> np.ndarray:
        """(2N, 8) change of the mapped points per relative change of each entry."""
        columns = []
        for index in range(8):
            mapped = []
            for sign in (1.0, -1.0):
                moved = h.copy()
                moved[index] *= 1.0 + sign * 1e-6
                shifted = View("moved", tuple(moved), view.low, view.high, 0.0)
                mapped.append(true_map(shifted, points).ravel())
            columns.append((mapped[0] - mapped[1]) / 2e-6)
        return np.stack(columns, axis=-1)

    judged = slopes(matches.check)
    squares = []
    for source in matches.source:
        seen = slopes(source)
        scale = np.linalg.norm(seen, axis=0)
        covariance = NOISE_PX**2 * np.linalg.inv((seen / scale).T @ (seen / scale))
        spread = np.einsum("ij,jk,ik->i", judged / scale, covariance, judged / scale)
        squares.append(spread.sum() / len(matches.check))
    return float(np.sqrt(np.mean(squares)))


@pytest.mark.parametrize("index", range(len(VIEWS)))
def test_the_reference_is_opencvs_perspective_map(index: int) -> None:
    H = np.append(VIEWS[index].homography, 1.0).reshape(3, 3)
    oracle = cv2.perspectiveTransform(WORK[index].check[None], H)[0]
    np.testing.assert_allclose(TRUTH[index], oracle, atol=1e-9)


@pytest.mark.parametrize("name", ["poster", "wall"])
def test_least_squares_reaches_the_least_error_there_can_be(name: str) -> None:
    index = NAMES.index(name)
    bound = least_error_px(VIEWS[index], WORK[index])
    assert error_px("refined", name) == pytest.approx(bound, rel=0.2)


@pytest.mark.parametrize("name", ["poster", "wall"])
def test_least_squares_agrees_with_opencvs_refined_estimate(name: str) -> None:
    index = NAMES.index(name)
    matches = WORK[index]
    H, _ = cv2.findHomography(matches.source[0], matches.target[0], 0)
    oracle = cv2.perspectiveTransform(matches.check[None], H)[0]
    # Two Gauss–Newton steps are not yet the minimum, but far nearer it than the noise.
    assert np.abs(RESULT["refined"][index][0] - oracle).max() < 0.1 * NOISE_PX


def test_pixel_coordinates_spoil_the_plain_transform_of_a_small_thing_off_the_middle() -> None:
    assert error_px("plain", "poster") > 5 * error_px("normalised", "poster")


def test_normalised_algebraic_error_is_good_where_perspective_is_weak() -> None:
    assert error_px("normalised", "poster") == pytest.approx(
        error_px("refined", "poster"), rel=0.01
    )


def test_and_not_where_it_is_strong_since_it_weighs_near_and_far_points_unlike() -> None:
    assert error_px("normalised", "wall") > 1.5 * error_px("refined", "wall")


def test_four_points_waste_the_other_thirty_six() -> None:
    assert error_px("four-points", "poster", "wall") > 2 * error_px("normalised", "poster", "wall")


def test_squaring_a_normalised_system_changes_nothing_to_be_seen() -> None:
    for ours, theirs in zip(RESULT["squared"], RESULT["normalised"], strict=True):
        np.testing.assert_allclose(ours, theirs, atol=1e-6)


@pytest.mark.parametrize("tier", [tier.id for tier in LADDER.tiers])
def test_every_way_is_exact_without_noise(tier: str) -> None:
    assert error_px(tier, "exact") < 1e-6


def test_the_default_is_better_than_everything_cheaper() -> None:
    default = [tier.id for tier in LADDER.tiers].index(LADDER.default_tier)
    least = error_px(LADDER.default_tier, "poster", "wall")
    assert all(error_px(tier.id, "poster", "wall") > least for tier in LADDER.tiers[:default])


def test_a_lost_point_counts_a_thousand_pixels() -> None:
    lost = tuple(np.full_like(each, np.nan) for each in RESULT["refined"])
    assert rms_px(lost, TRUTH, WORK, views=("poster",)) == pytest.approx(1000.0)


def test_the_metric_measures_a_known_shift() -> None:
    shifted = tuple(each[None] + np.array([3.0, 4.0]) for each in TRUTH)
    assert rms_px(shifted, TRUTH, WORK, views=("poster", "wall")) == pytest.approx(5.0)
