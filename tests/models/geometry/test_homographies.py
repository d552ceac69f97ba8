"""Homographies: their inverse, condition, decomposition, and estimation from pairs of points."""

import math

import numpy as np
import pytest
from skimage.transform import EuclideanTransform, SimilarityTransform

from simulations.models.arrays import Floats
from simulations.models.geometry import homography_algebra as algebra
from simulations.models.geometry import homography_estimation as estimation
from simulations.models.geometry import transforms
from simulations.models.geometry.transforms import apply_homography

CORNERS = np.array([(0.0, 0.0), (640.0, 0.0), (640.0, 480.0), (0.0, 480.0)])
KEYSTONE = transforms.projective([[1.1, 0.2, 30], [-0.1, 0.9, 5], [1e-3, 2e-4, 1]])
TO_MM, TO_KM = np.diag([1e3, 1e3, 1]), np.diag([1e-3, 1e-3, 1])
KEYSTONE_CONDITION = algebra.condition_number(KEYSTONE)
ONE_UNKNOWN = np.array([[1.0, math.nan, 0], [0, 1, 0], [0, 0, 1]])


@pytest.mark.parametrize(
    ("H", "condition", "off"),
    [
        (-np.eye(3), 1.0, 1e-6),
        (transforms.translation(1e6, -1e6), 2.0, 1.0),
        (np.diag([5e8, 5e8, 1]), 1.0, 1e-6),
        # Balanced, the stretch diag(s, 1, ·) has singular values s : 1 : √((s² + 1)/2).
        (np.diag([10.0, 1.0, 1.0]), 10.0, 1e-9),
        (np.diag([1e6, 1.0, 1.0]), 1e6, 1e-9),
        (np.diag([1.0, 1e-14, 1.0]), 1e14, 0.1),
        (np.diag([1.0, 1e-17, 1.0]), math.inf, 0.0),
        (TO_MM @ KEYSTONE @ TO_KM, KEYSTONE_CONDITION, 1e-2),
        (-1e200 * KEYSTONE, KEYSTONE_CONDITION, 1e-6),
        (ONE_UNKNOWN, math.inf, 0.0),
    ],
)
def test_condition_number_is_the_balanced_matrixs(H: Floats, condition: float, off: float) -> None:
    assert algebra.condition_number(H) == pytest.approx(condition, rel=off)


@pytest.mark.parametrize(
    "H",
    [
        *(np.zeros((3, 3)), np.ones((3, 3)), np.full((3, 3), math.nan)),
        *(np.diag([1.0, 0.0, 1.0]), np.diag([1.0, 1e-15, 1.0]), np.diag([1.0, 1.0, 0.0])),
        np.diag([1.0, 0.5e-12, 1.0]),
    ],
)
def test_maps_that_flatten_the_plane_are_singular(H: Floats) -> None:
    assert algebra.is_singular(H)
    with pytest.raises(ValueError, match="condition number"):
        algebra.invert(H)


@pytest.mark.parametrize(
    "H",
    [
        *(np.diag([1.0, 2e-12, 1.0]), -2.0 * np.eye(3), np.eye(3) * 1e-308),
        *(KEYSTONE * 1e-200, KEYSTONE * 1e200, -1e-200 * np.eye(3), -1e200 * np.eye(3)),
    ],
)
def test_inverses_of_tiny_and_huge_matrices_are_finite(H: Floats) -> None:
    assert not algebra.is_singular(H)
    assert algebra.invert(H) @ H == pytest.approx(np.eye(3), abs=1e-9)


def test_decomposition_follows_its_documented_order() -> None:
    """Translation · rotation · stretch · vanishing terms, which apply first."""
    c, s = math.cos(0.5), math.sin(0.5)
    by_hand = (
        np.array([[1, 0, 3.0], [0, 1, -2], [0, 0, 1]])
        @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        @ np.array([[2.0, 2.0 * 0.3, 0], [0, -0.5, 0], [0, 0, 1]])
        @ np.array([[1.0, 0, 0], [0, 1, 0], [0.01, -0.02, 1]])
    )
    found = algebra.decompose(7.0 * by_hand)
    assert (found.tx, found.ty, found.angle_rad) == pytest.approx((3, -2, 0.5))
    assert (found.scale_x, found.scale_y, found.shear) == pytest.approx((2, -0.5, 0.3))
    assert found.vanishing == pytest.approx((0.01, -0.02))


RNG = np.random.default_rng(7)
IMAGES = np.array([(32.0, 15.0), (610.0, 60.0), (580.0, 500.0), (-12.0, 430.0)])


@pytest.mark.parametrize(
    ("before", "after"), [(1e-9, 1e9), (1e9, 1e-9), (1e-90, 1e-90), (1e90, 1e90)]
)
def test_homography_is_estimated_in_any_units(before: float, after: float) -> None:
    source, target = CORNERS * before, IMAGES * after
    H, valid = estimation.estimate_homography(source, target)
    assert valid
    assert apply_homography(H, source)[0] / after == pytest.approx(IMAGES, rel=1e-9)


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


def test_each_family_is_determined_by_its_number_of_points() -> None:
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


FIVE = np.array([(-3.0, 0.0), (-2.0, 1.0), (1.0, 0.0), (2.0, 1.0), (3.0, -1.0)])
THREE_ON_A_LINE = np.array([(0.0, 0), (1, 0), (2, 0), (0, 1)])


@pytest.mark.parametrize(
    ("source", "target"),
    [
        pytest.param(CORNERS[:3], IMAGES[:3], id="too few"),
        pytest.param(np.outer(np.arange(4.0), [1, 2]), IMAGES, id="on one line"),
        pytest.param(np.ones((4, 2)), IMAGES, id="coincident"),
        pytest.param(THREE_ON_A_LINE, IMAGES, id="three on one line"),
        pytest.param(THREE_ON_A_LINE, THREE_ON_A_LINE, id="many maps keep a line and a point"),
        pytest.param(
            np.array([(0.0, 0), (1, 0), (2, 1), (0, 1), (3, 5)]),
            np.array([(0.0, 0), (1, 0), (2, 0), (0, 0), (3, 0)]),
            id="the only map squashes the plane",
        ),
        pytest.param(FIVE, FIVE / (1 + FIVE[:, :1]), id="seen from both sides of infinity"),
    ],
)
def test_points_that_do_not_determine_a_homography_are_reported(
    source: Floats, target: Floats
) -> None:
    H, valid = estimation.estimate_homography(source, target)
    assert valid is False
    assert H.shape == (3, 3)
    assert np.isnan(H).all()


KEYSTONE_NEAR = np.array([[1.1, 0.1, 0.0], [-0.2, 0.9, 0.0], [0.1, -0.05, 1.0]])


@pytest.mark.parametrize("far", [1e6, 1e9])
def test_homography_beyond_nine_numbers_precision_is_invalid(far: float) -> None:
    points = np.random.default_rng(2).uniform(-1, 1, (20, 2))
    images = apply_homography(KEYSTONE_NEAR, points)[0]
    H, valid = estimation.estimate_homography(points + far, images - far)
    assert not valid
    assert np.isnan(H).all()
    assert estimation.estimate_homography(points + far, images)[1], "near one of the origins"
    assert estimation.estimate_affine(points + far, points - far)[1], "six numbers can"
