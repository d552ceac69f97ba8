"""The cheap inverses of a lens off centre err as their theory says."""

from collections.abc import Callable

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose

from simulations.models.arrays import Floats
from simulations.models.distortion.decentred_undistortion import (
    undistort_decentred_fixed_point,
    undistort_decentred_newton,
)
from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.distortion.undistortion import undistort_fixed_point, undistort_newton

LENS = Distortion(k1=-0.2, k2=0.05, p1=0.01, p2=-0.02)
IDEAL = np.random.default_rng(0).uniform(-0.6, 0.6, (20, 10, 2))
SEEN = distort(IDEAL, LENS)


@pytest.mark.parametrize("steps", [1, 3, 7])
def test_the_fixed_point_is_opencvs_step_by_step(steps: int) -> None:
    coefficients = np.array([LENS.k1, LENS.k2, LENS.p1, LENS.p2])
    until = (cv2.TERM_CRITERIA_COUNT, steps, 0.0)
    oracle = cv2.undistortPoints(SEEN.reshape(-1, 1, 2), np.eye(3), coefficients, criteria=until)
    ours = undistort_decentred_fixed_point(SEEN, LENS, steps)
    assert_allclose(ours.reshape(-1, 1, 2), oracle, atol=1e-14)


@pytest.mark.parametrize(
    ("undo", "steps"), [(undistort_decentred_fixed_point, 80), (undistort_decentred_newton, 6)]
)
def test_points_all_over_the_picture_come_back(undo: Callable[..., Floats], steps: int) -> None:
    back = undo(SEEN, LENS, steps)
    assert back.shape == IDEAL.shape
    assert_allclose(back, IDEAL, atol=1e-14)


def test_a_newton_step_squares_the_error() -> None:
    errors = [np.abs(undistort_decentred_newton(SEEN, LENS, n) - IDEAL).max() for n in (1, 2, 3)]
    ratios = np.log(errors[1:]) / np.log(errors[:-1])
    assert np.all(ratios > 1.7)


def test_newton_s_method_goes_on_from_where_it_is_started() -> None:
    start = undistort_decentred_newton(SEEN, LENS, 2)
    onwards = undistort_decentred_newton(SEEN, LENS, 1, start)
    assert_allclose(onwards, undistort_decentred_newton(SEEN, LENS, 3), atol=1e-16)
    assert_allclose(undistort_decentred_newton(SEEN, LENS, 1, IDEAL), IDEAL, atol=1e-15)


def test_on_the_axis_and_off_it_a_centred_lens_is_undone_as_one_by_its_radius_alone() -> None:
    centred = Distortion(k1=-0.2, k2=0.05)
    assert_allclose(
        undistort_decentred_fixed_point(SEEN, centred, 4), undistort_fixed_point(SEEN, centred, 4)
    )
    assert_allclose(
        undistort_decentred_newton(SEEN, centred, 4), undistort_newton(SEEN, centred, 4), atol=1e-9
    )
    assert undistort_decentred_newton([0.0, 0.0], LENS, 3).tolist() == [0.0, 0.0]
