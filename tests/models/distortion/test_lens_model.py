"""Lens distortion against OpenCV, against analysis, and against its own inverse."""

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simulations.models.arrays import Floats
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    jacobian,
    largest_distorted_radius,
    undistort,
    undistort_clamped,
)

FOCAL_PX = 1000.0
POINTS = np.random.default_rng(1).uniform(-0.7, 0.7, (200, 2))
LENSES = [
    Distortion(k1=-0.3, k2=0.1),
    Distortion(k1=0.2, k2=-0.05, k3=0.01),
    Distortion(k1=-0.25, p1=0.004, p2=-0.006),
    Distortion(k1=0.1, k2=0.02, k3=0.01, p1=0.001, p2=0.002, k4=0.3, k5=0.05, k6=0.01),
]
radial_coefficient = st.floats(-2.0, 2.0)


def opencv_distort(xy: Floats, lens: Distortion) -> Floats:
    scene = np.column_stack((xy, np.ones(len(xy))))
    zero = np.zeros(3)
    image, _ = cv2.projectPoints(scene, zero, zero, np.eye(3), np.array(lens.opencv))
    return image[:, 0]


@pytest.mark.parametrize("lens", LENSES)
def test_distorting_agrees_with_opencv(lens: Distortion) -> None:
    np.testing.assert_allclose(distort(POINTS, lens), opencv_distort(POINTS, lens), atol=1e-14)


@pytest.mark.parametrize("lens", LENSES)
def test_undistorting_agrees_with_opencv(lens: Distortion) -> None:
    seen = distort(POINTS, lens)
    criteria = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 1000, 1e-14)
    expected = cv2.undistortPoints(
        seen[:, None], np.eye(3), np.array(lens.opencv), criteria=criteria
    )[:, 0]
    ideal, valid = undistort(seen, lens)
    assert valid.all()
    np.testing.assert_allclose(ideal, expected, atol=1e-9)


def test_an_ideal_lens_returns_the_very_array_even_where_squares_overflow() -> None:
    far = np.array([[1e300, -1e300], [3.0, 4.0]])
    assert distort(far, Distortion()) is far
    assert undistort(far, Distortion())[0] is far


@pytest.mark.parametrize("k1", [-0.5, -0.1, -1e-6])
def test_with_k1_alone_the_fold_and_its_image_are_known(k1: float) -> None:
    fold = np.sqrt(-1.0 / (3.0 * k1))
    assert fold_radius(Distortion(k1=k1)) == pytest.approx(fold, rel=1e-12)
    assert largest_distorted_radius(Distortion(k1=k1)) == pytest.approx(2 * fold / 3, rel=1e-12)


def test_a_vanishing_highest_coefficient_does_not_disturb_the_fold() -> None:
    assert fold_radius(Distortion(k1=-0.3, k3=1e-320)) == pytest.approx(np.sqrt(1 / 0.9))


def test_a_pole_of_the_rational_model_ends_the_lens() -> None:
    lens = Distortion(k4=-0.25)  # 1 − r²/4 vanishes at r = 2
    assert fold_radius(lens) == pytest.approx(2.0)
    ideal, valid = undistort([100.0, 0.0], lens)
    assert valid
    np.testing.assert_allclose(distort(ideal, lens), [100.0, 0.0], rtol=1e-9)


@given(radial_coefficient, radial_coefficient, radial_coefficient)
@settings(max_examples=80, deadline=None)
def test_the_radial_map_rises_up_to_the_fold_and_not_beyond(
    k1: float, k2: float, k3: float
) -> None:
    lens = Distortion(k1=k1, k2=k2, k3=k3)
    fold = fold_radius(lens)
    radius = np.linspace(0.0, min(fold, 10.0), 400)
    image = distort(np.column_stack((radius, 0 * radius)), lens)[:, 0]
    assert np.all(np.diff(image) > -1e-9 * (1 + np.abs(image[1:])))


@given(radial_coefficient, radial_coefficient, radial_coefficient)
@settings(max_examples=80, deadline=None)
def test_the_inverse_is_exact_within_99_percent_of_the_fold(
    k1: float, k2: float, k3: float
) -> None:
    lens = Distortion(k1=k1, k2=k2, k3=k3)
    radius = np.linspace(0.0, 0.99 * min(fold_radius(lens), 2.0), 101)
    ideal = radius[:, None] * [np.cos(0.7), np.sin(0.7)]
    back, valid = undistort(distort(ideal, lens), lens)
    assert valid.all()
    # Where the slope is s, a rounding error of the image comes back divided by s.
    slope = np.linalg.det(jacobian(ideal, lens)) ** 0.5
    error_px = FOCAL_PX * np.abs(back - ideal).max(axis=-1)
    assert np.all(error_px <= 1e-6 / np.minimum(slope**2, 1.0))


@pytest.mark.parametrize("k1", [-0.3, 0.5, 3.0])
def test_the_inverse_is_good_to_a_millionth_of_a_pixel(k1: float) -> None:
    lens = Distortion(k1=k1)
    radius = np.linspace(0.0, 0.99 * min(fold_radius(lens), 3.0), 1001)
    ideal = np.column_stack((radius, np.zeros_like(radius)))
    back, valid = undistort(distort(ideal, lens), lens)
    assert valid.all()
    assert FOCAL_PX * np.abs(back - ideal).max() <= 1e-6


def test_beyond_the_largest_image_radius_nothing_is_valid_and_only_the_border_is_finite() -> None:
    lens = Distortion(k1=-0.3)
    limit = largest_distorted_radius(lens)
    seen = [[0.999 * limit, 0], [1.001 * limit, 0], [np.nan, 0], [9e9, 0]]
    ideal, valid = undistort(seen, lens)
    np.testing.assert_array_equal(valid, [True, False, False, False])
    assert np.isnan(ideal[1:]).all()
    border, alike = undistort_clamped(seen, lens)
    np.testing.assert_array_equal(alike, valid)
    np.testing.assert_array_equal(border[0], ideal[0])
    fold = fold_radius(lens)
    np.testing.assert_allclose(border[1:], [[fold, 0.0], [0.0, 0.0], [fold, 0.0]], rtol=1e-12)


def test_tangential_distortion_beyond_its_own_fold_is_refused() -> None:
    lens = Distortion(p2=0.1)  # x + 0.3 x² on the axis turns back at x = −1/0.6
    _, valid = undistort([[-0.83, 0.0], [-0.84, 0.0]], lens)
    np.testing.assert_array_equal(valid, [True, False])


def test_the_jacobian_agrees_with_differences() -> None:
    lens, step = LENSES[3], 1e-6
    for axis in (0, 1):
        shift = step * np.eye(2)[axis]
        slope = (distort(POINTS + shift, lens) - distort(POINTS - shift, lens)) / (2 * step)
        np.testing.assert_allclose(jacobian(POINTS, lens)[..., axis], slope, atol=1e-8)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -1.001e9])
def test_coefficients_must_be_finite_and_a_billion_at_most(bad: float) -> None:
    assert Distortion(k1=1e9, p2=-1e9).k1 == 1e9
    with pytest.raises(ValueError, match="legal: finite, at most 1e"):
        Distortion(k1=bad)


@pytest.mark.parametrize("name", ["k1", "k2", "k3", "p1", "p2", "k4", "k5", "k6"])
def test_each_coefficient_stands_where_opencv_has_it_and_alone_is_not_neutral(name: str) -> None:
    lens = Distortion(**{name: 0.05})
    assert not lens.neutral
    assert lens.tangential == name.startswith("p")
    np.testing.assert_allclose(distort(POINTS, lens), opencv_distort(POINTS, lens), atol=1e-14)
    ideal, valid = undistort(distort(POINTS, lens), lens)
    assert valid.all()
    np.testing.assert_allclose(ideal, POINTS, atol=1e-12)


def test_a_lens_with_coefficients_undoes_single_points_and_fields_of_them() -> None:
    lens = LENSES[2]
    field = distort(POINTS.reshape(10, 20, 2), lens)
    ideal, valid = undistort(field, lens)
    assert valid.shape == (10, 20)
    np.testing.assert_allclose(ideal, POINTS.reshape(10, 20, 2), atol=1e-12)
    np.testing.assert_allclose(undistort(field[3, 4], lens)[0], ideal[3, 4], atol=1e-12)


def test_the_axis_is_undone_and_bad_points_spoil_no_others() -> None:
    points = [[0.0, 0.0], [np.nan, 0.1], [0.1, np.inf], [0.1, 0.0]]
    for lens in (Distortion(), Distortion(k1=-0.1), Distortion(k1=0.1, p1=0.01)):
        ideal, valid = undistort(points, lens)
        assert valid.tolist() == [True, False, False, True]
        np.testing.assert_allclose(ideal[0], 0, atol=1e-15)
        assert np.isnan(ideal[1:3]).all()
        assert ideal[3, 0] == pytest.approx(0.1, rel=0.05)


def test_far_points_go_to_infinity_each_with_the_signs_of_its_direction() -> None:
    far = np.array([[3e200, -1e200], [-2e160, 5e160], [0.3, 0.4]])
    for k1 in (0.1, -0.1):
        moved = distort(far, Distortion(k1=k1))
        np.testing.assert_array_equal(moved[:2], np.sign(k1) * np.inf * np.sign(far[:2]))
        np.testing.assert_allclose(moved[2], far[2] * (1 + k1 * 0.25))


def test_points_further_out_than_1e45_are_far_and_no_others() -> None:
    near, far = distort([[9.9e44, 0.0], [1.01e45, 0.0]], Distortion(k1=0.1))
    assert near[0] == pytest.approx(0.1 * 9.9e44**3)
    assert far[0] == np.inf


def test_a_lens_that_halves_the_furthest_radii_sends_far_points_to_infinity_too() -> None:
    """(1 + s/2) / (1 + s) tends to a half."""
    moved = distort([[1e44, 0.0], [-1e46, 1e46]], Distortion(k1=0.5, k4=1.0))
    np.testing.assert_allclose(moved, [[5e43, 0.0], [-np.inf, np.inf]])


@pytest.mark.parametrize("k1", [0.1, -0.1])
def test_points_at_infinity_stay_there_with_the_signs_of_the_lens(k1: float) -> None:
    endless = np.array([[np.inf, 1.0], [-np.inf, np.inf]])
    moved = distort(endless, Distortion(k1=k1))
    np.testing.assert_array_equal(moved, np.sign(k1) * np.array([[np.inf, 0], [-np.inf, np.inf]]))


def test_stacks_of_far_points_are_moved_as_each_alone() -> None:
    far = np.array([[[1e200, -1e100], [0.3, 0.4]], [[-1e100, 1e200], [0.0, 1e160]]])
    lens = Distortion(k1=0.1, p1=0.01)
    moved = distort(far, lens)
    for index in np.ndindex(2, 2):
        np.testing.assert_array_equal(moved[index], distort(far[index], lens))


@pytest.mark.parametrize("axis", [0, 1])
def test_a_far_point_on_an_axis_stays_on_it_beside_near_ones(axis: int) -> None:
    far = np.zeros(2)
    far[axis] = -1e200
    moved = distort(np.array([far, [0.3, 0.4]]), Distortion(k1=0.1))
    assert moved[0, axis] == -np.inf
    assert moved[0, 1 - axis] == 0
    np.testing.assert_allclose(moved[1], [0.3 * 1.025, 0.4 * 1.025])
