"""The ladder of transformations of space, and the one that brings points nearest to others."""

import numpy as np
import pytest
from numpy.typing import ArrayLike
from skimage.transform import EuclideanTransform, SimilarityTransform

from simulations.models.arrays import Floats
from simulations.models.geometry import rotations, transforms_3d
from simulations.models.geometry.transforms_3d import apply_transform, estimate_similarity

R = rotations.exponential([0.3, -0.5, 0.8])
POINTS = np.random.default_rng(4).uniform(-2, 2, (30, 3))


A = np.array([[1.0, 0.5, 0.0], [0.0, 2.0, 0.3], [0.1, 0.0, -0.5]])


@pytest.mark.parametrize(
    ("H", "expected"),
    [
        (transforms_3d.translation([1, 2, 3]), POINTS),
        (transforms_3d.rigid(R, [1, 2, 3]), POINTS @ R.T),
        (transforms_3d.similarity(2.5, R, [1, 2, 3]), 2.5 * POINTS @ R.T),
        (transforms_3d.affine(A, [1, 2, 3]), POINTS @ A.T),
    ],
)
def test_each_rung_moves_points_as_its_equation_says(H: Floats, expected: Floats) -> None:
    moved, valid = apply_transform(H, POINTS)
    assert valid.all()
    np.testing.assert_allclose(moved, np.add(expected, [1, 2, 3]), atol=1e-13)


def test_a_projective_map_divides_and_keeps_lines_straight() -> None:
    H = np.eye(4)
    H[3] = [0.1, -0.2, 0.3, 1.0]
    line = np.array([0.2, 0.1, 0.4]) + np.linspace(0, 1, 7)[:, None] * [1.0, 0.5, -0.3]
    images, valid = apply_transform(H, line)
    assert valid.all()
    np.testing.assert_allclose(images, line / (line @ H[3, :3] + 1.0)[:, None], rtol=1e-14)
    assert np.linalg.matrix_rank(images - images[0], tol=1e-12) == 1


def test_what_is_sent_to_infinity_is_invalid() -> None:
    H = np.eye(4)
    H[3] = [0.0, 0.0, 1.0, 0.0]
    points = [[1.0, 2, 4], [1.0, 2, 0], [1.0, 2, -4], [np.inf, 0, 1], [1e200, 0, 1e-200]]
    images, valid = apply_transform(H, points)
    assert valid.tolist() == [True, False, True, False, False]
    np.testing.assert_array_equal(images[0], [0.25, 0.5, 1.0])
    np.testing.assert_array_equal(images[2], [-0.25, -0.5, 1.0])
    assert np.isnan(images[[1, 3, 4]]).all()


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_w_is_judged_beside_all_the_terms_that_it_is_the_sum_of(sign: float) -> None:
    """1 − (1 − 1.5e−12) is rounding beside 2, though not beside 1."""
    H = np.eye(4)
    H[3] = [sign, 0.0, 0.0, -1.0 + 1.5e-12]
    assert not apply_transform(H, [sign, 0.0, 0.0])[1]
    H[3, 3] = -1.0 + 3e-12
    assert apply_transform(H, [sign, 0.0, 0.0])[1]


@pytest.mark.parametrize("far", [0.0, 1e6])
def test_the_motion_that_moved_points_is_found_again(far: float) -> None:
    H = transforms_3d.similarity(0.7, R, [far, -2.0, 3.0])
    found, valid = estimate_similarity(POINTS + far, apply_transform(H, POINTS + far)[0])
    assert valid
    np.testing.assert_allclose(found[:3, :3], H[:3, :3], atol=1e-14 + 1e-15 * far)


@pytest.mark.parametrize(
    ("scaled", "oracle"), [(True, SimilarityTransform), (False, EuclideanTransform)]
)
def test_of_noisy_points_the_least_squares_are_those_of_scikit_image(
    scaled: bool, oracle: type[EuclideanTransform] | type[SimilarityTransform]
) -> None:
    rng = np.random.default_rng(1)
    for _ in range(10):
        target = rng.uniform(-1, 1, (8, 3))
        found, valid = estimate_similarity(POINTS[:8], target, scaled=scaled)
        theirs = oracle.from_estimate(POINTS[:8], target)
        assert valid
        np.testing.assert_allclose(found, theirs.params, atol=1e-12)


def test_three_points_are_enough_and_mirrored_ones_are_turned_as_near_as_can_be() -> None:
    found, valid = estimate_similarity(POINTS[:3], POINTS[:3] @ R.T)
    assert valid
    np.testing.assert_allclose(found[:3, :3], R, atol=1e-13)
    mirrored, valid = estimate_similarity(POINTS, POINTS * [1, 1, -1], scaled=False)
    assert valid
    assert np.linalg.det(mirrored[:3, :3]) == pytest.approx(1)


@pytest.mark.parametrize(
    ("source", "target"),
    [
        ([[0, 0, 0], [1, 1, 1], [2, 2, 2]], [[0, 0, 0], [1, 0, 0], [2, 0, 0]]),
        (np.ones((4, 3)), POINTS[:4]),
        (POINTS * 1e-300, POINTS * 1e50),  # a scale beyond all numbers
        ([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],) * 2,
    ],
)
def test_points_that_determine_no_rotation_are_told(source: ArrayLike, target: ArrayLike) -> None:
    target = np.array(target, float)
    if len(target) == 6:
        target = -target  # a mirror image in all directions alike
    found, valid = estimate_similarity(source, target)
    assert not valid
    assert np.isnan(found).all()
    assert found.shape == (4, 4)


@pytest.mark.parametrize(("off", "enough"), [(1e-4, True), (1e-5, False)])
def test_points_a_hair_off_a_line_determine_a_rotation(off: float, enough: bool) -> None:
    """Products of deviations count: a share of 1e−4 is one of 1e−8."""
    line = np.array([[-1.0, off, 0.0], [0.0, -2 * off, 0.0], [1.0, off, 0.0]])
    assert estimate_similarity(line, line @ R.T)[1] == enough


@pytest.mark.parametrize(
    ("small", "large"), [(1e-200, 1.0), (1e-300, 1e-300), (1e-100, 1e99), (4e99, 1e99)]
)
def test_points_whose_squares_vanish_are_aligned(small: float, large: float) -> None:
    found, valid = estimate_similarity(POINTS * small, POINTS @ R.T * large)
    assert valid
    np.testing.assert_allclose(found[:3, :3] / (large / small), R, atol=1e-12)
