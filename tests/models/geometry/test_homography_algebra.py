"""Homographies: inverted, judged, and taken apart."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.models.arrays import Floats
from simulations.models.geometry import homography_algebra as algebra
from simulations.models.geometry import transforms
from simulations.models.geometry.transforms import apply_homography

CORNERS = np.array([(0.0, 0.0), (640.0, 0.0), (640.0, 480.0), (0.0, 480.0)])
KEYSTONE = transforms.projective([[1.1, 0.2, 30], [-0.1, 0.9, 5], [1e-3, 2e-4, 1]])


@given(st.floats(-3, 3), st.floats(0.1, 10), st.floats(-1e3, 1e3))
def test_the_inverse_undoes_the_transformation(angle: float, scale: float, tx: float) -> None:
    H = transforms.similarity(scale, angle, tx, -tx) @ KEYSTONE
    images, valid = apply_homography(H, CORNERS)
    back, visible = apply_homography(algebra.invert(H), images)
    assert valid.all()
    assert visible.all()
    assert back == pytest.approx(CORNERS, abs=1e-6)


def test_the_parts_of_a_homography_make_it_up_again() -> None:
    for H in (KEYSTONE, KEYSTONE @ np.diag([1.0, -1.0, 1.0])):
        before = H.copy()
        assert algebra.compose(algebra.decompose(H)) == pytest.approx(before, abs=1e-12)
        assert np.array_equal(H, before)


@pytest.mark.parametrize("size", [1e-75, 1e-74, 1e74, 1e75])
def test_parts_run_from_1e_minus_75_to_1e75(size: float) -> None:
    assert algebra.decompose(transforms.similarity(size, 0, 0, 0)).scale_x == pytest.approx(size)
    assert algebra.decompose(transforms.translation(-size, 0)).tx == -size


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
def test_the_condition_number_is_that_of_the_balanced_matrix(
    H: Floats, condition: float, off: float
) -> None:
    assert algebra.condition_number(H) == pytest.approx(condition, rel=off)


@pytest.mark.parametrize(
    "H",
    [
        *(np.zeros((3, 3)), np.ones((3, 3)), np.full((3, 3), math.nan)),
        *(np.diag([1.0, 0.0, 1.0]), np.diag([1.0, 1e-15, 1.0]), np.diag([1.0, 1.0, 0.0])),
        np.diag([1.0, 0.5e-12, 1.0]),
    ],
)
def test_maps_that_squash_the_plane_are_singular_and_have_no_inverse(H: Floats) -> None:
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
