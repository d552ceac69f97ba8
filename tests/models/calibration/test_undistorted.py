"""A photograph without its distortion."""

import cv2
import numpy as np
import pytest

from simulations.models.calibration.camera import Camera
from simulations.models.calibration.undistorted import UNSEEN, undistorted
from simulations.models.distortion.lens_model import Distortion

CAMERA = Camera(300.0, 302.0, 163.0, 117.0, Distortion(k1=-0.25, k2=0.08, p1=1e-3, p2=-1e-3))


def smooth_picture() -> np.ndarray:
    x, y = np.meshgrid(np.arange(320), np.arange(240))
    planes = [120 + 80 * np.sin(x / 17.0 + phase) * np.cos(y / 23.0) for phase in (0.0, 1.0, 2.0)]
    return np.stack(planes, axis=-1).astype(np.uint8)


def test_it_is_opencvs() -> None:
    codes = smooth_picture()
    expected = cv2.undistort(codes, CAMERA.matrix, np.array(CAMERA.lens.opencv[:5]))
    off = undistorted(codes, CAMERA).astype(int) - expected
    assert np.abs(off[4:-4, 4:-4]).max() <= 2  # theirs rounds places to 1/32 px


def test_bands_leave_no_seams(monkeypatch: pytest.MonkeyPatch) -> None:
    codes = smooth_picture()
    whole = undistorted(codes, CAMERA)
    monkeypatch.setattr("simulations.models.calibration.undistorted.BAND", 1000)
    assert np.array_equal(undistorted(codes, CAMERA), whole)


def test_an_ideal_lens_returns_the_photograph_itself() -> None:
    codes = smooth_picture()
    assert undistorted(codes, Camera(300.0, 300.0, 160.0, 120.0)) is codes


def test_what_the_photograph_does_not_show_is_grey() -> None:
    pincushion = Camera(300.0, 300.0, 159.5, 119.5, Distortion(k1=0.3))
    folded = Camera(100.0, 100.0, 159.5, 119.5, Distortion(k1=-0.3))
    assert (undistorted(smooth_picture(), pincushion)[0, 0] == UNSEEN).all()
    assert (undistorted(smooth_picture(), folded)[0, 0] == UNSEEN).all()


@pytest.mark.parametrize("shape", [(1, 1, 3), (1, 7, 3), (7, 1, 1)])
def test_tiny_pictures(shape: tuple[int, int, int]) -> None:
    camera = Camera(5.0, 5.0, 0.0, 0.0, Distortion(k1=0.01))
    codes = np.full(shape, 77, np.uint8)
    assert undistorted(codes, camera).shape == shape
