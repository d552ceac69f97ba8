"""Lens distortion: where a real lens puts the point that a pinhole would image at (x, y).

Brown's model in normalised coordinates (pixels relative to the principal point, divided by the
focal length in pixels; x right, y down), with r² = x² + y²::

    x_d = x g(r²) + 2 p₁ x y + p₂ (r² + 2 x²)
    y_d = y g(r²) + p₁ (r² + 2 y²) + 2 p₂ x y
    g(s) = (1 + k₁ s + k₂ s² + k₃ s³) / (1 + k₄ s + k₅ s² + k₆ s³)

Negative k₁ pulls points inwards the more the further out they are (barrel); positive k₁ pushes
them out (pincushion). Szeliski, 2nd ed., §2.1.5; D. C. Brown, *Decentering distortion of
lenses*, 1966; the rational form is OpenCV's.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_vectors
from simulations.models.distortion import (
    cubic_inverse,
    radial_inverse,
    radial_profile,
    radial_table,
)
from simulations.models.distortion.decentring import DecentredLens, undo_decentred
from simulations.models.distortion.radial_profile import LARGEST_COEFFICIENT, RadialProfile
from simulations.models.require import require

FAR = 1e45
"""Radius beyond which r⁶ and its products might overflow; only directions are used there."""


_profile = lru_cache(maxsize=64)(RadialProfile)  # called a hundred times a frame


@dataclass(frozen=True, slots=True, kw_only=True)
class Distortion:
    """Distortion coefficients; all zero is an ideal lens."""

    k1: float = 0.0
    """Radial, of r²: negative barrel, positive pincushion."""
    k2: float = 0.0
    """Radial, of r⁴."""
    k3: float = 0.0
    """Radial, of r⁶."""
    p1: float = 0.0
    """Tangential: lens elements decentred along y."""
    p2: float = 0.0
    """Tangential: lens elements decentred along x."""
    k4: float = 0.0
    """Denominator, of r²."""
    k5: float = 0.0
    """Denominator, of r⁴."""
    k6: float = 0.0
    """Denominator, of r⁶."""

    def __post_init__(self) -> None:
        small = np.all(np.abs(self.opencv) <= LARGEST_COEFFICIENT)
        require("coefficients", self, small, f"finite, at most {LARGEST_COEFFICIENT:g} in size")

    @property
    def radial(self) -> RadialProfile:
        """The part that depends on the radius alone."""
        return _profile((self.k1, self.k2, self.k3), (self.k4, self.k5, self.k6))

    @property
    def tangential(self) -> bool:
        """Whether decentring breaks the symmetry about the axis."""
        return self.p1 != 0.0 or self.p2 != 0.0

    @property
    def neutral(self) -> bool:
        """Whether the lens moves no point."""
        return self.radial.neutral and not self.tangential

    @property
    def opencv(self) -> tuple[float, ...]:
        """The coefficients in OpenCV's order."""
        return (self.k1, self.k2, self.p1, self.p2, self.k3, self.k4, self.k5, self.k6)


def distort(xy: ArrayLike, d: Distortion) -> Floats:
    """The distorted position of ideal points.

    Parameters
    ----------
    xy : (..., 2) floats
        Normalised coordinates. A neutral lens returns this very array. With any coefficient set,
        points beyond `FAR` are mapped to infinity, with the signs of the polynomial.
    d : Distortion

    Returns
    -------
    (..., 2) floats. Beyond `fold_radius` several points share one image; see `undistort`.
    """
    ideal = as_vectors("xy", xy, 2)
    if d.neutral:
        return ideal
    with np.errstate(over="ignore", invalid="ignore"):
        far = ideal[..., 0] ** 2 + ideal[..., 1] ** 2 > FAR**2
    return _distort_far(ideal, d, far) if far.any() else _distort_near(ideal, d)


def _distort_near(ideal: Floats, d: Distortion) -> Floats:
    x, y = ideal[..., 0], ideal[..., 1]
    with np.errstate(over="ignore", invalid="ignore"):
        r2 = x * x + y * y
        moved = ideal * radial_profile.scale(d.radial, r2)[..., None]
        if d.tangential:
            cross = 2.0 * x * y
            moved[..., 0] += d.p1 * cross + d.p2 * (r2 + 2.0 * x * x)
            moved[..., 1] += d.p1 * (r2 + 2.0 * y * y) + d.p2 * cross
    return moved


@np.errstate(over="ignore", invalid="ignore")
def _distort_far(ideal: Floats, d: Distortion, far: Mask) -> Floats:
    """Points beyond `FAR`: their direction is mapped at the radius `FAR`."""
    largest = np.abs(ideal).max(axis=-1, keepdims=True)
    direction = ideal / np.where(far[..., None], largest, 1.0)
    endless = np.isinf(largest)
    direction = np.where(endless, np.sign(ideal) * np.isinf(ideal), direction)
    shrunk = np.where(far[..., None], FAR * direction, ideal)
    moved = _distort_near(shrunk, d)
    beyond = far[..., None] & (np.abs(moved) > np.sqrt(FAR))
    return np.where(beyond, np.copysign(np.inf, moved), moved)


def fold_radius(d: Distortion) -> float:
    """Radius of ideal points where the radial map stops increasing; inf if it never does.

    With k₁ < 0 alone: √(−1/(3 k₁)).
    """
    return radial_profile.fold_radius(d.radial)


def largest_distorted_radius(d: Distortion) -> float:
    """Largest radius in the image of the radial map; inf if there is no fold.

    With k₁ < 0 alone: two thirds of the fold radius.
    """
    return radial_profile.largest_image_radius(d.radial)


def undistort(xy: ArrayLike, d: Distortion) -> tuple[Floats, Mask]:
    """The ideal position of distorted points: the inverse of `distort`.

    Parameters
    ----------
    xy : (..., 2) floats
        Normalised distorted coordinates.
    d : Distortion

    Returns
    -------
    xy : (..., 2) floats
        Ideal coordinates, NaN where invalid.
    valid : (...) bools
        False where no ideal point inside the fold has this image.
    """
    ideal, valid = undistort_clamped(xy, d)
    if valid.all():
        return ideal, valid
    return np.where(valid[..., None], ideal, np.nan), valid


def undistort_clamped(xy: ArrayLike, d: Distortion) -> tuple[Floats, Mask]:
    """`undistort` for drawing the border of a lens: invalid points are finite too.

    They are put on the fold circle, or at the origin if there is none or the input is not finite.
    The mask is False for them.
    """
    seen = as_vectors("xy", xy, 2)
    if d.neutral or d.tangential:
        finite = np.isfinite(seen).all(axis=-1)
        if d.neutral and finite.all():
            return seen, finite
        seen = np.where(finite[..., None], seen, 0.0)
        ideal, valid = _undo_radial(seen, d.radial)
        if d.tangential:
            ideal, valid = undo_decentred(seen, ideal, DecentredLens(d.radial, d.p1, d.p2))
        return ideal, valid & finite
    return _undo_radial(seen, d.radial)


def _undo_radial(seen: Floats, profile: RadialProfile) -> tuple[Floats, Mask]:
    """By the formula for k₁ alone; otherwise by the table, or one by one for few points."""
    if profile.cubic:
        return _undo_by(cubic_inverse.shrinkage, seen, profile)
    if seen.size < 2 * radial_table.WORTH_A_TABLE:
        return _undo_surely(seen, profile)
    return undo_by_table(seen, profile)


def undo_by_table(seen: Floats, profile: RadialProfile) -> tuple[Floats, Mask]:
    """`undistort_clamped` for points (..., 2) by the table, for any radial lens and count of
    points."""
    return _undo_by(radial_table.shrinkage, seen, profile)


def _undo_by(
    shrinkage: Callable[[RadialProfile, Floats], tuple[Floats, Mask]],
    seen: Floats,
    profile: RadialProfile,
) -> tuple[Floats, Mask]:
    """Scale each point by its factor; points without a factor from ``shrinkage`` are solved one by
    one."""
    x, y = seen[..., 0], seen[..., 1]
    with np.errstate(over="ignore", invalid="ignore"):
        factor, valid = shrinkage(profile, x * x + y * y)
        ideal = np.empty_like(seen)
        np.multiply(x, factor, out=ideal[..., 0])  # by columns: three times as quick as
        np.multiply(y, factor, out=ideal[..., 1])  # seen * factor[..., None]
    if not valid.all():
        rest = ~valid
        ideal[rest], valid[rest] = _undo_surely(seen[rest], profile)
    return ideal, valid


def _undo_surely(seen: Floats, profile: RadialProfile) -> tuple[Floats, Mask]:
    finite = np.asarray(np.isfinite(seen).all(axis=-1))
    seen = np.where(finite[..., None], seen, 0.0)
    with np.errstate(over="ignore"):
        seen_radius = np.hypot(seen[..., 0], seen[..., 1])
    radius, valid = radial_inverse.invert_bracketed(profile, seen_radius)
    ratio = np.divide(radius, seen_radius, out=np.ones_like(radius), where=seen_radius > 0.0)
    return seen * ratio[..., None], valid & finite
