"""Two views of one point, against points projected into both, OpenCV, and drawn errors."""

import math

import cv2
import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.geometry import rotations
from simulations.models.projection import pinhole
from simulations.models.projection.two_views import (
    depth_error,
    depth_from_disparity,
    depth_of_match,
    epipolar_lines,
    fundamental_matrix,
)

FIRST = pinhole.intrinsics((800.0, 780.0), (320.0, 240.0), 1.5)
SECOND = pinhole.intrinsics(500.0, (300.0, 200.0))
R = rotations.exponential([0.1, -0.3, 0.05])
T = np.array([-0.4, 0.1, 0.2])
F = fundamental_matrix(FIRST, SECOND, R, T)
RNG = np.random.default_rng(3)
POINTS = RNG.uniform((-1, -1, 3), (1, 1, 9), (40, 3))


def pair() -> tuple[Floats, Floats]:
    left, _ = pinhole.project(POINTS, FIRST)
    right, valid = pinhole.project(POINTS @ R.T + T, SECOND)
    assert valid.all()
    return left, right


def test_epipolar_lines_are_those_of_opencv() -> None:
    left, right = pair()
    lines, valid = epipolar_lines(F, left)
    assert valid.all()
    theirs = cv2.computeCorrespondEpilines(left[:, None], 1, F)[:, 0]
    turned = np.sign((lines * theirs).sum(axis=1))[:, None]
    np.testing.assert_allclose(lines, turned * theirs, atol=1e-6)
    np.testing.assert_allclose((lines[:, :2] * right).sum(axis=1) + lines[:, 2], 0.0, atol=1e-9)


def test_a_match_tells_the_depth() -> None:
    left, right = pair()
    depth, valid = depth_of_match(left, right, FIRST, SECOND, R, T)
    assert valid.all()
    np.testing.assert_allclose(depth, POINTS[:, 2], rtol=1e-10)
    cameras = FIRST @ np.eye(3, 4), SECOND @ np.column_stack([R, T])
    theirs = cv2.triangulatePoints(*cameras, left.T, right.T)
    np.testing.assert_allclose(depth, theirs[2] / theirs[3], rtol=1e-6)


def test_a_match_beside_its_line_counts_as_the_nearest_point_of_it() -> None:
    left, right = pair()
    lines, _ = epipolar_lines(F, left)
    beside = right + 3.0 * lines[:, :2]
    depth, _ = depth_of_match(left, beside, FIRST, SECOND, R, T)
    np.testing.assert_allclose(depth, POINTS[:, 2], rtol=1e-9)


def test_where_the_ray_vanishes_depth_is_infinite_and_beyond_there_is_none() -> None:
    K = pinhole.intrinsics(160.0, (0.0, 0.0))
    matches = [(30.0, 0.0), (31.0, 0.0), (10.0, 0.0), (math.nan, 0.0)]
    depth, valid = depth_of_match((30.0, 0.0), matches, K, K, np.eye(3), (-0.5, 0.0, 0.0))
    assert valid.tolist() == [True, False, True, False]
    assert depth[0] == math.inf
    assert depth[2] == pytest.approx(160 * 0.5 / 20)
    assert np.isnan(depth[[1, 3]]).all()


def test_depth_is_focal_length_times_baseline_over_disparity() -> None:
    depth, valid = depth_from_disparity([20.0, 16.0, 0.0, -0.0, -1.0, math.nan], 800.0, 0.1)
    assert valid.tolist() == [True, True, True, True, False, False]
    assert depth[:4] == pytest.approx((4.0, 5.0, math.inf, math.inf))
    assert np.isnan(depth[4:]).all()


@pytest.mark.parametrize("depth", [2.0, 8.0, 20.0])
def test_drawn_errors_of_disparity_spread_depth_as_the_formula_says(depth: float) -> None:
    """Standard deviations, of errors that are small beside the disparity."""
    focal, baseline = 800.0, 0.5
    disparity = focal * baseline / depth
    sigma = 0.01 * disparity
    drawn = disparity + sigma * RNG.standard_normal(200_000)
    depths, _ = depth_from_disparity(drawn, focal, baseline)
    predicted = depth_error(depth, focal, baseline, sigma)
    assert depths.std() == pytest.approx(predicted, rel=0.01)
    exact = focal * baseline / (disparity - sigma) - depth
    assert exact == pytest.approx(predicted, rel=0.011)


def test_an_exact_disparity_leaves_no_depth_in_doubt_and_a_wrong_one_all_of_infinity() -> None:
    wrong = depth_error([math.inf, 1e200, math.inf, math.nan], 800.0, 0.1, [0.0, 0.0, 0.5, 0.0])
    np.testing.assert_array_equal(wrong, [0.0, 0.0, math.inf, math.nan])
