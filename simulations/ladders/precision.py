"""Precision of a projection in float32 and float64, near the origin and far from it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.error_measures import root_mean_square

type Whole = NDArray[np.int64]

COUNT = 20_000
FOCAL_PX = 1000.0
UNIT_M = 2.0**-20
"""All coordinates are multiples of this (a micrometre), which float64 represents exactly."""
TURN = np.array([[-11, -2, 10], [10, -5, 10], [2, 14, 5]])
"""Fifteen times the rotation of the quaternion (1, 1, 2, 3)/√15: in whole numbers."""
CENTRES_M = {"near": (3.0, -2.0, 5.0), "far": (2_710_000.0, -4_320_000.0, 3_890_000.0)}
"""Camera centres in the world: 6 m from its origin, and on the earth with the origin inside."""


@dataclass(frozen=True, slots=True)
class Place:
    """A camera, and points in front of it."""

    centre: Floats
    """(3,) metres, world frame."""
    points: Floats
    """(N, 3) metres, world frame, 2 m to 20 m in front of the camera."""


@dataclass(frozen=True, slots=True)
class Workload:
    """The same view, near the origin and far from it."""

    steps: Whole
    """(N, 3) from the camera centre to the points, in `UNIT_M`, world axes: exact."""
    rotation: Floats
    """(3, 3) world to camera."""
    near: Place
    far: Place


def prepare() -> Workload:
    return _workload(11, CENTRES_M)


def draw(index: int) -> Workload:
    """Other points, and cameras in other directions from the world's origin."""
    rng = np.random.default_rng(index)
    centres = {}
    for name, centre in CENTRES_M.items():
        direction = rng.normal(size=3)
        distance = np.linalg.norm(centre) / np.linalg.norm(direction)
        centres[name] = tuple(UNIT_M * np.rint(direction * distance / UNIT_M))
    return _workload(index, centres)


def _workload(seed: int, centres_m: Mapping[str, tuple[float, ...]]) -> Workload:
    rng = np.random.default_rng(seed)
    depth = rng.uniform(2.0, 20.0, COUNT)
    slope = rng.uniform(-0.5, 0.5, (COUNT, 2))
    camera_frame = np.column_stack([slope * depth[:, None], depth])
    rotation = TURN / 15.0
    steps = np.rint(camera_frame @ rotation / UNIT_M).astype(np.int64)
    places = {
        name: Place(np.array(centre), np.array(centre) + steps * UNIT_M)
        for name, centre in centres_m.items()
    }
    return Workload(steps, rotation, **places)


def reference(workload: Workload) -> Floats:
    """Pixels (N, 2) from whole numbers: only the last division and product are rounded."""
    turned = workload.steps @ TURN.astype(np.int64).T
    return FOCAL_PX * (turned[:, :2] / turned[:, 2:])


def _pixels(camera: Floats) -> Floats:
    pixels: Floats = camera[:, :2] / camera[:, 2:]
    pixels *= FOCAL_PX  # in place: a float32 array stays float32
    return pixels


def _turned(rotation: Floats, points: Floats) -> Floats:
    """R p of points (..., 3), in their own precision.

    Products and sums are written out: a matrix library may fuse or reorder them, and here the
    rounding is measured. It must not differ from one machine to the next.
    """
    x, y, z = points[..., 0], points[..., 1], points[..., 2]
    rows = rotation.astype(points.dtype)
    return np.stack([row[0] * x + row[1] * y + row[2] * z for row in rows], axis=-1)


def _float32(place: Place, rotation: Floats) -> Floats:
    """R p + t in float32, as on graphics hardware."""
    t = -_turned(rotation, place.centre).astype(np.float32)
    # Points that far away are rounded to half a metre: some coincide with the camera.
    with np.errstate(divide="ignore", invalid="ignore"):
        return _pixels(_turned(rotation, place.points.astype(np.float32)) + t)


def _relative_float32(place: Place, rotation: Floats) -> Floats:
    """One subtraction in float64; the rest in float32."""
    return _pixels(_turned(rotation, (place.points - place.centre).astype(np.float32)))


def _float64(place: Place, rotation: Floats) -> Floats:
    """R p + t, as `simulations.models.projection.pinhole.world_to_camera`."""
    return _pixels(_turned(rotation, place.points) - _turned(rotation, place.centre))


def _relative_float64(place: Place, rotation: Floats) -> Floats:
    """R (p − c), as `simulations.models.projection.pinhole.relative_to_camera`."""
    return _pixels(_turned(rotation, place.points - place.centre))


def _both(
    workload: Workload, *, project: Callable[[Place, Floats], Floats]
) -> tuple[Floats, Floats]:
    """Pixels (N, 2) near the origin, and far from it."""
    return project(workload.near, workload.rotation), project(workload.far, workload.rotation)


def _rms_px(pixels: Floats, truth: Floats) -> float:
    """RMS distance. A lost point, or one outside the picture, counts as 1000 px."""
    distance = np.linalg.norm(pixels.astype(np.float64) - truth, axis=-1)
    return root_mean_square(np.fmin(distance, FOCAL_PX))


def rms_far_px(result: tuple[Floats, Floats], truth: Floats, _workload: Workload) -> float:
    return _rms_px(result[1], truth)


def rms_near_px(result: tuple[Floats, Floats], truth: Floats, _workload: Workload) -> float:
    return _rms_px(result[0], truth)


TIERS = (
    ("float32", "float32", "R p + t in 4 bytes a number", _float32),
    ("relative-32", "Camera first, then float32", "3 subtractions in 8 bytes", _relative_float32),
    ("float64", "float64", "R p + t in 8 bytes a number", _float64),
    ("relative-64", "Camera first, float64", "R (p − c) in 8 bytes a number", _relative_float64),
)
LADDER = Ladder(
    id="precision",
    title="Far from the origin",
    workload="20 000 points 2 m to 20 m before a camera, near the origin and 6414 km away",
    prepare=prepare,
    tiers=tuple(
        Tier(name, label, cost, partial(_both, project=project))
        for name, label, cost, project in TIERS
    ),
    reference=reference,
    reference_label="whole-number arithmetic, one rounding at the end",
    metrics=(
        Metric("far", "RMS error, 6414 km from the origin", "px", rms_far_px),
        Metric("near", "RMS error, 6 m from the origin", "px", rms_near_px),
    ),
    draw=draw,
    default_tier="relative-64",
    items=40_000,
    item="point",
)
