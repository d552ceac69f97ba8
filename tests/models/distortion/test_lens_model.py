"""Lens distortion against OpenCV, against analysis, and against its own inverses."""

import cv2
import numpy as np
import pytest
from numpy.typing import ArrayLike

from simulations.models.distortion.kinds import classify, line_bow
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    largest_distorted_radius,
    undistort,
    undistort_clamped,
)
from simulations.models.distortion.undistortion import INVERSES

POINTS = np.random.default_rng(1).uniform(-0.7, 0.7, (200, 2))


def test_ideal_lens_returns_its_argument_even_where_squares_overflow() -> None:
    far = np.array([[1e300, -1e300], [3.0, 4.0]])
    assert distort(far, Distortion()) is far
    assert undistort(far, Distortion())[0] is far


def test_points_beyond_the_largest_image_radius_are_invalid_or_clamped() -> None:
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


@pytest.mark.parametrize("name", ["k1", "k2", "k3", "p1", "p2", "k4", "k5", "k6"])
def test_each_coefficient_alone_agrees_with_opencv_and_round_trips(name: str) -> None:
    lens = Distortion(**{name: 0.05})
    assert not lens.neutral
    assert lens.tangential == name.startswith("p")
    scene, zero = np.column_stack((POINTS, np.ones(len(POINTS)))), np.zeros(3)
    theirs, _ = cv2.projectPoints(scene, zero, zero, np.eye(3), np.array(lens.opencv))
    np.testing.assert_allclose(distort(POINTS, lens), theirs[:, 0], atol=1e-14)
    ideal, valid = undistort(distort(POINTS, lens), lens)
    assert valid.all()
    np.testing.assert_allclose(ideal, POINTS, atol=1e-12)


INF = np.inf


@pytest.mark.parametrize("beside", [[], [[0.3, 0.4]]], ids=["alone", "beside a near one"])
@pytest.mark.parametrize(
    ("lens", "point", "image"),
    [
        (Distortion(k1=0.1), [3e200, -1e200], [INF, -INF]),
        (Distortion(k1=-0.1), [-2e160, 5e160], [INF, -INF]),
        (Distortion(k1=0.1), [INF, 0.3], [INF, 0.0]),
        (Distortion(k1=0.1), [INF, -INF], [INF, -INF]),
        (Distortion(k1=-0.1), [-INF, INF], [INF, -INF]),
        (Distortion(k1=0.1), [0.0, -1e200], [0.0, -INF]),
        (Distortion(k1=0.1, p1=0.01), [0.0, 1e160], [0.0, INF]),
        # Far is what lies further out than 1e45.
        (Distortion(k1=0.1), [9.9e44, 0.0], [0.1 * 9.9e44**3, 0.0]),
        (Distortion(k1=0.1), [1.01e45, 0.0], [INF, 0.0]),
        # (1 + s/2) / (1 + s) tends to a half.
        (Distortion(k1=0.5, k4=1.0), [1e44, 0.0], [5e43, 0.0]),
        (Distortion(k1=0.5, k4=1.0), [-1e46, 1e46], [-INF, INF]),
    ],
)
def test_far_points_map_to_infinity_with_the_signs_of_their_direction(
    lens: Distortion, point: list[float], image: list[float], beside: list[list[float]]
) -> None:
    moved = distort([point, *beside], lens)
    np.testing.assert_allclose(moved[0], image, rtol=1e-12)
    np.testing.assert_array_equal(moved[1:], [distort(near, lens) for near in beside] or moved[1:])


RADII = np.stack((np.linspace(0.01, 0.9, 50), np.zeros(50)), axis=-1)


@pytest.mark.parametrize("name", ["closed-form", "checked-table", "newton-bracketed"])
def test_careful_inverses_put_points_beyond_the_fold_onto_it(name: str) -> None:
    lens = Distortion(k1=-0.5)
    inside = RADII[RADII[:, 0] < 0.8]
    seen = np.concatenate((distort(inside, lens), [[0.0, 0.6], [1.5, 0.0]]))
    fold = fold_radius(lens)
    expected = np.concatenate((inside, [[0.0, fold], [fold, 0.0]]))
    np.testing.assert_allclose(INVERSES[name](seen, lens), expected, atol=1e-12)


TURNS = Distortion(k1=-0.2, k2=0.2)
"""g = 1 − 0.2 s + 0.2 s² has its minimum at s = 1/2."""


@pytest.mark.parametrize(
    ("lens", "corner", "tolerance", "kind"),
    [
        (Distortion(), 1.0, 0.0, "none"),
        (Distortion(k1=-0.1), 1.0, 1e-4, "barrel"),
        (Distortion(k1=0.1), 1.0, 1e-4, "pincushion"),
        (Distortion(k1=-0.2, k2=0.05), 1.0, 1e-4, "barrel"),  # turns only at r = 1.41
        (TURNS, 1.0, 1e-4, "moustache"),
        (TURNS, 0.7, 1e-4, "barrel"),
        (TURNS, 0.75, 1e-4, "moustache"),
        (Distortion(k1=-0.5, k2=0.03), 4.0, 1e-4, "barrel"),  # folds at 0.83, before g turns
        # The magnification changes from 1 on the axis to 1 + k₁ at the corner.
        (Distortion(k1=0.1), 1.0, 0.099, "pincushion"),
        (Distortion(k1=0.1), 1.0, 0.101, "none"),
        (Distortion(k1=-0.1), 1.0, 0.099, "barrel"),
        (Distortion(k1=-0.1), 1.0, 0.101, "none"),
        (Distortion(k1=0.1), 0.0, 1e-3, "none"),
        (Distortion(k1=0.1), 1e45, 1e-3, "pincushion"),
    ],
)
def test_kind_follows_from_the_profile_inside_the_picture(
    lens: Distortion, corner: float, tolerance: float, kind: str
) -> None:
    assert classify(lens, corner, tolerance) == kind


SQUARE = np.array([[1.0, 1], [4, 1], [4, 5], [1, 5], [1, 1]])


@pytest.mark.parametrize(
    ("curve", "bow"),
    [
        (SQUARE, 5.0),  # a closed curve is measured from its ends
        ([SQUARE, 2 * SQUARE], [5.0, 10.0]),
        ([[3.0, 4.0], [5.0, 6.0]], 0.0),
        ([[0, 0], [1, 1], [2, 2]], 0.0),
        ([[0.0, 0], [1e3, 250.0], [2e3, 0]], 250.0),
        ([[-1e150, 0.0], [0.0, 1e150], [1e150, 0.0]], 1e150),
    ],
)
def test_bow_is_the_largest_distance_from_the_chord(curve: ArrayLike, bow: ArrayLike) -> None:
    assert line_bow(curve).tolist() == pytest.approx(bow)
