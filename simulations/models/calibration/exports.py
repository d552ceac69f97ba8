"""A calibration as files for other programs: OpenCV's YAML, JSON, a lens for Lensfun, and cameras
for ROS and COLMAP. Poses are those of a flat board with square squares, as others have it.

Lensfun's model ``poly5`` is r_d = r (1 + k₁ r² + k₂ r⁴), from undistorted to distorted radii as
ours, but its unit of length is half the shorter side of the picture, from the centre of the
outermost pixel to that of the opposite one, and not the focal length. It has no tangential terms.
Behind a lens of the type ``fisheye`` its undistorted radius is that of an equidistant lens.
Source: Lensfun, ``lensfun.h`` and ``modifier.cpp``.
"""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.board_shape import Shape
from simulations.models.calibration.camera import Camera, Poses
from simulations.models.calibration.views import Views
from simulations.models.distortion import radial_profile
from simulations.models.distortion.fisheye import Fisheye
from simulations.models.distortion.lens import WIDEST_RAD, Lens

FULL_FRAME_MM = (36.0, 24.0)
"""Crop factors compare the diagonals of sensors with this one's."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Report:
    """What is written into a file."""

    camera: Camera
    size: tuple[int, int]
    """Width and height of the pictures in px."""
    errors: Mapping[str, float]
    """Standard error of each free parameter."""
    rms_px: float
    """With these poses."""
    poses: Poses
    """Of a flat board."""
    photographs: Sequence[tuple[str, float]]
    """Name and RMS error in px of each, in the order of the poses."""
    views: Views
    """Their corners, in the same order."""
    covariance: Floats | None = None
    """(m, m) of the parameters in ``errors``, if all that is left is noise."""
    bent: tuple[Shape, float] | None = None
    """The board's shape, and the RMS error in px with it, if it was estimated."""
    taken: Mapping[str, float | str] = field(default_factory=dict)
    """Make, model, lens and focal length in mm by their files, if all agree."""


def opencv_yaml(report: Report) -> str:
    """For ``cv::FileStorage``; the names are those of OpenCV's own sample. The coefficients of a
    fisheye are for the functions of ``cv2.fisheye``."""
    width, height = report.size
    lens = np.array([[*coefficients(report.camera.lens).values()]])
    poses = np.hstack((report.poses.rotation_vectors, report.poses.t))
    return "\n".join(
        (
            "%YAML:1.0",
            "---",
            f"image_width: {width}",
            f"image_height: {height}",
            f"nframes: {len(poses)}",
            f"fisheye_model: {int(isinstance(report.camera.lens, Fisheye))}",
            *_matrix("camera_matrix", report.camera.matrix),
            *_matrix("distortion_coefficients", lens),
            f"avg_reprojection_error: {report.rms_px:.17g}",
            *_matrix("extrinsic_parameters", poses),
            "",
        )
    )


def coefficients(lens: Lens) -> dict[str, float]:
    """By name, in OpenCV's order."""
    names: tuple[str, ...] = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6")
    if isinstance(lens, Fisheye):
        names = ("k1", "k2", "k3", "k4")
    elif not any(lens.radial.denominator):
        names = names[:5]
    return dict(zip(names, lens.opencv, strict=False))


def _matrix(name: str, values: Floats) -> tuple[str, ...]:
    rows, columns = values.shape
    data = ", ".join(f"{value:.17g}" for value in values.ravel())
    return (
        f"{name}: !!opencv-matrix",
        f"   rows: {rows}",
        f"   cols: {columns}",
        "   dt: d",
        f"   data: [ {data} ]",
    )


def as_json(report: Report) -> str:
    """All of it, with standard errors; lengths in squares of the board, angles in radians. A corner
    is its column and row on the board, and x and y in px."""
    camera, views = report.camera, report.views
    turns, shifts = report.poses.rotation_vectors.tolist(), report.poses.t.tolist()
    corners = [np.hstack(views.of(index)).tolist() for index in range(len(views))]
    values = {n: getattr(camera, n) for n in ("fx", "fy", "cx", "cy")}
    return json.dumps(
        {
            "width": report.size[0],
            "height": report.size[1],
            "model": "fisheye" if isinstance(camera.lens, Fisheye) else "brown",
            "camera": values | coefficients(camera.lens),
            "standard_errors": dict(report.errors),
            "covariance": {
                "parameters": list(report.errors),
                "matrix": None if report.covariance is None else report.covariance.tolist(),
            },
            "rms_px": report.rms_px,
            "board_shape": _shape_of(report),
            "taken": dict(report.taken),
            "photographs": [
                {
                    "name": name,
                    "rms_px": rms,
                    "rotation_vector": turn,
                    "translation": shift,
                    "corners": places,
                }
                for (name, rms), turn, shift, places in zip(
                    report.photographs, turns, shifts, corners, strict=True
                )
            ],
        },
        indent=2,
        ensure_ascii=False,
    )


def _shape_of(report: Report) -> object:
    """Coefficients by axis and powers of u and v, as in `board_shape`; null for a flat board."""
    if report.bent is None:
        return None
    shape, rms_px = report.bent
    return {
        "coefficients": dict(zip(shape.names, shape.values, strict=True)),
        "middle": shape.middle,
        "half_side": shape.reach,
        "rms_px": rms_px,
    }


def ros_yaml(report: Report) -> str:
    """For ROS's ``camera_info``, as ``camera_calibration_parsers`` reads it."""
    fisheye = isinstance(report.camera.lens, Fisheye)
    lens = np.array([[*coefficients(report.camera.lens).values()]])
    brown = "plumb_bob" if lens.size == 5 else "rational_polynomial"
    projection = np.hstack((report.camera.matrix, np.zeros((3, 1))))
    matrices = {
        "camera_matrix": report.camera.matrix,
        "distortion_coefficients": lens,
        "rectification_matrix": np.eye(3),
        "projection_matrix": projection,
    }
    lines = [
        f"image_width: {report.size[0]}",
        f"image_height: {report.size[1]}",
        "camera_name: camera",
        f"distortion_model: {'equidistant' if fisheye else brown}",
    ]
    for name, values in matrices.items():
        rows, columns = values.shape
        data = ", ".join(f"{value:.17g}" for value in values.ravel())
        lines += [f"{name}:", f"  rows: {rows}", f"  cols: {columns}", f"  data: [{data}]"]
    return "\n".join((*lines, ""))


def colmap_text(report: Report) -> str:
    """COLMAP's ``cameras.txt``, where the first pixel is centred at (0.5, 0.5)."""
    camera, lens = report.camera, report.camera.lens.opencv
    model = "FULL_OPENCV"
    if not any(lens[4:]):
        model, lens = "OPENCV", lens[:4]
    if isinstance(camera.lens, Fisheye):
        model = "OPENCV_FISHEYE"
    numbers = (camera.fx, camera.fy, camera.cx + 0.5, camera.cy + 0.5, *lens)
    parameters = " ".join(f"{number:.17g}" for number in numbers)
    return f"1 {model} {report.size[0]} {report.size[1]} {parameters}\n"


@dataclass(frozen=True, slots=True)
class Maker:
    """What a lens database has to know of camera and lens; from EXIF where it is given."""

    make: str = "Unknown"
    model: str = "Unknown"
    lens: str = "Calibrated lens"
    focal_mm: float | None = None
    crop: float | None = None
    """Diagonal of a full frame by that of this sensor."""


def lensfun_xml(report: Report, maker: Maker = Maker()) -> str:
    """An entry of Lensfun's database; put it into ``~/.local/share/lensfun/``.

    ``real-focal`` is the calibrated focal length in mm if the crop factor is right. One that is not
    given follows from the focal length in mm; without that either, the sensor is a full frame.
    """
    k1, k2 = lensfun_poly5(report.camera, report.size)
    x, y = lensfun_centre(report.camera, report.size)
    focal_px = math.sqrt(report.camera.fx * report.camera.fy)
    on_full_frame = focal_px * math.hypot(*FULL_FRAME_MM) / math.hypot(*report.size)
    crop = maker.crop or (on_full_frame / maker.focal_mm if maker.focal_mm else 1.0)
    real = on_full_frame / crop
    focal = maker.focal_mm or real
    sides = sorted(report.size, reverse=True)
    common = math.gcd(*sides)
    return f"""<lensdatabase version="1">
  <lens>
    <maker>{_escaped(maker.make)}</maker>
    <model>{_escaped(maker.lens)}</model>
    <mount>{_escaped(maker.model)}</mount>
    <cropfactor>{crop:.4g}</cropfactor>
    <type>{"fisheye" if isinstance(report.camera.lens, Fisheye) else "rectilinear"}</type>
    <aspect-ratio>{sides[0] // common}:{sides[1] // common}</aspect-ratio>
    <center x="{x:.6g}" y="{y:.6g}" />
    <calibration>
      <distortion model="poly5" focal="{focal:.6g}" real-focal="{real:.6g}" \
k1="{k1:.8g}" k2="{k2:.8g}" />
    </calibration>
  </lens>
</lensdatabase>
"""


def half_side_px(size: tuple[int, int]) -> float:
    """Lensfun's unit of length in px."""
    return 0.5 * (min(size) - 1)


def lensfun_poly5(camera: Camera, size: tuple[int, int]) -> tuple[float, float]:
    """k₁ and k₂ of ``poly5``: ours in its unit, or with k₃ those closest within the picture."""
    unit = half_side_px(size) / math.sqrt(camera.fx * camera.fy)
    corner = math.hypot(*size) / (min(size) - 1)
    widest = WIDEST_RAD if isinstance(camera.lens, Fisheye) else math.inf
    corner = min(corner, min(radial_profile.fold_radius(camera.lens.radial), widest) / unit)
    s = np.linspace(0.0, corner, 101)[1:] ** 2
    wanted = radial_profile.scale(camera.lens.radial, s * unit * unit) - 1.0
    r = np.sqrt(s)[:, None]  # least squares of shifts and not of factors
    system = np.stack((s, s * s), axis=-1)
    (k1, k2), *_ = np.linalg.lstsq(system * r, wanted * r[:, 0], rcond=None)
    return float(k1), float(k2)


def lensfun_centre(camera: Camera, size: tuple[int, int]) -> tuple[float, float]:
    """The principal point from the middle of the picture, in Lensfun's unit."""
    unit = half_side_px(size)
    middle = (0.5 * (size[0] - 1), 0.5 * (size[1] - 1))
    return (camera.cx - middle[0]) / unit, (camera.cy - middle[1]) / unit


def _escaped(words: str) -> str:
    """Text of an element, escaped; `xml.sax` would be one more file before the figure starts."""
    return words.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
