"""Which homography one gets from noisy points is ruled by the error that is minimised."""

import cv2
import numpy as np
import pytest
from scipy.optimize import least_squares
from support.ladder_run import LadderRun

from simulations.ladders.homography_estimation.estimators import one_sided, two_sided
from simulations.ladders.homography_estimation.ladder import LADDER, rms_px
from simulations.ladders.homography_estimation.matches import (
    NOISE_PX,
    VIEWS,
    Matches,
    View,
    mapped,
    true_map,
)
from simulations.models.geometry.homography_estimation import estimate_homography

RUN = LadderRun(LADDER)
NAMES = [view.name for view in VIEWS]


def error_px(tier: str, *views: str) -> float:
    return rms_px(RUN.results[tier], RUN.truth, RUN.work, views=views)


def by_entries(view: View, points: np.ndarray) -> np.ndarray:
    """(2N, 8) change of the mapped points (N, 2) per relative change of each entry."""
    columns = []
    for index in range(8):
        both = []
        for sign in (1.0, -1.0):
            h = np.append(view.homography, 1.0)
            h[index] *= 1.0 + sign * 1e-6
            both.append(mapped(h, points).ravel())
        columns.append((both[0] - both[1]) / 2e-6)
    return np.stack(columns, axis=-1)


def by_place(view: View, points: np.ndarray) -> np.ndarray:
    """(N, 2, 2) change of the mapped points per pixel in the first picture."""
    steps = [(true_map(view, points + s) - true_map(view, points - s)) / 2 for s in np.eye(2)]
    return np.stack(steps, axis=-1)


def least_error_px(view: View, matches: Matches) -> float:
    """Cramér–Rao: the RMS error that no unbiased estimate can beat, from numeric derivatives.

    A pair of points tells of the map through a residual of covariance σ² (I + J Jᵀ).
    """
    judged = by_entries(view, matches.check)
    squares = []
    for exact in matches.exact:
        J, seen = by_place(view, exact), by_entries(view, exact).reshape(-1, 2, 8)
        weight = np.linalg.inv(np.eye(2) + J @ J.transpose(0, 2, 1)) / NOISE_PX**2
        information = np.einsum("nia,nij,njb->ab", seen, weight, seen)
        size = np.sqrt(np.diag(information))
        covariance = np.linalg.inv(information / np.outer(size, size))
        spread = np.einsum("ij,jk,ik->i", judged / size, covariance, judged / size)
        squares.append(spread.sum() / len(matches.check))
    return float(np.sqrt(np.mean(squares)))


@pytest.mark.parametrize("index", range(len(VIEWS)))
def test_the_reference_is_opencvs_perspective_map(index: int) -> None:
    H = np.append(VIEWS[index].homography, 1.0).reshape(3, 3)
    oracle = cv2.perspectiveTransform(RUN.work[index].check[None], H)[0]
    np.testing.assert_allclose(RUN.truth[index], oracle, atol=1e-9)


@pytest.mark.parametrize("index", [0, 1])
def test_both_pictures_are_noisy_and_alike(index: int) -> None:
    matches = RUN.work[index]
    for found, exact in (
        (matches.source, matches.exact),
        (matches.target, true_map(VIEWS[index], matches.exact)),
    ):
        assert (found - exact).std() == pytest.approx(NOISE_PX, rel=0.1)
    noise = matches.source - matches.exact, matches.target - true_map(VIEWS[index], matches.exact)
    assert abs(np.corrcoef(noise[0].ravel(), noise[1].ravel())[0, 1]) < 0.1


@pytest.mark.parametrize("name", ["poster", "wall"])
def test_least_squares_in_both_pictures_reaches_the_least_error_there_can_be(name: str) -> None:
    index = NAMES.index(name)
    bound = least_error_px(VIEWS[index], RUN.work[index])
    assert error_px("two-sided", name) == pytest.approx(bound, rel=0.2)


def test_least_squares_in_the_second_picture_agrees_with_opencvs_refined_estimate() -> None:
    for index, name in enumerate(("poster", "wall")):
        matches, ours = RUN.work[index], RUN.results["one-sided"][index][0]
        H, _ = cv2.findHomography(matches.source[0], matches.target[0], 0)
        oracle = cv2.perspectiveTransform(matches.check[None], H)[0]
        off = mapped(ours.ravel(), matches.check) - oracle
        # Two Gauss–Newton steps are not yet the minimum, but far nearer it than it is to the truth.
        assert np.sqrt((off**2).sum(axis=1).mean()) < 0.1 * error_px("one-sided", name)


def test_weighing_by_both_noises_agrees_with_moving_the_points_themselves() -> None:
    """The gold standard: unknown are the map and where each point of the first picture is."""
    matches, view = RUN.work[1], VIEWS[1]
    source, target = matches.source[0], matches.target[0]
    size = np.abs(view.homography)

    def residuals(unknown: np.ndarray) -> np.ndarray:
        h, points = np.append(unknown[:8] * size, 1.0), unknown[8:].reshape(-1, 2) * 1e3
        return np.concatenate(((points - source).ravel(), (mapped(h, points) - target).ravel()))

    start = np.concatenate((np.array(view.homography) / size, source.ravel() / 1e3))
    best = least_squares(residuals, start, method="lm", xtol=1e-12, ftol=1e-12).x
    gold = mapped(np.append(best[:8] * size, 1.0), matches.check)
    ours = mapped(RUN.results["two-sided"][1][0].ravel(), matches.check)
    scatter = error_px("two-sided", "wall")
    assert np.sqrt(((ours - gold) ** 2).sum(axis=1).mean()) < 0.1 * scatter


def test_pixel_coordinates_spoil_the_plain_transform_of_a_small_thing_off_the_middle() -> None:
    assert error_px("plain", "poster") > 5 * error_px("normalised", "poster")


def test_the_error_hardly_matters_where_perspective_is_weak() -> None:
    for tier in ("one-sided", "two-sided"):
        assert error_px("normalised", "poster") == pytest.approx(error_px(tier, "poster"), rel=0.01)


def test_distances_in_the_second_picture_alone_are_worse_than_none_where_it_enlarges() -> None:
    """They trust the first picture's points, whose noise is enlarged most where it matters most."""
    assert error_px("one-sided", "wall") > 1.15 * error_px("normalised", "wall")
    assert error_px("normalised", "wall") > 1.05 * error_px("two-sided", "wall")


def test_if_the_first_picture_were_exact_they_would_be_the_best() -> None:
    matches, view = RUN.work[1], VIEWS[1]
    truth = true_map(view, matches.check)
    noise = matches.target - true_map(view, matches.exact)
    errors = {}
    for estimate in (one_sided, two_sided):
        found = [
            mapped(estimate(exact, true_map(view, exact) + off).ravel(), matches.check)
            for exact, off in zip(matches.exact, noise, strict=True)
        ]
        errors[estimate.__name__] = np.sqrt(np.mean((np.stack(found) - truth) ** 2))
    assert errors["one_sided"] < 0.95 * errors["two_sided"]


def test_four_points_waste_the_other_thirty_six() -> None:
    assert error_px("four-points", "poster", "wall") > 2 * error_px("normalised", "poster", "wall")


@pytest.mark.parametrize("tier", ["squared", "normalised"])
def test_without_its_checks_the_normalised_transform_is_the_model_s(tier: str) -> None:
    for matches, ours in zip(RUN.work, RUN.results[tier], strict=True):
        for source, target, H in zip(matches.source, matches.target, ours, strict=True):
            theirs, valid = estimate_homography(source, target)
            assert valid
            points = [mapped(each.ravel(), matches.check) for each in (H, theirs)]
            np.testing.assert_allclose(points[0], points[1], atol=1e-6)


@pytest.mark.parametrize("tier", [tier.id for tier in LADDER.tiers])
def test_every_way_is_exact_without_noise(tier: str) -> None:
    assert error_px(tier, "exact") < 1e-6


def test_a_lost_point_counts_a_thousand_pixels() -> None:
    lost = tuple(np.full_like(each, np.nan) for each in RUN.results["two-sided"])
    assert rms_px(lost, RUN.truth, RUN.work, views=("poster",)) == pytest.approx(1000.0)


@pytest.mark.parametrize("factor", [1.0, -3.0])
def test_the_metric_measures_a_known_shift_whatever_multiple_is_given(factor: float) -> None:
    shift = np.array([[1.0, 0.0, 3.0], [0.0, 1.0, 4.0], [0.0, 0.0, 1.0]])
    shifted = tuple(
        factor * (shift @ np.append(view.homography, 1.0).reshape(3, 3))[None] for view in VIEWS
    )
    assert rms_px(shifted, RUN.truth, RUN.work, views=("poster", "wall")) == pytest.approx(5.0)
