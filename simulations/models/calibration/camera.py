"""A camera as calibration describes it: four intrinsic numbers, those of the lens, and poses.

The conventions are OpenCV's: x right, y down, z forward; a pose maps board to camera.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask
from simulations.models.calibration.board_shape import FLAT, Shape
from simulations.models.distortion import lens as lenses
from simulations.models.distortion.lens import Lens
from simulations.models.distortion.lens_model import Distortion
from simulations.models.geometry import rotations
from simulations.models.projection.pinhole import intrinsics

PINHOLE = ("fx", "fy", "cx", "cy")

LENSES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "none": (),
        "k1": ("k1",),
        "k1k2": ("k1", "k2"),
        "p1p2": ("k1", "k2", "p1", "p2"),
        "k3": ("k1", "k2", "p1", "p2", "k3"),
        "rational": ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"),
        "fisheye": ("k1", "k2", "k3", "k4"),
    }
)
"""The models of the lens, from simple to rich, each with its free coefficients; those of the
fisheye are of powers of the angle."""

IDEAL = Distortion()
"""A lens that moves no point."""


@dataclass(frozen=True, slots=True)
class Camera:
    """The intrinsic parameters and the lens."""

    fx: float
    fy: float
    """Focal lengths in px."""
    cx: float
    cy: float
    """Principal point in px."""
    lens: Lens = IDEAL

    @property
    def matrix(self) -> Floats:
        """The intrinsic matrix K (3, 3)."""
        return intrinsics((self.fx, self.fy), (self.cx, self.cy))

    def values(self, names: tuple[str, ...]) -> Floats:
        """Parameters by name."""
        return np.array([getattr(self if n in PINHOLE else self.lens, n) for n in names], float)

    def changed(self, names: tuple[str, ...], values: ArrayLike) -> "Camera":
        """This camera with other values of the parameters ``names``."""
        given = dict(zip(names, np.asarray(values, float).tolist(), strict=True))
        lens = replace(self.lens, **{n: v for n, v in given.items() if n not in PINHOLE})
        pinhole = {name: given.get(name, getattr(self, name)) for name in PINHOLE}
        return Camera(**pinhole, lens=lens)

    def scaled(self, scale: float) -> "Camera":
        """The same camera for its pictures at another size; pixels are centred at whole numbers."""
        cx, cy = (scale * (centre + 0.5) - 0.5 for centre in (self.cx, self.cy))
        return replace(self, fx=scale * self.fx, fy=scale * self.fy, cx=cx, cy=cy)

    def pixels(self, points: Floats) -> Floats:
        """Pixels (..., 2) of points (..., 3) in the camera frame, all in front of it."""
        image = lenses.distorted(points[..., :2] / points[..., 2:], self.lens)
        return image * (self.fx, self.fy) + (self.cx, self.cy)

    def ideal(self, pixels: Floats) -> tuple[Floats, Mask]:
        """The points (..., 2) at z = 1 seen at pixels (..., 2), and where there are any."""
        return lenses.ideal((pixels - (self.cx, self.cy)) / (self.fx, self.fy), self.lens)

    def field_rad(self, width: int) -> float:
        """Angle between the directions of the two ends of the row through the principal point; of
        the part that a plane in front of the camera has, if the picture shows more."""
        ends = np.array([(-0.5, self.cy), (width - 0.5, self.cy)])
        (left, right), _ = self.ideal(ends)
        return float(np.arctan(right[0]) - np.arctan(left[0]))


@dataclass(frozen=True, slots=True)
class Poses:
    """Poses of P boards of one shape: X_camera = R X_board + t."""

    R: Floats
    """(P, 3, 3) rotations."""
    t: Floats
    """(P, 3) in squares."""
    shape: Shape = FLAT

    @property
    def rotation_vectors(self) -> Floats:
        """(P, 3): axis times angle, as OpenCV has them."""
        return rotations.logarithm(self.R)

    def place(self, board: Floats) -> Floats:
        """Points (P, N, 2) of the boards, in the camera frame (P, N, 3)."""
        points = self.shape.points(board)
        placed: Floats = points @ np.swapaxes(self.R, -1, -2) + self.t[:, None]
        return placed

    def moved(self, step: Floats) -> "Poses":
        """After steps (P, 6): a small turn in the camera frame, and a shift."""
        R = rotations.exponential(step[:, :3]) @ self.R
        return Poses(R, self.t + step[:, 3:], self.shape)

    def take(self, chosen: slice | list[int]) -> "Poses":
        """Some of the poses."""
        return Poses(self.R[chosen], self.t[chosen], self.shape)


def predicted(camera: Camera, poses: Poses, board: Floats) -> Floats:
    """Pixels (P, N, 2) of corners (P, N, 2) of the boards; infinite at and behind the camera."""
    points = poses.place(board)
    ahead = points[..., 2:] > 0.0
    safe = np.where(ahead, points, 1.0)
    return np.where(ahead, camera.pixels(safe), np.inf)
