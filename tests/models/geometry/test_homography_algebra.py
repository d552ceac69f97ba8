"""Homographies: inverted, judged, and taken apart."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.geometry import homography_algebra as algebra
from simulations.models.geometry import transforms
from simulations.models.geometry.transforms import apply_homography

CORNERS = np.array([(0.0, 0.0), (640.0, 0.0), (640.0, 480.0), (0.0, 480.0)])
KEYSTONE = transforms.projective([[1.1, 0.2, 30], [-0.1, 0.9, 5], [1e-3, 2e-4, 1]])
TILT = transforms.projective([1, 0, 0, 0, 1, 0, 1, 0, 1])


@pytest.mark.parametrize(
    "H", [np.eye(3), transforms.translation(1e6, -1e6), np.diag([5e8, 5e8, 1])]
)
def test_no_harmless_transformation_looks_ill_conditioned(H: Floats) -> None:
    assert algebra.condition_number(H) < 10


def test_the_condition_number_does_not_depend_on_units() -> None:
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
def test_maps_that_squash_the_plane_are_singular_and_have_no_inverse(H: Floats) -> None:
    assert algebra.is_singular(H)
    with pytest.raises(ValueError, match="condition number"):
        algebra.invert(H)


@given(st.floats(-3, 3), st.floats(0.1, 10), st.floats(-1e3, 1e3))
def test_the_inverse_undoes_the_transformation(angle: float, scale: float, tx: float) -> None:
    H = transforms.similarity(scale, angle, tx, -tx) @ KEYSTONE
    images, valid = apply_homography(H, CORNERS)
    back, visible = apply_homography(algebra.invert(H), images)
    assert valid.all()
    assert visible.all()
    assert back == pytest.approx(CORNERS, abs=1e-6)


def test_the_inverse_of_a_mirror_keeps_its_points_visible() -> None:
    mirror = transforms.affine([[-1, 0], [0, 1]], (0, 0)) @ TILT
    images, _ = apply_homography(mirror, [(1.0, 2.0)])
    assert apply_homography(algebra.invert(mirror), images)[0] == pytest.approx(
        np.array([(1.0, 2.0)])
    )


def test_the_parts_of_a_similarity_are_its_parameters() -> None:
    parts = algebra.decompose(transforms.similarity(1.5, 0.4, 3, -1) * -2.0)
    expected = (3, -1, 0.4, 1.5, 1.5, 0.0)
    found = (parts.tx, parts.ty, parts.angle_rad, parts.scale_x, parts.scale_y, parts.shear)
    assert found == pytest.approx(expected, abs=1e-15)
    assert parts.vanishing == (0, 0)


def test_the_parts_of_a_homography_make_it_up_again() -> None:
    for H in (KEYSTONE, KEYSTONE @ np.diag([1.0, -1.0, 1.0])):
        before = H.copy()
        assert algebra.compose(algebra.decompose(H)) == pytest.approx(before, abs=1e-12)
        assert np.array_equal(H, before)


def test_a_mirror_has_a_negative_scale() -> None:
    assert algebra.decompose(np.diag([1.0, -1.0, 1.0])).scale_y == -1.0


@pytest.mark.parametrize("H", [np.diag([0.0, 1.0, 1.0]), [[1, 0, 0], [0, 0, 1], [0, 1, 0]]])
def test_what_has_no_parts_is_refused(H: ArrayLike) -> None:
    with pytest.raises(ValueError, match="h₃₃"):
        algebra.decompose(H)


def test_the_condition_number_of_a_stretch_is_what_it_is_by_hand() -> None:
    """Balanced, the stretch diag(s, 1, ·) has singular values s : 1 : √((s² + 1)/2)."""
    for stretch in (1.0, 10.0, 1e6):
        found = algebra.condition_number(np.diag([stretch, 1.0, 1.0]))
        assert found == pytest.approx(stretch, rel=1e-9)


@pytest.mark.parametrize(("squash", "singular"), [(2e12, True), (0.5e12, False)])
def test_an_inverse_is_refused_from_a_condition_of_a_million_million_on(
    squash: float, singular: bool
) -> None:
    H = np.diag([1.0, 1.0 / squash, 1.0])
    assert algebra.is_singular(H) is singular
    if not singular:
        assert algebra.invert(H) == pytest.approx(np.diag([1, squash, 1]))


@pytest.mark.parametrize("size", [1e-200, 1e200])
def test_inverting_survives_tiny_and_huge_entries(size: float) -> None:
    assert algebra.invert(KEYSTONE * size) @ (KEYSTONE * size) == pytest.approx(np.eye(3), abs=1e-9)


def test_the_parts_are_taken_off_in_the_order_that_is_stated() -> None:
    """Translation · rotation · stretch, and the vanishing terms first of all."""
    parts = algebra.Parts(3.0, -2.0, 0.5, 2.0, -0.5, 0.3, (0.01, -0.02))
    c, s = math.cos(0.5), math.sin(0.5)
    by_hand = (
        np.array([[1, 0, 3.0], [0, 1, -2], [0, 0, 1]])
        @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        @ np.array([[2.0, 2.0 * 0.3, 0], [0, -0.5, 0], [0, 0, 1]])
        @ np.array([[1.0, 0, 0], [0, 1, 0], [0.01, -0.02, 1]])
    )
    assert algebra.compose(parts) == pytest.approx(by_hand, abs=1e-15)
    found = algebra.decompose(7.0 * by_hand)
    assert (found.tx, found.ty, found.angle_rad) == pytest.approx((3, -2, 0.5))
    assert (found.scale_x, found.scale_y, found.shear) == pytest.approx((2, -0.5, 0.3))
    assert found.vanishing == pytest.approx((0.01, -0.02))


def test_the_sign_of_all_entries_does_not_matter_to_inverse_or_condition() -> None:
    assert algebra.condition_number(-np.eye(3)) == pytest.approx(1)
    assert algebra.invert(-2.0 * np.eye(3)) == pytest.approx(-0.5 * np.eye(3))
    for size in (1e-200, 1e200):
        assert algebra.invert(-size * np.eye(3)) * size == pytest.approx(-np.eye(3))


def test_one_entry_without_a_number_leaves_no_condition() -> None:
    H = np.eye(3)
    H[0, 1] = math.nan
    assert algebra.condition_number(H) == math.inf


def test_a_condition_is_told_as_long_as_a_number_has_digits_for_it() -> None:
    assert algebra.condition_number(np.diag([1.0, 1e-14, 1.0])) == pytest.approx(1e14, rel=0.1)
    assert algebra.condition_number(np.diag([1.0, 1e-17, 1.0])) == math.inf


@pytest.mark.parametrize("far", [1e74, -1e74])
def test_parts_run_from_1e_minus_75_to_1e75(far: float) -> None:
    assert algebra.decompose(transforms.translation(far, 0)).tx == far
    with pytest.raises(ValueError, match="parts from"):
        algebra.decompose(transforms.translation(100 * far, 0))
    assert algebra.decompose(transforms.translation(1e75, 0)).tx == 1e75
    for size in (1e-75, 1e-74, 1e74, 1e75):
        scaled = transforms.similarity(size, 0.0, 0.0, 0.0)
        assert algebra.decompose(scaled).scale_x == pytest.approx(size)
    with pytest.raises(ValueError, match="parts from"):
        algebra.decompose(transforms.similarity(1e-76, 0.0, 0.0, 0.0))


def test_a_map_too_small_for_an_inverse_in_numbers_is_refused() -> None:
    with pytest.raises(ValueError, match="legal: with a finite inverse"):
        algebra.invert(np.eye(3) * 5e-324)
    np.testing.assert_array_equal(algebra.invert(np.eye(3) * 1e-308), np.eye(3) * 1e308)
