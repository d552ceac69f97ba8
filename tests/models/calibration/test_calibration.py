"""Calibration against OpenCV, on perfect corners, and its derivatives."""

import cv2
import numpy as np
import pytest
from support.chequerboards import SIZE, TRUTH, calibrate, photographs

from simulations.models.calibration.bundle_adjustment import Linearised, linearise
from simulations.models.calibration.camera import LENSES, PINHOLE, Camera, Poses
from simulations.models.calibration.simulated import Sitting
from simulations.models.calibration.standard_errors import rms_of_each, uncertainty
from simulations.models.calibration.views import Views
from simulations.models.calibration.zhang import UndeterminedError, closed_form, linear_lens
from simulations.models.chequerboard.board import Board
from simulations.models.distortion.fisheye import Fisheye
from simulations.models.distortion.lens_model import Distortion
from simulations.models.geometry import rotations

FIXED = {
    "none": cv2.CALIB_FIX_K1 | cv2.CALIB_FIX_K2 | cv2.CALIB_FIX_K3 | cv2.CALIB_ZERO_TANGENT_DIST,
    "k1": cv2.CALIB_FIX_K2 | cv2.CALIB_FIX_K3 | cv2.CALIB_ZERO_TANGENT_DIST,
    "k1k2": cv2.CALIB_FIX_K3 | cv2.CALIB_ZERO_TANGENT_DIST,
    "p1p2": cv2.CALIB_FIX_K3,
    "k3": 0,
}

ORDER = (*PINHOLE, "k1", "k2", "p1", "p2", "k3")


def in_single_precision(views: Views) -> Views:
    """Views in the precision of OpenCV’s points."""
    pixels = views.pixels.astype(np.float32).astype(float)
    return Views(views.board, pixels, views.found)


@pytest.mark.parametrize("lens", FIXED)
def test_minimum_and_standard_errors_agree_with_opencv(lens: str) -> None:
    views = in_single_precision(photographs(10, seed=3).views(0.1))
    ours = calibrate(views, lens)
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
    formula = np.sqrt(np.diag(uncertainty(views, ours, free).covariance))
    their_errors = dict(zip(ORDER, errors.ravel(), strict=False))
    assert formula == pytest.approx([their_errors[name] for name in free], rel=0.01)
    assert rms_of_each(views, ours) == pytest.approx(each.ravel(), rel=1e-6)


IDEAL = Camera(600.0, 603.0, 322.0, 236.0)


def sitting_of(turns: list[tuple[float, float, float]]) -> Sitting:
    R = rotations.exponential(np.array(turns))
    t = np.array([(0.3 * i, 0.2 * i, 14.0 + i) for i in range(len(turns))]) - R @ (4.0, 2.5, 0.0)
    return Sitting(TRUTH, SIZE, Board(), Poses(R, t))


def test_perfect_corners_of_an_ideal_lens_give_exact_camera_and_poses() -> None:
    truth = photographs(3, camera=IDEAL)
    camera, poses = closed_form(truth.views(0.0), SIZE)
    names = ("fx", "fy", "cx", "cy")
    assert camera.values(names) == pytest.approx(IDEAL.values(names), rel=1e-9)
    assert pytest.approx(truth.poses.R, abs=1e-9) == poses.R
    assert poses.t == pytest.approx(truth.poses.t, rel=1e-9)


def test_shift_of_corners_from_their_pinhole_images_gives_the_lens() -> None:
    lens = Distortion(k1=-0.25, k2=0.08)
    truth = photographs(4, camera=Camera(600.0, 603.0, 322.0, 236.0, lens))
    found = linear_lens(truth.views(0.0), IDEAL, truth.poses).lens
    assert (found.k1, found.k2) == pytest.approx((lens.k1, lens.k2), rel=1e-9)


@pytest.mark.parametrize("sigma_px", [0.0, 0.5])
@pytest.mark.parametrize("lens", ["none", "k3"])
@pytest.mark.parametrize(
    "turns",
    [[(0.0, 0.0, 0.2 * i) for i in range(5)], [(0.0, 0.6, 0.0)] * 5],
    ids=["facing the camera", "all tilted alike"],
)
def test_parallel_boards_are_refused_with_the_advice_to_tilt(
    turns: list[tuple[float, float, float]], lens: str, sigma_px: float
) -> None:
    views = sitting_of(turns).views(sigma_px)
    with pytest.raises(UndeterminedError, match="tilt"):
        uncertainty(views, calibrate(views, lens), PINHOLE + LENSES[lens])


def test_two_photographs_are_refused_as_too_few() -> None:
    with pytest.raises(UndeterminedError, match="At least 3"):
        closed_form(photographs(2).views(0.0), SIZE)


def test_corners_on_one_line_are_refused_with_the_number_of_the_photograph() -> None:
    views = photographs(4).views(0.0)
    views.found[2, 9:] = False
    with pytest.raises(UndeterminedError, match="Photograph 3"):
        closed_form(views, SIZE)


CAMERAS = {
    "k3": TRUTH,
    "rational": Camera(
        600.0, 603.0, 322.0, 236.0, Distortion(k1=-0.25, k2=0.08, p1=6e-4, k4=0.2, k5=-0.1, k6=0.05)
    ),
    "fisheye": Camera(300.0, 303.0, 322.0, 236.0, Fisheye(-0.01, 0.003, -0.002, 0.0002)),
}
STEP = 1e-6


def near(lens: str, camera_step: np.ndarray, pose_step: np.ndarray) -> Linearised:
    free, true = PINHOLE + LENSES[lens], CAMERAS[lens]
    truth = photographs(3, camera=true)
    camera = true.changed(free, true.values(free) + camera_step)
    return linearise(truth.views(0.0), camera, truth.poses.moved(pose_step), free)


@pytest.mark.parametrize(
    ("lens", "index"),
    [(lens, index) for lens in CAMERAS for index in range(len(LENSES[lens]) + 10)],
)
def test_derivatives_agree_with_differences_of_residuals(lens: str, index: int) -> None:
    """Derivatives by the parameters of the camera, then by the six parameters of each pose."""
    count = len(PINHOLE + LENSES[lens])
    step = STEP * np.eye(count + 6)[index]
    camera, pose = step[:count], np.broadcast_to(step[count:], (3, 6))
    ahead, back = near(lens, camera, pose), near(lens, -camera, -pose)
    change = (ahead.residual - back.residual) / (2.0 * STEP)
    here = near(lens, 0.0 * camera, 0.0 * pose)
    exact = (here.by_camera if index < count else here.by_pose)[..., index % count]
    assert change == pytest.approx(exact, rel=1e-6, abs=1e-5)
