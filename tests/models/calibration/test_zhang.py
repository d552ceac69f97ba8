"""Zhang's closed form, and the photographs that do not determine a camera."""

import numpy as np
import pytest
from support.sittings import SIZE, TRUTH, photographs

from simulations.models.calibration.bundle_adjustment import calibrate
from simulations.models.calibration.camera import LENSES, PINHOLE, Camera, Poses
from simulations.models.calibration.simulated import Sitting
from simulations.models.calibration.standard_errors import uncertainty
from simulations.models.calibration.zhang import UndeterminedError, closed_form, linear_lens
from simulations.models.chequerboard.board import Board
from simulations.models.distortion.lens_model import Distortion
from simulations.models.geometry import rotations

IDEAL = Camera(600.0, 603.0, 322.0, 236.0)


def sitting_of(turns: list[tuple[float, float, float]]) -> Sitting:
    R = rotations.exponential(np.array(turns))
    t = np.array([(0.3 * i, 0.2 * i, 14.0 + i) for i in range(len(turns))]) - R @ (4.0, 2.5, 0.0)
    return Sitting(TRUTH, SIZE, Board(), Poses(R, t))


def test_perfect_corners_of_an_ideal_lens_give_camera_and_poses_exactly() -> None:
    truth = photographs(3, camera=IDEAL)
    camera, poses = closed_form(truth.views(0.0), SIZE)
    names = ("fx", "fy", "cx", "cy")
    assert camera.values(names) == pytest.approx(IDEAL.values(names), rel=1e-9)
    assert pytest.approx(truth.poses.R, abs=1e-9) == poses.R
    assert poses.t == pytest.approx(truth.poses.t, rel=1e-9)


def test_the_shift_of_corners_from_their_pinhole_places_gives_the_lens() -> None:
    lens = Distortion(k1=-0.25, k2=0.08)
    truth = photographs(4, camera=Camera(600.0, 603.0, 322.0, 236.0, lens))
    found = linear_lens(truth.views(0.0), IDEAL, truth.poses).lens
    assert (found.k1, found.k2) == pytest.approx((lens.k1, lens.k2), rel=1e-9)


@pytest.mark.parametrize("sigma_px", [0.0, 0.05, 0.5])
@pytest.mark.parametrize("lens", ["none", "k1k2", "k3"])
@pytest.mark.parametrize(
    "turns",
    [
        [(0.0, 0.0, 0.2 * i) for i in range(5)],
        [(0.0, 0.6, 0.0)] * 5,
    ],
    ids=["facing the camera", "all tilted alike"],
)
def test_parallel_boards_are_refused_with_the_advice_to_tilt(
    turns: list[tuple[float, float, float]], lens: str, sigma_px: float
) -> None:
    views = sitting_of(turns).views(sigma_px)
    with pytest.raises(UndeterminedError, match="tilt"):
        uncertainty(views, calibrate(views, SIZE, lens), PINHOLE + LENSES[lens])


def test_two_photographs_are_too_few() -> None:
    with pytest.raises(UndeterminedError, match="At least 3"):
        closed_form(photographs(2).views(0.0), SIZE)


def test_corners_on_one_line_are_refused_with_the_number_of_the_photograph() -> None:
    views = photographs(4).views(0.0)
    views.found[2, 9:] = False
    with pytest.raises(UndeterminedError, match="Photograph 3"):
        closed_form(views, SIZE)
