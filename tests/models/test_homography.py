"""Homographies: estimated from points, inverted, judged, and taken apart."""

import math

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from skimage.transform import EuclideanTransform, SimilarityTransform

from simulations.models import homography_algebra as algebra
from simulations.models import homography_estimation as estimation
from simulations.models import transforms
from simulations.models.transforms import apply_homography

RNG = np.random.default_rng(7)
CORNERS = np.array([(0.0, 0.0), (640.0, 0.0), (640.0, 480.0), (0.0, 480.0)])
SEEN = np.array([(32.0, 15.0), (610.0, 60.0), (580.0, 500.0), (-12.0, 430.0)])
KEYSTONE = transforms.projective([[1.1, 0.2, 30], [-0.1, 0.9, 5], [1e-3, 2e-4, 1]])
TILT = transforms.projective([1, 0, 0, 0, 1, 0, 1, 0, 1])


def test_four_points_give_the_homography_of_opencv():
    H, valid = estimation.estimate_homography(CORNERS, SEEN)
    expected = cv2.getPerspectiveTransform(CORNERS.astype(np.float32), SEEN.astype(np.float32))
    assert valid
    assert pytest.approx(expected, rel=1e-6, abs=1e-9) == H
    assert apply_homography(H, CORNERS)[0] == pytest.approx(SEEN, abs=1e-9)


def test_many_exact_points_give_the_homography_back():
    points = RNG.uniform(0, 500, (40, 2))
    H, valid = estimation.estimate_homography(points, apply_homography(KEYSTONE, points)[0])
    assert valid
    assert pytest.approx(KEYSTONE, rel=1e-9, abs=1e-12) == H


@pytest.mark.parametrize("shift", [0.0, 1e6])
def test_normalising_makes_the_estimate_independent_of_the_origin(shift):
    H, valid = estimation.estimate_homography(CORNERS + shift, SEEN + shift)
    assert valid
    assert apply_homography(H, CORNERS + shift)[0] == pytest.approx(SEEN + shift, abs=1e-5, rel=0)


def test_noise_is_averaged_out():
    points = RNG.uniform(0, 500, (400, 2))
    noisy = apply_homography(KEYSTONE, points)[0] + RNG.normal(0, 0.5, (400, 2))
    H, _ = estimation.estimate_homography(points, noisy)
    error = apply_homography(H, CORNERS)[0] - apply_homography(KEYSTONE, CORNERS)[0]
    assert np.abs(error).max() < 0.5


@pytest.mark.parametrize(
    "source",
    [
        CORNERS[:3],
        np.column_stack([np.arange(5.0), 2 * np.arange(5.0)]),
        np.ones((4, 2)),
        np.array([(0, 0), (1, 0), (2, 0), (0, 1)], float),
    ],
    ids=["too few", "on one line", "coincident", "three on one line"],
)
def test_points_that_do_not_determine_a_homography_are_reported(source):
    target = SEEN[:3] if len(source) == 3 else np.vstack([SEEN, SEEN[:1] + 7])[: len(source)]
    H, valid = estimation.estimate_homography(source, target)
    assert not valid
    assert np.isnan(H).all()


def test_points_seen_from_both_sides_of_infinity_are_reported():
    source = np.array([(-3.0, 0.0), (-2.0, 1.0), (1.0, 0.0), (2.0, 1.0), (3.0, -1.0)])
    w = 1 + source[:, :1]
    assert not estimation.estimate_homography(source, source / w)[1]


def test_affine_similarity_and_rigid_maps_come_back_from_exact_points():
    points = RNG.uniform(-5, 5, (10, 2)) + 100
    for estimate, H in (
        (estimation.estimate_affine, transforms.affine([[1.2, 0.3], [-0.4, 0.8]], (3, 1))),
        (estimation.estimate_similarity, transforms.similarity(1.7, 2.5, 3, 1)),
        (estimation.estimate_rigid, transforms.rigid(-2.0, 3, 1)),
    ):
        found, valid = estimate(points, apply_homography(H, points)[0])
        assert valid
        assert pytest.approx(H, abs=1e-10) == found


def test_noisy_similarity_and_rigid_estimates_agree_with_scikit_image():
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


def test_noisy_affine_estimates_agree_with_plain_least_squares():
    points, noise = RNG.uniform(-5, 5, (30, 2)), RNG.normal(0, 0.3, (30, 2))
    target = points @ [[1.0, 0.2], [0.1, 0.9]] + noise
    expected = np.linalg.lstsq(np.column_stack([points, np.ones(30)]), target, rcond=None)[0].T
    assert estimation.estimate_affine(points, target)[0][:2] == pytest.approx(expected)


@pytest.mark.parametrize(
    ("estimate", "source"),
    [
        (estimation.estimate_affine, [(0, 0), (1, 1), (2, 2)]),
        (estimation.estimate_affine, [(0, 0), (1, 0)]),
        (estimation.estimate_similarity, [(1, 1), (1, 1)]),
        (estimation.estimate_similarity, [(1, 1)]),
        (estimation.estimate_rigid, [(3, 3), (3, 3), (3, 3)]),
    ],
)
def test_too_little_for_the_smaller_families_is_reported_too(estimate, source):
    H, valid = estimate(source, SEEN[: len(source)])
    assert not valid
    assert np.isnan(H).all()


def test_mirrored_points_with_no_best_rotation_are_reported():
    cross = np.array([(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])
    assert not estimation.estimate_rigid(cross, cross * [1, -1])[1]


@pytest.mark.parametrize(
    ("source", "target"),
    [(CORNERS, SEEN[:3]), (CORNERS[:, :1], SEEN[:, :1]), (CORNERS * math.nan, SEEN)],
)
def test_pairs_that_are_no_pairs_of_points_are_refused(source, target):
    with pytest.raises(ValueError, match="source"):
        estimation.estimate_homography(source, target)


@pytest.mark.parametrize(
    "H", [np.eye(3), transforms.translation(1e6, -1e6), np.diag([5e8, 5e8, 1])]
)
def test_no_harmless_transformation_looks_ill_conditioned(H):
    assert algebra.condition_number(H) < 10


def test_the_condition_number_does_not_depend_on_units():
    to_mm, to_km = np.diag([1e3, 1e3, 1]), np.diag([1e-3, 1e-3, 1])
    plain = algebra.condition_number(KEYSTONE)
    assert algebra.condition_number(to_mm @ KEYSTONE @ to_km) == pytest.approx(plain, rel=1e-2)
    assert algebra.condition_number(-1e200 * KEYSTONE) == pytest.approx(plain)


@pytest.mark.parametrize(
    "H",
    [
        np.zeros((3, 3)),
        np.ones((3, 3)),
        np.diag([1.0, 0.0, 1.0]),
        np.diag([1.0, 1e-15, 1.0]),
        np.diag([1.0, 1.0, 0.0]),
        np.full((3, 3), math.nan),
    ],
)
def test_maps_that_squash_the_plane_are_singular_and_have_no_inverse(H):
    assert algebra.is_singular(H)
    with pytest.raises(ValueError, match="condition number"):
        algebra.invert(H)


@given(st.floats(-3, 3), st.floats(0.1, 10), st.floats(-1e3, 1e3))
def test_the_inverse_undoes_the_transformation(angle, scale, tx):
    H = transforms.similarity(scale, angle, tx, -tx) @ KEYSTONE
    images, valid = apply_homography(H, CORNERS)
    back, visible = apply_homography(algebra.invert(H), images)
    assert valid.all()
    assert visible.all()
    assert back == pytest.approx(CORNERS, abs=1e-6)


def test_the_inverse_of_a_mirror_keeps_its_points_visible():
    mirror = transforms.affine([[-1, 0], [0, 1]], (0, 0)) @ TILT
    images, _ = apply_homography(mirror, [(1.0, 2.0)])
    assert apply_homography(algebra.invert(mirror), images)[0] == pytest.approx(
        np.array([(1.0, 2.0)])
    )


def test_the_parts_of_a_similarity_are_its_parameters():
    parts = algebra.decompose(transforms.similarity(1.5, 0.4, 3, -1) * -2.0)
    expected = (3, -1, 0.4, 1.5, 1.5, 0.0)
    found = (parts.tx, parts.ty, parts.angle_rad, parts.scale_x, parts.scale_y, parts.shear)
    assert found == pytest.approx(expected, abs=1e-15)
    assert parts.vanishing == (0, 0)


def test_the_parts_of_a_homography_make_it_up_again():
    for H in (KEYSTONE, KEYSTONE @ np.diag([1.0, -1.0, 1.0])):
        before = H.copy()
        assert algebra.compose(algebra.decompose(H)) == pytest.approx(before, abs=1e-12)
        assert np.array_equal(H, before)


def test_a_mirror_has_a_negative_scale():
    assert algebra.decompose(np.diag([1.0, -1.0, 1.0])).scale_y == -1.0


@pytest.mark.parametrize("H", [np.diag([0.0, 1.0, 1.0]), [[1, 0, 0], [0, 0, 1], [0, 1, 0]]])
def test_what_has_no_parts_is_refused(H):
    with pytest.raises(ValueError, match="h₃₃"):
        algebra.decompose(H)
