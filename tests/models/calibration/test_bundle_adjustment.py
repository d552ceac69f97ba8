"""Bundle adjustment beside OpenCV, and on corners without error."""

from itertools import pairwise

import cv2
import numpy as np
import pytest
from support.sittings import SIZE, TRUTH, photographs

from simulations.models.calibration.bundle_adjustment import (
    calibrate,
    cost_of,
    descend,
    refine,
)
from simulations.models.calibration.camera import LENSES, PINHOLE, Camera
from simulations.models.calibration.standard_errors import rms_of_each, rms_px, uncertainty
from simulations.models.calibration.views import Views
from simulations.models.calibration.zhang import closed_form
from simulations.models.distortion.lens_model import Distortion

FIXED = {
    "none": cv2.CALIB_FIX_K1 | cv2.CALIB_FIX_K2 | cv2.CALIB_FIX_K3 | cv2.CALIB_ZERO_TANGENT_DIST,
    "k1": cv2.CALIB_FIX_K2 | cv2.CALIB_FIX_K3 | cv2.CALIB_ZERO_TANGENT_DIST,
    "k1k2": cv2.CALIB_FIX_K3 | cv2.CALIB_ZERO_TANGENT_DIST,
    "p1p2": cv2.CALIB_FIX_K3,
    "k3": 0,
}
ORDER = (*PINHOLE, "k1", "k2", "p1", "p2", "k3")


def in_single_precision(views: Views) -> Views:
    """As OpenCV takes its points."""
    pixels = views.pixels.astype(np.float32).astype(float)
    return Views(views.board, pixels, views.found)


@pytest.mark.parametrize("lens", LENSES)
def test_minimum_parameters_and_standard_errors_are_those_of_opencv(lens: str) -> None:
    views = in_single_precision(photographs(10, seed=3).views(0.1))
    ours = calibrate(views, SIZE, lens)
    free = PINHOLE + LENSES[lens]
    board = [np.c_[b, np.zeros(len(b))].astype(np.float32) for b in views.board]
    found = [p.astype(np.float32) for p in views.pixels]
    rms, K, coefficients, turns, shifts, errors, _, each = cv2.calibrateCameraExtended(
        board, found, SIZE, None, None, flags=FIXED[lens], criteria=(3, 300, 1e-16)
    )
    theirs = Camera(
        K[0, 0],
        K[1, 1],
        K[0, 2],
        K[1, 2],
        Distortion(**dict(zip(ORDER[4:], coefficients.ravel(), strict=False))),
    )
    assert ours.cost <= rms * rms * views.corners * (1.0 + 1e-9)
    assert ours.camera.values(free) == pytest.approx(theirs.values(free), rel=1e-6, abs=1e-8)
    assert ours.poses.rotation_vectors == pytest.approx(np.array(turns)[..., 0], abs=1e-6)
    assert ours.poses.t == pytest.approx(np.array(shifts)[..., 0], rel=1e-6, abs=1e-6)
    our_errors = uncertainty(views, ours, free).errors
    their_errors = dict(zip(ORDER, errors.ravel(), strict=False))
    assert our_errors == pytest.approx({name: their_errors[name] for name in free}, rel=0.01)
    assert rms_of_each(views, ours) == pytest.approx(each.ravel(), rel=1e-6)


@pytest.mark.parametrize("k1", [-0.3, -0.1, 0.0, 0.2])
def test_corners_without_error_give_the_camera_back(k1: float) -> None:
    lens = Distortion(k1=k1, k2=0.05, p1=1e-3, p2=-5e-4)
    truth = photographs(6, seed=1, camera=Camera(500.0, 505.0, 330.0, 230.0, lens))
    fit = calibrate(truth.views(0.0), SIZE)
    names = PINHOLE + LENSES["k3"]
    assert rms_px(truth.views(0.0), fit) < 1e-9
    assert fit.camera.values(names) == pytest.approx(truth.camera.values(names), abs=1e-7)


def test_every_step_lowers_the_sum_and_the_last_is_the_minimum() -> None:
    views = photographs(5).views(0.1)
    free = PINHOLE + LENSES["k1k2"]
    steps = list(descend(views, *closed_form(views, SIZE), free))
    assert all(after.cost <= before.cost * (1 + 1e-12) for before, after in pairwise(steps))
    assert steps[-1].settled
    best = steps[-1]
    for name in free:
        error = uncertainty(views, best, free).errors[name]
        for sign in (-0.1, 0.1):
            moved = best.camera.changed((name,), best.camera.values((name,)) + sign * error)
            assert cost_of(views, moved, best.poses) > best.cost


def test_pictures_may_show_different_parts_of_the_board() -> None:
    views = photographs(8, seed=2).views(0.0)
    views.found[0, :20] = False
    views.found[3, 30:] = False
    pairs = [views.of(index) for index in range(len(views))]
    assert calibrate(Views.stack(pairs), SIZE).camera.fx == pytest.approx(TRUTH.fx, abs=1e-6)


def test_with_nothing_free_only_the_poses_are_fitted() -> None:
    truth = photographs(3)
    start = truth.poses.moved(np.full((3, 6), 0.02))
    fit = refine(truth.views(0.0), TRUTH, start, ())
    assert fit.camera == TRUTH
    assert fit.poses.t == pytest.approx(truth.poses.t, abs=1e-8)
