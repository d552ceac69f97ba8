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
CUBE = np.array(np.meshgrid(*[[0.0, 1.0]] * 3)).reshape(3, -1).T


def lengths(points: Floats) -> Floats:
    return np.linalg.norm(points[:, None] - points[None], axis=-1)


def test_a_translation_moves_and_turns_nothing() -> None:
    moved, valid = apply_transform(transforms_3d.translation([1, 2, 3]), POINTS)
    assert valid.all()
    np.testing.assert_allclose(moved - POINTS, np.tile([1.0, 2.0, 3.0], (30, 1)), rtol=1e-15)


def test_a_rigid_motion_keeps_lengths_and_a_similarity_their_ratios() -> None:
    moved, _ = apply_transform(transforms_3d.rigid(R, [1, 2, 3]), POINTS)
    np.testing.assert_allclose(moved, POINTS @ R.T + [1, 2, 3], rtol=1e-14)
    np.testing.assert_allclose(lengths(moved), lengths(POINTS), atol=1e-14)
    grown, _ = apply_transform(transforms_3d.similarity(2.5, R, [1, 2, 3]), POINTS)
    np.testing.assert_allclose(lengths(grown), 2.5 * lengths(POINTS), atol=1e-14)


def test_an_affine_map_keeps_parallels_and_ratios_of_volumes() -> None:
    A = [[1.0, 0.5, 0.0], [0.0, 2.0, 0.3], [0.1, 0.0, 0.5]]
    corners, _ = apply_transform(transforms_3d.affine(A, [5, 0, 0]), CUBE)
    box = {tuple(c): image for c, image in zip(CUBE.tolist(), corners, strict=True)}
    edge = box[1, 0, 0] - box[0, 0, 0]
    np.testing.assert_allclose(box[1, 1, 1] - box[0, 1, 1], edge, atol=1e-15)
    sides = [box[corner] - box[0, 0, 0] for corner in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    assert np.linalg.det(sides) == pytest.approx(np.linalg.det(A))


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
    images, valid = apply_transform(H, [[1.0, 2, 4], [1.0, 2, 0], [1.0, 2, -4], [np.inf, 0, 1]])
    assert valid.tolist() == [True, False, True, False]
    np.testing.assert_array_equal(images[0], [0.25, 0.5, 1.0])
    np.testing.assert_array_equal(images[2], [-0.25, -0.5, 1.0])
    assert np.isnan(images[[1, 3]]).all()


def test_w_that_is_rounding_is_no_w() -> None:
    H = np.eye(4)
    H[3] = [1e9, -1e9, 0.0, 1e-6]
    assert apply_transform(H, [[1.0, 1.0, 0.0], [1.0, 0.5, 0.0]])[1].tolist() == [False, True]


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_w_is_judged_beside_all_the_terms_that_it_is_the_sum_of(sign: float) -> None:
    """1 − (1 − 1.5e−12) is rounding beside 2, though not beside 1."""
    H = np.eye(4)
    H[3] = [sign, 0.0, 0.0, -1.0 + 1.5e-12]
    assert not apply_transform(H, [sign, 0.0, 0.0])[1]
    H[3, 3] = -1.0 + 3e-12
    assert apply_transform(H, [sign, 0.0, 0.0])[1]


def test_an_image_beyond_all_numbers_in_one_coordinate_is_invalid() -> None:
    images, valid = apply_transform(np.diag([1e200, 1.0, 1.0, 1.0]), [1e200, 1.0, 1.0])
    assert not valid
    assert np.isnan(images).all()


def test_maps_compose_as_their_matrices_do() -> None:
    one, two = transforms_3d.similarity(2.0, R, [1, 0, 0]), transforms_3d.rigid(R.T, [0, 5, 0])
    in_turn = apply_transform(two, apply_transform(one, POINTS)[0])[0]
    np.testing.assert_allclose(apply_transform(two @ one, POINTS)[0], in_turn, atol=1e-13)


def test_shapes_are_kept_and_wrong_ones_refused() -> None:
    assert apply_transform(np.eye(4), np.ones((2, 5, 3)))[0].shape == (2, 5, 3)
    assert apply_transform(np.eye(4), np.ones((0, 3)))[1].shape == (0,)
    with pytest.raises(ValueError, match=r"H of shape \(3, 3\)"):
        apply_transform(np.eye(3), POINTS)
    with pytest.raises(ValueError, match=r"points of shape \(4,\)"):
        apply_transform(np.eye(4), np.ones(4))


@pytest.mark.parametrize("scale", [0.0, -1.0, np.inf, np.nan])
def test_a_similarity_has_a_size(scale: float) -> None:
    with pytest.raises(ValueError, match=r"scale .+; legal: above 0, finite"):
        transforms_3d.similarity(scale, R, [0, 0, 0])


def test_a_mirror_is_no_rigid_motion_but_an_affine_map() -> None:
    mirror = np.diag([1.0, 1.0, -1.0])
    with pytest.raises(ValueError, match="reflection"):
        transforms_3d.rigid(mirror, [0, 0, 0])
    assert transforms_3d.affine(mirror, [0, 0, 0])[2, 2] == -1
    with pytest.raises(ValueError, match="legal: finite entries"):
        transforms_3d.affine(mirror, [np.nan, 0, 0])


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


def test_points_as_far_off_as_squares_allow_are_aligned() -> None:
    far = POINTS / np.abs(POINTS).max() * 1e100
    found, valid = estimate_similarity(far, far @ R.T * 0.5)
    assert valid
    np.testing.assert_allclose(found[:3, :3], 0.5 * R, atol=1e-14)


@pytest.mark.parametrize(("small", "large"), [(1e-200, 1.0), (1e-300, 1e-300), (1e-100, 1e99)])
def test_points_whose_squares_vanish_are_aligned(small: float, large: float) -> None:
    found, valid = estimate_similarity(POINTS * small, POINTS @ R.T * large)
    assert valid
    np.testing.assert_allclose(found[:3, :3] / (large / small), R, atol=1e-12)


def test_a_scale_beyond_all_numbers_is_told() -> None:
    found, valid = estimate_similarity(POINTS * 1e-300, POINTS * 1e50)
    assert not valid
    assert np.isnan(found).all()


@pytest.mark.parametrize("wrong", [2.0, [1.0, 2.0, 3.0], np.eye(2), np.ones((2, 3, 3))])
def test_nothing_is_stretched_to_a_matrix(wrong: ArrayLike) -> None:
    with pytest.raises(ValueError, match=r"^matrix of shape .+; legal: \(3, 3\)"):
        transforms_3d.affine(wrong, [0.0, 0.0, 0.0])
    with pytest.raises(ValueError, match=r"^R of shape .+; legal: \(3, 3\)"):
        transforms_3d.rigid(wrong, [0.0, 0.0, 0.0])
    with pytest.raises(ValueError, match=r"^offset of shape .+; legal: \(3,\)"):
        transforms_3d.translation(np.ones((1, 3)) * np.ravel(wrong)[0])


@pytest.mark.parametrize(
    "points", [POINTS[:2], POINTS[0], POINTS * np.nan, -np.abs(POINTS) * 1e101]
)
def test_too_few_or_endless_points_are_refused(points: Floats) -> None:
    with pytest.raises(ValueError, match=r"source of shape .+; legal: \(N, 3\)"):
        estimate_similarity(points, points)
    with pytest.raises(ValueError, match="legal: equal"):
        estimate_similarity(POINTS, POINTS[:5])
