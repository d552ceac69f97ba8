"""Calibration of fisheye lenses of 106° to 170° against OpenCV, and the exported files."""

import json
import xml.etree.ElementTree as ET

import cv2
import numpy as np
import pytest
from support.chequerboards import BENT_SIZE as SIZE
from support.chequerboards import BOARD

from simulations.models.calibration.camera import LENSES, PINHOLE, Camera
from simulations.models.calibration.exports import (
    Report,
    as_json,
    half_side_px,
    lensfun_poly5,
    lensfun_xml,
    opencv_yaml,
)
from simulations.models.calibration.model_choice import compare, supported
from simulations.models.calibration.simulated import Sitting, sitting
from simulations.models.distortion import radial_profile
from simulations.models.distortion.fisheye import Fisheye
from simulations.models.distortion.lens_model import Distortion

FREE = PINHOLE + LENSES["fisheye"]
LENS = Fisheye(-0.01, 0.003, -0.002, 0.0002)


def fisheye_sitting(focal_px: float) -> Sitting:
    return sitting(Camera(focal_px, 1.001 * focal_px, 806.0, 595.0, LENS), SIZE, 12, BOARD, 1)


@pytest.mark.parametrize("focal_px", [470.0, 600.0, 840.0])
def test_fisheye_is_supported_and_agrees_with_truth_within_its_errors(focal_px: float) -> None:
    truth, views = fisheye_sitting(focal_px).camera, fisheye_sitting(focal_px).views(0.05, 1)
    found = supported(compare(views, SIZE))
    assert found.lens == "fisheye"
    errors = np.array([found.uncertainty.errors[name] for name in FREE])
    off = np.abs(found.fit.camera.values(FREE) - truth.values(FREE)) / errors
    assert off.max() < 3.5
    assert found.fit.camera.field_rad(SIZE[0]) == pytest.approx(truth.field_rad(SIZE[0]), abs=1e-3)
    if focal_px < 500:
        return  # OpenCV does not converge
    board = [np.c_[b, np.zeros(len(b))][None] for b in views.board]
    rms, K, lens, *_ = cv2.fisheye.calibrate(
        board,
        [seen[None] for seen in views.pixels],
        SIZE,
        np.array([[focal_px, 0, 800], [0, focal_px, 600], [0, 0, 1.0]]),
        np.zeros((4, 1)),
        flags=cv2.CALIB_RECOMPUTE_EXTRINSIC | cv2.CALIB_FIX_SKEW | cv2.CALIB_USE_INTRINSIC_GUESS,
        criteria=(3, 300, 1e-14),
    )
    theirs = np.array([K[0, 0], K[1, 1], K[0, 2], K[1, 2], *lens.ravel()])
    assert found.fit.camera.values(FREE) == pytest.approx(theirs, rel=1e-4, abs=1e-5)
    assert found.rms_px == pytest.approx(rms, rel=1e-6)


@pytest.mark.parametrize("focal_px", [640.0, 760.0, 900.0])
def test_wide_lens_of_another_kind_agrees_with_truth_within_its_errors(focal_px: float) -> None:
    """Its picture is larger at the rim than a fisheye's, and straighter than k₃ can make it."""
    lens = Distortion(k1=0.61, k2=0.05, p1=3e-4, p2=-2e-4, k4=0.86, k5=0.16, k6=2e-3)
    truth = sitting(Camera(focal_px, focal_px, 806.0, 595.0, lens), SIZE, 12, BOARD, 1)
    found = supported(compare(truth.views(0.05, 1), SIZE))
    assert found.lens == "rational"
    errors = np.array([found.uncertainty.errors[name] for name in PINHOLE])
    off = np.abs(found.fit.camera.values(PINHOLE) - truth.camera.values(PINHOLE)) / errors
    assert off.max() < 3.5


def test_pixels_round_trip_through_their_ideal_directions() -> None:
    camera = fisheye_sitting(600.0).camera
    pixels = np.random.default_rng(0).uniform((0, 0), SIZE, (500, 2))
    ideal, valid = camera.ideal(pixels)
    assert valid.mean() > 0.9
    assert camera.pixels(np.c_[ideal, np.ones(500)])[valid] == pytest.approx(pixels[valid])


def test_exported_files_have_the_fisheyes_model_and_coefficients() -> None:
    truth = fisheye_sitting(600.0)
    report = Report(
        camera=truth.camera,
        size=SIZE,
        errors={},
        rms_px=0.1,
        poses=truth.poses,
        photographs=[(str(n), 0.1) for n in range(12)],
        views=truth.views(0.05),
    )
    assert "fisheye_model: 1" in opencv_yaml(report)
    saved = json.loads(as_json(report))
    assert (saved["model"], saved["camera"]["k4"]) == ("fisheye", 0.0002)
    lens = ET.fromstring(lensfun_xml(report)).find("lens")
    assert lens is not None
    assert lens.findtext("type") == "fisheye"
    (k1, k2), unit = (lensfun_poly5(truth.camera, SIZE), half_side_px(SIZE) / truth.camera.fx)
    angle = np.linspace(0.1, 1.4, 9)
    theirs = 1 + k1 * (angle / unit) ** 2 + k2 * (angle / unit) ** 4
    assert theirs == pytest.approx(radial_profile.scale(LENS.radial, angle**2), abs=1e-3)
