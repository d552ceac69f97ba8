"""Files of a calibration read back, and photographs freed of their distortion."""

import json
import xml.etree.ElementTree as ET
from pathlib import Path

import cv2
import numpy as np
import pytest
from support.chequerboards import SIZE, TRUTH, photographs

from simulations.models.calibration.camera import Camera
from simulations.models.calibration.exports import (
    Maker,
    Report,
    as_json,
    colmap_text,
    lensfun_xml,
    opencv_yaml,
    ros_yaml,
)
from simulations.models.calibration.undistorted import UNSEEN, undistorted
from simulations.models.distortion.fisheye import Fisheye
from simulations.models.distortion.lens_model import Distortion

POSES, VIEWS = photographs(3).poses, photographs(3).views(0.05)
PHOTOGRAPHS = (("a.jpg", 0.1), ("b.jpg", 0.2), ("c & d.jpg", 0.1))
RADIAL = Camera(600.0, 600.0, 322.0, 236.0, Distortion(k1=-0.25, k2=0.08))


def report(camera: Camera = TRUTH) -> Report:
    return Report(
        camera=camera,
        size=SIZE,
        errors={"fx": 0.2},
        rms_px=0.1,
        poses=POSES,
        photographs=PHOTOGRAPHS,
        views=VIEWS,
    )


def test_opencv_reads_the_exported_yaml(tmp_path: Path) -> None:
    path = tmp_path / "camera.yaml"
    path.write_text(opencv_yaml(report()), "utf-8")
    file = cv2.FileStorage(str(path), cv2.FILE_STORAGE_READ)
    assert (file.getNode("image_width").real(), file.getNode("image_height").real()) == SIZE
    assert np.array_equal(file.getNode("camera_matrix").mat(), TRUTH.matrix)
    lens = file.getNode("distortion_coefficients").mat()
    assert lens.tolist() == [[-0.25, 0.08, 6e-4, -4e-4, 0.0]]
    poses = file.getNode("extrinsic_parameters").mat()
    assert poses[:, 3:] == pytest.approx(POSES.t)
    corner = np.array([[8.0, 5.0, 0.0]])
    seen, _ = cv2.projectPoints(corner, poses[0, :3], poses[0, 3:], TRUTH.matrix, lens)
    assert seen.ravel() == pytest.approx(photographs(1).pixels[0, -1])


def test_json_has_camera_errors_and_poses() -> None:
    read = json.loads(as_json(report()))
    assert read["camera"] | {"k3": 0.0} == read["camera"]
    assert read["camera"]["fx"] == 600.0
    assert read["standard_errors"] == {"fx": 0.2}
    assert [entry["name"] for entry in read["photographs"]] == ["a.jpg", "b.jpg", "c & d.jpg"]
    assert read["photographs"][1]["rms_px"] == 0.2
    corners = [entry["corners"] for entry in read["photographs"]]
    assert np.array_equal(corners, np.concatenate((VIEWS.board, VIEWS.pixels), axis=-1))


def test_ros_and_colmap_have_the_same_camera() -> None:
    """COLMAP centres the first pixel at (0.5, 0.5)."""
    rich = Camera(600.0, 603.0, 322.0, 236.0, Distortion(k1=-0.25, k2=0.08, k3=0.01))
    wide = Camera(400.0, 401.0, 322.0, 236.0, Distortion(k1=0.4, k2=0.1, p1=1e-3, k4=0.6, k6=0.01))
    fisheye = Camera(400.0, 401.0, 322.0, 236.0, Fisheye(0.1, 0.02, 0.03, 0.04))
    for camera, ros, colmap, lens in (
        (TRUTH, "plumb_bob", "OPENCV", [-0.25, 0.08, 6e-4, -4e-4]),
        (rich, "plumb_bob", "FULL_OPENCV", [-0.25, 0.08, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0]),
        (wide, "rational_polynomial", "FULL_OPENCV", list(wide.lens.opencv)),
        (fisheye, "equidistant", "OPENCV_FISHEYE", [0.1, 0.02, 0.03, 0.04]),
    ):
        lines = ros_yaml(report(camera)).splitlines()
        assert f"distortion_model: {ros}" in lines
        data = [json.loads(line.partition(":")[2]) for line in lines if "data:" in line]
        assert data[0] == camera.matrix.ravel().tolist()
        assert data[1][:4] == lens[:4]
        assert np.array(data[3]).reshape(3, 4)[:, :3].tolist() == camera.matrix.tolist()
        number, model, width, height, *parameters = colmap_text(report(camera)).split()
        assert (number, model, int(width), int(height)) == ("1", colmap, *SIZE)
        pinhole = [camera.fx, camera.fy, camera.cx + 0.5, camera.cy + 0.5]
        assert list(map(float, parameters)) == [*pinhole, *lens]


def lensfun_pixels(xml: str, ideal: np.ndarray) -> np.ndarray:
    """Places in the photograph of pixels (N, 2) of a corrected picture, as `modifier.cpp` and
    ``ModifyCoord_Dist_Poly5`` of Lensfun compute them."""
    root = ET.fromstring(xml)
    centre, model = root.find(".//center"), root.find(".//distortion")
    assert centre is not None
    assert model is not None
    assert model.get("model") == "poly5"
    k1, k2 = (float(model.get(name, "")) for name in ("k1", "k2"))
    width, height = SIZE[0] - 1, SIZE[1] - 1
    size = min(width, height)
    scale = 2.0 / size
    middle = (width / size + float(centre.get("x", "")), height / size + float(centre.get("y", "")))
    x, y = (ideal * scale - middle).T
    r2 = x * x + y * y
    factor = 1.0 + k1 * r2 + k2 * r2 * r2
    return (np.stack((x * factor, y * factor), -1) + middle) / scale


def test_lensfun_model_distorts_like_the_calibrated_lens() -> None:
    ideal = np.random.default_rng(1).uniform((0, 0), SIZE, (50, 2))
    direction = (ideal - (RADIAL.cx, RADIAL.cy)) / RADIAL.fx
    expected = RADIAL.pixels(np.c_[direction, np.ones(50)])
    assert lensfun_pixels(lensfun_xml(report(RADIAL)), ideal) == pytest.approx(expected, abs=1e-3)


FULL_FRAME_MM = 600 * 34.613 / 640
"""4:3 of the diagonal of 36 × 24 mm is 34.61 mm wide, so that 640 px are 34.61 mm."""


@pytest.mark.parametrize(
    ("focal", "crop", "written"),
    [
        (35.0, 1.0, (35.0, FULL_FRAME_MM, 1.0)),
        (8.0, None, (8.0, 8.0, FULL_FRAME_MM / 8.0)),
        (None, None, (FULL_FRAME_MM, FULL_FRAME_MM, 1.0)),
    ],
)
def test_lensfun_file_has_the_focal_length_in_millimetres_and_the_crop(
    focal: float | None, crop: float | None, written: tuple[float, float, float]
) -> None:
    maker = Maker("Acme & Co", "One", "Zoom <1>", focal, crop)
    root = ET.fromstring(lensfun_xml(report(Camera(600.0, 600.0, 319.5, 239.5)), maker))
    model = root.find(".//distortion")
    assert model is not None
    found = (model.get("focal", ""), model.get("real-focal", ""), root.findtext(".//cropfactor"))
    assert [float(each or "") for each in found] == pytest.approx(written, rel=1e-3)


CAMERA = Camera(300.0, 302.0, 163.0, 117.0, Distortion(k1=-0.25, k2=0.08, p1=1e-3, p2=-1e-3))


def smooth_picture() -> np.ndarray:
    x, y = np.meshgrid(np.arange(320), np.arange(240))
    planes = [120 + 80 * np.sin(x / 17.0 + phase) * np.cos(y / 23.0) for phase in (0.0, 1.0, 2.0)]
    return np.stack(planes, axis=-1).astype(np.uint8)


def test_undistorted_photograph_agrees_with_opencv() -> None:
    codes = smooth_picture()
    expected = cv2.undistort(codes, CAMERA.matrix, np.array(CAMERA.lens.opencv[:5]))
    off = undistorted(codes, CAMERA).astype(int) - expected
    assert np.abs(off[4:-4, 4:-4]).max() <= 2  # theirs rounds places to 1/32 px


def test_undistorted_picture_is_grey_outside_the_photograph() -> None:
    pincushion = Camera(300.0, 300.0, 159.5, 119.5, Distortion(k1=0.3))
    folded = Camera(100.0, 100.0, 159.5, 119.5, Distortion(k1=-0.3))
    assert (undistorted(smooth_picture(), pincushion)[0, 0] == UNSEEN).all()
    assert (undistorted(smooth_picture(), folded)[0, 0] == UNSEEN).all()
