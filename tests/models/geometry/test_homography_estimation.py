"""Transformations estimated from pairs of points: homographies and the simpler families."""

import math
import tracemalloc
from collections.abc import Callable

import cv2
import numpy as np
import pytest
from numpy.typing import ArrayLike
from skimage.transform import EuclideanTransform, SimilarityTransform

from simulations.models.arrays import Floats
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


def test_many_exact_points_give_the_homography_back() -> None:
    points = RNG.uniform(0, 500, (40, 2))
    H, valid = estimation.estimate_homography(points, apply_homography(KEYSTONE, points)[0])
    assert valid
    assert pytest.approx(KEYSTONE, rel=1e-9, abs=1e-12) == H


@pytest.mark.parametrize("shift", [0.0, 1e6])
def test_normalising_makes_the_estimate_independent_of_the_origin(shift: float) -> None:
    H, valid = estimation.estimate_homography(CORNERS + shift, SEEN + shift)
    assert valid
    assert apply_homography(H, CORNERS + shift)[0] == pytest.approx(SEEN + shift, abs=1e-5, rel=0)


def test_noise_is_averaged_out() -> None:
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
def test_points_that_do_not_determine_a_homography_are_reported(source: Floats) -> None:
    target = SEEN[:3] if len(source) == 3 else np.vstack([SEEN, SEEN[:1] + 7])[: len(source)]
    H, valid = estimation.estimate_homography(source, target)
    assert not valid
    assert np.isnan(H).all()


@pytest.mark.parametrize(
    ("source", "target"),
    [
        ([(0, 0), (1, 0), (2, 0), (0, 1)], [(0, 0), (1, 0), (2, 0), (0, 1)]),
        ([(0, 0), (1, 0), (2, 1), (0, 1), (3, 5)], [(0, 0), (1, 0), (2, 0), (0, 0), (3, 0)]),
    ],
    ids=["many maps keep a line and a point", "the only map squashes the plane"],
)
def test_points_that_many_maps_or_only_a_singular_one_would_fit_are_reported(
    source: list[tuple[int, int]], target: list[tuple[int, int]]
) -> None:
    assert not estimation.estimate_homography(np.array(source, float), np.array(target, float))[1]


@pytest.mark.parametrize(
    ("before", "after"), [(1e-9, 1e9), (1e9, 1e-9), (1e-90, 1e-90), (1e90, 1e90)]
)
def test_source_and_target_may_be_in_any_units(before: float, after: float) -> None:
    source, target = CORNERS * before, SEEN * after
    H, valid = estimation.estimate_homography(source, target)
    assert valid
    assert apply_homography(H, source)[0] / after == pytest.approx(SEEN, rel=1e-9)


def test_a_long_way_off_the_last_entry_is_still_one() -> None:
    H, _ = estimation.estimate_homography(CORNERS, CORNERS + 1e7)
    assert H[2, 2] == 1


def test_points_seen_from_both_sides_of_infinity_are_reported() -> None:
    source = np.array([(-3.0, 0.0), (-2.0, 1.0), (1.0, 0.0), (2.0, 1.0), (3.0, -1.0)])
    w = 1 + source[:, :1]
    assert not estimation.estimate_homography(source, source / w)[1]


def test_affine_similarity_and_rigid_maps_come_back_from_exact_points() -> None:
    points = RNG.uniform(-5, 5, (10, 2)) + 100
    for estimate, H in (
        (estimation.estimate_affine, transforms.affine([[1.2, 0.3], [-0.4, 0.8]], (3, 1))),
        (estimation.estimate_similarity, transforms.similarity(1.7, 2.5, 3, 1)),
        (estimation.estimate_rigid, transforms.rigid(-2.0, 3, 1)),
    ):
        found, valid = estimate(points, apply_homography(H, points)[0])
        assert valid
        assert pytest.approx(H, abs=1e-10) == found


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
def test_too_little_for_the_smaller_families_is_reported_too(
    estimate: Callable[[ArrayLike, ArrayLike], tuple[Floats, bool]],
    source: list[tuple[int, int]],
) -> None:
    H, valid = estimate(source, SEEN[: len(source)])
    assert not valid
    assert np.isnan(H).all()


def test_mirrored_points_with_no_best_rotation_are_reported() -> None:
    cross = np.array([(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])
    assert not estimation.estimate_rigid(cross, cross * [1, -1])[1]


@pytest.mark.parametrize(
    ("source", "target"),
    [(CORNERS, SEEN[:3]), (CORNERS[:, :1], SEEN[:, :1]), (CORNERS * math.nan, SEEN)],
)
def test_pairs_that_are_no_pairs_of_points_are_refused(source: Floats, target: Floats) -> None:
    with pytest.raises(ValueError, match="source"):
        estimation.estimate_homography(source, target)


def test_normalised_points_have_their_centroid_at_zero_and_a_mean_distance_of_root_two() -> None:
    points = RNG.uniform(0, 500, (30, 2)) + np.array([1e4, 0])
    T = estimation.normalisation(points)
    assert T is not None
    moved = apply_homography(T, points)[0]
    assert moved.mean(axis=0) == pytest.approx((0, 0), abs=1e-12)
    assert np.hypot(*moved.T).mean() == pytest.approx(math.sqrt(2))
    assert T[0, 1] == 0
    assert T[0, 0] == T[1, 1] > 0


@pytest.mark.parametrize(("apart", "usable"), [(1e-10, True), (1e-13, False)])
def test_points_coincide_where_only_rounding_parts_them(apart: float, usable: bool) -> None:
    points = np.array([(1.0, 1.0), (1.0 + apart, 1.0)])
    assert (estimation.normalisation(points) is not None) is usable
    far = np.array([(1e6, 1.0), (1e6 + 1e-7, 1.0)])
    assert estimation.normalisation(far) is None
    assert estimation.normalisation(-far) is None
    assert estimation.normalisation(np.array([(0.0, 0), (1e-110, 0)])) is None
    assert estimation.normalisation(np.array([(0.0, 0), (1e-98, 0)])) is not None


@pytest.mark.parametrize("far", [1e5, 1e6, 3e6])
def test_far_from_both_origins_four_points_meet_as_nearly_as_is_promised(far: float) -> None:
    for _ in range(20):
        target = SEEN + RNG.uniform(-20, 20, (4, 2))
        H, valid = estimation.estimate_homography(CORNERS + far, target + far)
        assert valid
        T, U = (estimation.normalisation(points + far) for points in (CORNERS, target))
        assert T is not None
        assert U is not None
        share = 2.2e-16 * (1 + np.hypot(*T[:2, 2])) * (1 + np.hypot(*U[:2, 2]))
        off = np.abs(apply_homography(H, CORNERS + far)[0] - (target + far)).max()
        assert off < share * math.sqrt(2) / U[0, 0]


def test_many_points_need_no_more_room_than_their_equations() -> None:
    """Two thousand: the unused left half of the decomposition would take 128 MB."""
    points = RNG.uniform(0, 500, (2000, 2))
    target = apply_homography(KEYSTONE, points)[0]
    tracemalloc.start()
    H, _ = estimation.estimate_homography(points, target)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 8e6
    assert pytest.approx(KEYSTONE, rel=1e-9, abs=1e-12) == H


def test_what_is_not_determined_is_three_by_three_of_nothing() -> None:
    H, valid = estimation.estimate_homography(CORNERS[:3], SEEN[:3])
    assert valid is False
    assert H.shape == (3, 3)


def test_a_similarity_of_points_spread_unevenly_weighs_them_all() -> None:
    """A closed form with complex numbers: the ratio of two sums."""
    points, noise = RNG.uniform(-5, 5, (12, 2)) * [3, 1], RNG.normal(0, 0.2, (12, 2))
    target = apply_homography(transforms.similarity(0.7, -1.2, 5, 2), points)[0] + noise
    a, b = ((p - p.mean(0)) @ [1, 1j] for p in (points, target))
    ratio = (b * a.conj()).sum() / (abs(a) ** 2).sum()
    H, _ = estimation.estimate_similarity(points, target)
    assert H[0, 0] + 1j * H[1, 0] == pytest.approx(ratio)
    assert H @ [*points.mean(0), 1] == pytest.approx([*target.mean(0), 1])
    R, _ = estimation.estimate_rigid(points, target)
    assert R[0, 0] + 1j * R[1, 0] == pytest.approx(ratio / abs(ratio))


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


@pytest.mark.parametrize(("thin", "usable"), [(1e-7, True), (1e-11, False)])
def test_points_nearly_on_one_line_determine_a_plane_as_long_as_digits_last(
    thin: float, usable: bool
) -> None:
    points = np.array([(0.0, 0), (1, 0), (2, thin), (3, 0), (1.5, -thin)])
    assert estimation.estimate_affine(points, points)[1] is usable


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


@pytest.mark.parametrize("size", [1e99, 1e-90])
def test_tiny_and_huge_coordinates_are_estimated_too(size: float) -> None:
    H, valid = estimation.estimate_similarity(CORNERS / 640 * size, CORNERS / 640 * size)
    assert valid
    assert pytest.approx(np.eye(3), abs=size * 1e-9) == H


@pytest.mark.parametrize("bad", [1.1e100, -1.1e100, math.inf])
def test_coordinates_beyond_the_range_are_refused(bad: float) -> None:
    for source, target in (
        (CORNERS + np.array([bad, 0]), SEEN),
        (CORNERS, SEEN + np.array([0, bad])),
    ):
        with pytest.raises(ValueError, match="legal: finite, at most 1e"):
            estimation.estimate_affine(source, target)


def test_the_ends_of_the_range_of_coordinates_are_legal() -> None:
    ends = np.array([(0.0, 0), (1e100, 0), (0, -1e100)])
    assert estimation.estimate_affine(ends, ends)[1]


@pytest.mark.parametrize("shape", [(0, 2), (4, 3), (2,), (1, 4, 2)])
def test_pairs_have_two_columns_and_one_row_at_least(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"legal: both \(N, 2\)"):
        estimation.estimate_rigid(np.ones(shape), np.ones(shape))


KEYSTONE_NEAR = np.array([[1.1, 0.1, 0.0], [-0.2, 0.9, 0.0], [0.1, -0.05, 1.0]])


@pytest.mark.parametrize("far", [1e3, 1e4, 2e4])
def test_far_from_both_origins_a_homography_is_as_right_as_its_entries_can_be(far: float) -> None:
    points = np.random.default_rng(2).uniform(-1, 1, (20, 2))
    images = apply_homography(KEYSTONE_NEAR, points)[0]
    H, valid = estimation.estimate_homography(points + far, images - far)
    assert valid
    assert apply_homography(H, points + far)[0] + far == pytest.approx(images, abs=4e-16 * far**2)


@pytest.mark.parametrize("far", [1e6, 1e9])
def test_what_nine_numbers_cannot_hold_is_not_called_valid(far: float) -> None:
    points = np.random.default_rng(2).uniform(-1, 1, (20, 2))
    images = apply_homography(KEYSTONE_NEAR, points)[0]
    H, valid = estimation.estimate_homography(points + far, images - far)
    assert not valid
    assert np.isnan(H).all()
    assert estimation.estimate_homography(points + far, images)[1], "near one of the origins"
    assert estimation.estimate_affine(points + far, points - far)[1], "six numbers can"


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("far_picture", [0, 1])
def test_a_homography_is_held_until_rounding_moves_images_by_a_millionth_of_their_spread(
    far_picture: int, axis: int
) -> None:
    """The spread of this square is 1: its corners are √2 from its middle, on the mean."""
    square = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    for share, held in ((0.97, True), (1.03, False)):
        pictures = [square, square.copy()]
        pictures[far_picture][:, axis] += share * 1e-6 / np.finfo(float).eps
        assert estimation.estimate_homography(*pictures)[1] is held
