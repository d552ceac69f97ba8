"""Fisheye lenses: image radius as a function of the angle to the axis, defined at 90° too.

Directions are camera-frame vectors (x right, y down, z along the optical axis); image points are in
units of the focal length. Szeliski, 2nd ed., §2.1.5; J. Kannala and S. Brandt, *A generic camera
model and calibration method*, 2006.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_vectors
from simulations.models.distortion import radial_profile
from simulations.models.distortion.radial_profile import RadialProfile
from simulations.models.require import require_one_of


@dataclass(frozen=True, slots=True)
class IdealModel:
    """A textbook relation between angle and image radius."""

    radius: Callable[[Floats], Floats]
    """Image radius of an angle, in focal lengths."""
    angle: Callable[[Floats], Floats]
    """Its inverse."""
    largest_angle_rad: float
    """Largest angle; larger ones have no image, or share it with smaller ones."""


IDEAL_MODELS = {
    "perspective": IdealModel(np.tan, np.arctan, np.pi / 2),
    "stereographic": IdealModel(
        lambda angle: 2.0 * np.tan(0.5 * angle), lambda radius: 2.0 * np.arctan(0.5 * radius), np.pi
    ),
    "equidistant": IdealModel(lambda angle: angle, lambda radius: radius, np.pi),
    "equisolid": IdealModel(
        lambda angle: 2.0 * np.sin(0.5 * angle),
        lambda radius: 2.0 * np.arcsin(np.minimum(0.5 * radius, 1.0)),
        np.pi,
    ),
    "orthographic": IdealModel(
        np.sin, lambda radius: np.arcsin(np.minimum(radius, 1.0)), np.pi / 2
    ),
}
"""Perspective keeps lines straight, stereographic small shapes, equisolid areas."""


@dataclass(frozen=True, slots=True)
class Fisheye:
    """Kannala–Brandt: ``r = θ (1 + k₁θ² + k₂θ⁴ + k₃θ⁶ + k₄θ⁸)``; all zero is equidistant."""

    k1: float = 0.0
    k2: float = 0.0
    k3: float = 0.0
    k4: float = 0.0

    def __post_init__(self) -> None:
        _ = self.radial  # rejects coefficients that are not finite

    @property
    def neutral(self) -> bool:
        """Never: even an equidistant lens moves points."""
        return False

    @property
    def opencv(self) -> tuple[float, ...]:
        """The coefficients in the order of ``cv2.fisheye``."""
        return (self.k1, self.k2, self.k3, self.k4)

    @property
    def radial(self) -> RadialProfile:
        """The same odd polynomial as radial distortion, in the angle instead of the radius."""
        return RadialProfile((self.k1, self.k2, self.k3, self.k4))


EQUIDISTANT = (0.25, 0.32, 0.4, 0.55)
"""Starting values for an unknown lens: focal lengths of equidistant lenses, as shares of the
picture's longer side."""


def project_ideal(directions: ArrayLike, model: str) -> tuple[Floats, Mask]:
    """Image points (..., 2) of directions (..., 3) by one of `IDEAL_MODELS`; and validity.

    Invalid, and NaN: a zero or non-finite direction, an angle at or beyond the model's limit,
    among them exactly backwards, which has no azimuth.
    """
    chosen = _ideal(model)
    angle, azimuth, valid = _angles(directions)
    valid &= angle < chosen.largest_angle_rad
    return _on_image(chosen.radius(angle), azimuth, valid), valid


def unproject_ideal(xy: ArrayLike, model: str) -> tuple[Floats, Mask]:
    """Unit directions (..., 3) of image points (..., 2), the inverse of `project_ideal`.

    Radii outside the model's image are invalid, and NaN.
    """
    chosen = _ideal(model)
    radius, azimuth, valid = _polar(xy)
    angle = chosen.angle(radius)
    with np.errstate(invalid="ignore"):
        returns = np.isclose(chosen.radius(angle), radius, rtol=1e-9, atol=1e-300)
    valid &= (angle < chosen.largest_angle_rad) & returns
    return _direction(np.where(valid, angle, np.nan), azimuth), valid


def project_fisheye(directions: ArrayLike, lens: Fisheye) -> tuple[Floats, Mask]:
    """Image points (..., 2) of directions (..., 3) by a calibrated lens, and validity.

    Invalid as in `project_ideal`, and past the fold, where the polynomial turns back.
    """
    angle, azimuth, valid = _angles(directions)
    valid &= angle < min(np.pi, radial_profile.fold_radius(lens.radial))
    return _on_image(radial_profile.evaluate(lens.radial, angle), azimuth, valid), valid


def _angles(directions: ArrayLike) -> tuple[Floats, Floats, Mask]:
    """Angle to the axis, azimuth, and whether the direction is valid."""
    rays = as_vectors("directions", directions, 3)
    finite = np.isfinite(rays).all(axis=-1)
    largest = np.abs(np.where(finite[..., None], rays, 0.0)).max(axis=-1, keepdims=True)
    scaled = np.where(finite[..., None], rays, 0.0) / np.where(largest > 0.0, largest, 1.0)
    x, y, z = np.moveaxis(scaled, -1, 0)
    across = np.hypot(x, y)
    valid = finite & ((across > 0.0) | (z > 0.0))
    return np.arctan2(across, z), np.arctan2(y, x), valid


def _polar(xy: ArrayLike) -> tuple[Floats, Floats, Mask]:
    points = as_vectors("xy", xy, 2)
    valid = np.isfinite(points).all(axis=-1)
    x, y = np.moveaxis(np.where(valid[..., None], points, 0.0), -1, 0)
    with np.errstate(over="ignore"):
        return np.hypot(x, y), np.arctan2(y, x), valid


def _on_image(radius: Floats, azimuth: Floats, valid: Mask) -> Floats:
    shown = np.where(valid, radius, np.nan)
    return np.stack((shown * np.cos(azimuth), shown * np.sin(azimuth)), axis=-1)


def _direction(angle: Floats, azimuth: Floats) -> Floats:
    across = np.sin(angle)
    parts = (across * np.cos(azimuth), across * np.sin(azimuth), np.cos(angle))
    return np.stack(parts, axis=-1)


def _ideal(model: str) -> IdealModel:
    require_one_of("model", model, IDEAL_MODELS)
    return IDEAL_MODELS[model]
