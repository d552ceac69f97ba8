"""The derivatives of predicted corners, against differences."""

import numpy as np
import pytest
from support.sittings import TRUTH, photographs

from simulations.models.calibration.camera import LENSES, PINHOLE
from simulations.models.calibration.jacobian import Linearised, linearise

FREE = PINHOLE + LENSES["k3"]
STEP = 1e-6


def near(camera_step: np.ndarray, pose_step: np.ndarray) -> Linearised:
    truth = photographs(3)
    camera = TRUTH.changed(FREE, TRUTH.values(FREE) + camera_step)
    return linearise(truth.views(0.0), camera, truth.poses.moved(pose_step), FREE)


@pytest.mark.parametrize("index", range(len(FREE)))
def test_derivatives_by_the_camera(index: int) -> None:
    step = STEP * np.eye(len(FREE))[index]
    still = np.zeros((3, 6))
    change = (near(step, still).residual - near(-step, still).residual) / (2.0 * STEP)
    exact = near(0.0 * step, still).by_camera[..., index]
    assert change == pytest.approx(exact, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("index", range(6))
def test_derivatives_by_the_poses(index: int) -> None:
    step = STEP * np.broadcast_to(np.eye(6)[index], (3, 6))
    still = np.zeros(len(FREE))
    change = (near(still, step).residual - near(still, -step).residual) / (2.0 * STEP)
    exact = near(still, 0.0 * step).by_pose[..., index]
    assert change == pytest.approx(exact, rel=1e-6, abs=1e-5)


def test_a_corner_that_was_not_found_has_no_weight() -> None:
    truth = photographs(3)
    views = truth.views(0.0)
    views.found[1, 5] = False
    views.pixels[1, 5] = 0.0
    at = linearise(views, TRUTH, truth.poses, FREE)
    rows = (5, 5 + 54)
    assert not at.residual[1, rows].any()
    assert not at.by_camera[1, rows].any()
    assert not at.by_pose[1, rows].any()
