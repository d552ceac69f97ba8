"""Transformations estimated from pairs of points: homographies and the simpler families."""

import math

import cv2
import numpy as np
import pytest
from skimage.transform import EuclideanTransform, SimilarityTransform

from simulations.models.geometry import homography_estimation as estimation
from simulations.models.geometry import transforms
from simulations.models.geometry.transforms import apply_homography

RNG = np.random.default_rng(7)
CORNERS = np.array([(0.0, 0.0), (640.0, 0.0), (640.0, 480.0), (0.0, 480.0)])
SEEN = np.array([(32.0, 15.0), (610.0, 60.0), (580.0, 500.0), (-12.0, 430.0)])
KEYSTONE = transforms.projective([[1.1, 0.2, 30], [-0.1, 0.9, 5], [1e-3, 2e-4, 1]])


def test_four_points_give_the_homography_of_opencv() -> None:
    H, valid = estimation.estimate_homography(CORNERS, SEEN)
    expected = cv2.getPerspectiveTransform(CORNERS.astype(np.float32), SEEN.astype(np.float32))
    assert valid
    assert pytest.approx(expected, rel=1e-6, abs=1e-9) == H
    assert apply_homography(H, CORNERS)[0] == pytest.approx(SEEN, abs=1e-9)


@pytest.mark.parametrize(
    ("before", "after"), [(1e-9, 1e9), (1e9, 1e-9), (1e-90, 1e-90), (1e90, 1e90)]
)
def test_source_and_target_may_be_in_any_units(before: float, after: float) -> None:
    source, target = CORNERS * before, SEEN * after
    H, valid = estimation.estimate_homography(source, target)
    assert valid
    assert apply_homography(H, source)[0] / after == pytest.approx(SEEN, rel=1e-9)


def test_noisy_similarity_and_rigid_estimates_agree_with_scikit_image() -> None:
    points = RNG.uniform(-5, 5, (30, 2))
    noisy = apply_homography(transforms.similarity(1.3, 0.8, 2, 1), points)[0]
    noisy = noisy + RNG.normal(0, 0.3, noisy.shape)
    for estimate, oracle in (
        (estimation.estimate_similarity, SimilarityTransform),
        (estimation.estimate_rigid, EuclideanTransform),
    ):
        assert estimate(points, noisy)[0] == pytest.approx(
            oracle.from_estimate(points, noisy).params
        )


def test_noisy_affine_estimates_agree_with_plain_least_squares() -> None:
    points, noise = RNG.uniform(-5, 5, (30, 2)), RNG.normal(0, 0.3, (30, 2))
    target = points @ [[1.0, 0.2], [0.1, 0.9]] + noise
    expected = np.linalg.lstsq(np.column_stack([points, np.ones(30)]), target, rcond=None)[0].T
    assert estimation.estimate_affine(points, target)[0][:2] == pytest.approx(expected)


def test_normalised_points_have_their_centroid_at_zero_and_a_mean_distance_of_root_two() -> None:
    points = RNG.uniform(0, 500, (30, 2)) + np.array([1e4, 0])
    T = estimation.normalisation(points)
    assert T is not None
    moved = apply_homography(T, points)[0]
    assert moved.mean(axis=0) == pytest.approx((0, 0), abs=1e-12)
    assert np.hypot(*moved.T).mean() == pytest.approx(math.sqrt(2))
    assert T[0, 1] == 0
    assert T[0, 0] == T[1, 1] > 0


def test_two_points_determine_a_similarity_three_an_affine_map_and_four_a_homography() -> None:
    for estimate, count in (
        (estimation.estimate_rigid, 2),
        (estimation.estimate_similarity, 2),
        (estimation.estimate_affine, 3),
        (estimation.estimate_homography, 4),
    ):
        H, valid = estimate(CORNERS[:count], CORNERS[:count] + np.array([7, -3]))
        assert valid
        assert pytest.approx(transforms.translation(7, -3), abs=1e-9) == H
        assert not estimate(CORNERS[: count - 1], CORNERS[: count - 1])[1]


def test_a_homography_whose_origin_lies_beyond_infinity_has_a_negative_last_entry() -> None:
    """w = x − 1 is positive where the points are, and −1 at the origin."""
    H = np.array([[1.0, 0, 0], [0, 1, 0], [1, 0, -1]])
    points = np.array([(2.0, 0.0), (3.0, 0.0), (3.0, 1.0), (2.0, 1.5), (4.0, -1)])
    found, valid = estimation.estimate_homography(points, apply_homography(H, points)[0])
    assert valid
    assert found == pytest.approx(H / np.linalg.norm(H))
    at_zero = np.array([[0.0, 0, 1], [0, 1, 0], [1, 0, 0]])
    found, _ = estimation.estimate_homography(points, apply_homography(at_zero, points)[0])
    assert np.linalg.norm(found) == pytest.approx(1)
