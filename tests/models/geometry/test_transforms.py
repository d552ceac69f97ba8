"""2D transformations: how each moves points, and where the division by w fails."""

import math

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from simulations.models.geometry import preserved_properties, transforms
from simulations.models.geometry.transforms import apply_homography

RNG = np.random.default_rng(5)
TILTED = transforms.projective([1, 0, 0, 0, 1, 0, 1, 0, 1])
"""w = 1 + x: the line x = −1 goes to infinity."""
angles = st.floats(-10, 10)
offsets = st.floats(-1e3, 1e3)


def test_each_rung_moves_a_point_as_its_equation_says() -> None:
    quarter = math.pi / 2
    for H, expected in (
        (transforms.translation(3, -1), (5, 0)),
        (transforms.rigid(quarter, 3, -1), (2, 1)),
        (transforms.similarity(2, quarter, 3, -1), (1, 3)),
        (transforms.affine([[2, 1], [0, 3]], (3, -1)), (8, 2)),
        (TILTED, (2 / 3, 1 / 3)),
    ):
        image, valid = apply_homography(H, (2.0, 1.0))
        assert valid
        assert image == pytest.approx(expected)


@given(angles, offsets, offsets)
def test_rigid_motions_compose_by_adding_angles(angle: float, tx: float, ty: float) -> None:
    H = transforms.rigid(angle, tx, ty) @ transforms.rigid(0.3, 0, 0)
    assert transforms.rigid(angle + 0.3, tx, ty) == pytest.approx(H, abs=1e-12)


def test_points_are_mapped_as_by_opencv() -> None:
    H = transforms.projective([[1.1, 0.2, 30], [-0.1, 0.9, 5], [1e-3, 2e-3, 1]])
    points = RNG.uniform(0, 100, (50, 2))
    images, valid = apply_homography(H, points)
    assert valid.all()
    assert images == pytest.approx(cv2.perspectiveTransform(points[:, None], H)[:, 0])


def test_nothing_on_the_line_sent_to_infinity_has_an_image() -> None:
    images, valid = apply_homography(TILTED, [(-1 + 1e-9, 0), (-1, 0), (-1 - 1e-16, 0), (-2, 3)])
    assert valid.tolist() == [True, False, False, True]
    assert np.isnan(images[1:3]).all()
    assert images[3] == pytest.approx((2, -3))


def test_the_sign_of_w_tells_the_two_sides_of_that_line() -> None:
    points = [(0, 0), (-2, 0), (-1, 5), (-1 + 1e-13, 0), (math.inf, 0), (math.nan, 0)]
    assert transforms.sign_of_w(TILTED, points).tolist() == [1, -1, 0, 0, 0, 0]
    assert transforms.sign_of_w(-1e200 * TILTED, points).tolist() == [-1, 1, 0, 0, 0, 0]


def test_points_that_are_not_finite_are_invalid() -> None:
    _, valid = apply_homography(np.eye(3), [(math.nan, 0), (math.inf, 0), (1, 1)])
    assert valid.tolist() == [False, False, True]


def test_the_visible_side_is_that_of_the_origin() -> None:
    assert np.array_equal(transforms.projective(-TILTED), TILTED)


def test_a_homography_that_sends_the_origin_to_infinity_is_legal() -> None:
    H = transforms.projective([[1, 0, 0], [0, 0, 1], [0, -2, 0]])
    assert np.linalg.norm(H) == pytest.approx(1)
    assert apply_homography(H, [(0, 0), (0, 1)])[1].tolist() == [False, True]


@pytest.mark.parametrize("h", [np.zeros(9), [*[1.0] * 8, math.nan], [*[1.0] * 8, math.inf]])
def test_a_matrix_that_is_no_transformation_is_refused(h: ArrayLike) -> None:
    with pytest.raises(ValueError, match="legal"):
        transforms.projective(h)


@pytest.mark.parametrize("scale", [0.0, -1.0, math.nan, math.inf])
def test_a_scale_must_be_positive(scale: float) -> None:
    with pytest.raises(ValueError, match="scale"):
        transforms.similarity(scale, 0, 0, 0)


def test_the_smallest_w_that_counts_is_relative_to_its_terms() -> None:
    """At x = −1 + ε the terms are of size 1, and w = ε."""
    for far in (1.0, 1e6):
        H = np.array([[1.0, 0, 0], [0, 1, 0], [1 / far, 0, 1]])
        _, valid = apply_homography(H, [(-far * (1 - 3e-12), 0), (-far * (1 - 1e-12), 0)])
        assert valid.tolist() == [True, False]


def test_a_homography_is_scaled_to_its_last_entry_or_else_to_unit_norm() -> None:
    assert transforms.projective(2.0 * TILTED) == pytest.approx(TILTED)
    H = transforms.projective([[1, 0, 0], [0, 0, 1], [0, -2, 0]])
    assert H[2, 1] > 0
    assert pytest.approx(np.array([[-1, 0, 0], [0, 0, -1], [0, 2, 0]]) / math.sqrt(6)) == H
    small = transforms.projective([[1.0, 0, 0], [0.0, 1, 0], [1.0, 0, 1e-11]])
    assert small[2, 2] == 1
    tiny = transforms.projective([[1.0, 0, 0], [0.0, 1, 0], [-1.0, 0, 1e-13]])
    assert np.linalg.norm(tiny) == pytest.approx(1)
    assert tiny[2, 0] > 0
    flat = transforms.projective([[1, 0, 0], [0, 1, 0], [0, 0, 0]])  # its last row is zero
    assert flat == pytest.approx(np.diag([1, 1, 0]) / math.sqrt(2))


def test_a_projective_map_is_given_by_nine_entries_or_three_rows() -> None:
    assert np.array_equal(
        transforms.projective(np.arange(1.0, 10)),
        transforms.projective(np.arange(1.0, 10).reshape(3, 3)),
    )


def test_an_image_too_far_off_is_invalid_and_spoils_no_other() -> None:
    H = np.diag([1e300, 1.0, 1.0])
    images, valid = apply_homography(H, [(1e300, 0), (1e-300, 3), (math.nan, 1)])
    assert valid.tolist() == [False, True, False]
    assert images[1] == pytest.approx((1, 3))
    assert np.isnan(images[[0, 2]]).all()


def test_points_of_any_shape_are_mapped_one_by_one() -> None:
    points = RNG.uniform(0, 10, (3, 4, 2))
    images, valid = apply_homography(TILTED, points)
    assert valid.shape == (3, 4)
    for place in np.ndindex(3, 4):
        assert np.array_equal(images[place], apply_homography(TILTED, points[place])[0])


def test_an_infinite_offset_is_no_transformation() -> None:
    with pytest.raises(ValueError, match="legal: finite entries"):
        transforms.translation(math.inf, 0)


@pytest.mark.parametrize("size", [1e-200, -1e200])
def test_a_homography_of_any_size_is_the_same(size: float) -> None:
    matrix = np.array([[1.0, 2, 3], [0, 1, 4], [1, 0, 2]])
    assert transforms.projective(size * matrix) == pytest.approx(matrix / 2)


def test_huge_negative_entries_are_scaled_as_huge_positive_ones_are() -> None:
    H = np.array([[-1e300, 0, 0], [0, -1e300, 0], [-1e300, 0, -1e300]])
    image, valid = apply_homography(H, [-1e10, 5.0])
    assert valid
    assert image == pytest.approx([1e10 / (1e10 - 1), -5 / (1e10 - 1)])


def test_a_bend_is_found_on_either_side() -> None:
    """No homography bends a line; images that do are made here from an arc."""
    share = np.linspace(0, 1, 9)
    arc = np.stack([share, 0.1 * 4 * share * (1 - share)], axis=-1)
    for side in (1, -1):
        bend = preserved_properties._bend(
            (arc * [1, side])[None], np.array([[1.0, 0.0]]), np.array([1.0])
        )
        assert bend == pytest.approx(0.1)
    share = np.linspace(0, 1, 9)[:, None]
    straight, bent = share * [3.0, 0.0], arc * [2.0, 1.0]
    bend = preserved_properties._bend(
        np.array([straight, bent]), np.array([[1.0, 0], [1.0, 0]]), np.array([3.0, 2.0])
    )
    assert bend == pytest.approx(0.1 / 2)
    sampled = preserved_properties._sample(np.array([[[0.0, 0], [8, 4]]]))
    assert sampled[0].tolist() == [[i, i / 2] for i in range(9)]
