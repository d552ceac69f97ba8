"""Radial profiles: image radius as an odd rational function of the radius.

Brown's radial distortion and the Kannala–Brandt fisheye share one form, ``f(r) = r · N(r²) /
D(r²)`` with polynomials N and D that start at 1. This module has its slope and its fold;
`radial_table` and `radial_inverse` have its inverse.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import inf, isfinite, sqrt

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats
from simulations.models.require import require

LARGEST_COEFFICIENT = 1e9
"""Largest coefficient: far beyond any lens, and products of two polynomials cannot overflow."""


@dataclass(frozen=True, slots=True)
class RadialProfile:
    """``f(r) = r (1 + a₁r² + a₂r⁴ + …) / (1 + b₁r² + b₂r⁴ + …)``."""

    numerator: tuple[float, ...] = ()
    """a₁, a₂, …"""
    denominator: tuple[float, ...] = ()
    """b₁, b₂, …"""

    def __post_init__(self) -> None:
        small = np.all(np.abs((*self.numerator, *self.denominator)) <= LARGEST_COEFFICIENT)
        require("coefficients", self, small, f"finite, at most {LARGEST_COEFFICIENT:g} in size")

    @property
    def neutral(self) -> bool:
        """Whether every coefficient is zero, so that f(r) = r."""
        return not any(self.numerator) and not any(self.denominator)

    @property
    def cubic(self) -> bool:
        """Whether a₁ alone is not zero, so that f(r) = r + a₁r³."""
        only_first = any(self.numerator[:1]) and not any(self.numerator[1:])
        return only_first and not any(self.denominator)


def scale(profile: RadialProfile, radius_squared: ArrayLike) -> Floats:
    """``f(r) / r`` from ``s = r²``: no square root is needed to distort a point."""
    s = np.asarray(radius_squared, float)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        factor = _series(profile.numerator, s)
        if any(profile.denominator):
            factor = factor / _series(profile.denominator, s)
    return factor


def evaluate(profile: RadialProfile, radius: ArrayLike) -> Floats:
    """``f(r)``."""
    r = np.asarray(radius, float)
    if profile.neutral:  # r² would overflow for |r| > 1e154 although f(r) = r does not
        return r
    with np.errstate(over="ignore", invalid="ignore"):
        return r * scale(profile, r * r)


def scale_slope(profile: RadialProfile, radius_squared: ArrayLike) -> Floats:
    """Derivative of `scale` with respect to s = r²."""
    return scale_and_slope(profile, radius_squared)[1]


def scale_and_slope(profile: RadialProfile, radius_squared: ArrayLike) -> tuple[Floats, Floats]:
    """`scale` and its derivative with respect to s = r², in one pass."""
    s = np.asarray(radius_squared, float)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        n, n_slope = _series_and_slope(profile.numerator, s)
        if not any(profile.denominator):
            return n, n_slope
        d, d_slope = _series_and_slope(profile.denominator, s)
        g = n / d
        return g, (n_slope - g * d_slope) / d


def slope(profile: RadialProfile, radius: ArrayLike) -> Floats:
    """``f'(r)``."""
    with np.errstate(over="ignore"):
        return slope_at_squared(profile, np.square(np.asarray(radius, float)))


def slope_at_squared(profile: RadialProfile, radius_squared: ArrayLike) -> Floats:
    """``f'(r)`` from s = r²: term by term for a polynomial, else ``g + 2 s g'``."""
    s = np.asarray(radius_squared, float)
    with np.errstate(over="ignore", invalid="ignore"):
        if any(profile.denominator):
            return scale(profile, s) + 2.0 * s * scale_slope(profile, s)
        odd = tuple((2 * i + 3) * a for i, a in enumerate(profile.numerator))
        return _series(odd, s)


def slope_towards(profile: RadialProfile, radius: ArrayLike, image: ArrayLike) -> Floats:
    """The slope of ``r N − image · D``, over D: f' itself where ``f(r) = image``.

    Newton's method for ``f(r) = image`` takes it for f', because it stays of moderate size where
    D vanishes: close to a pole f bends too much to be followed along its tangent.
    """
    if not any(profile.denominator):
        return slope(profile, radius)
    r = np.asarray(radius, float)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        s = r * r
        n, n_slope = _series_and_slope(profile.numerator, s)
        d, d_slope = _series_and_slope(profile.denominator, s)
        return (n + 2.0 * s * n_slope - 2.0 * r * d_slope * np.asarray(image, float)) / d


@lru_cache(maxsize=64)  # called some twenty times a frame
def fold_radius(profile: RadialProfile) -> float:
    """The radius where f stops increasing, or inf if it never does.

    The numerator of f' is ``N D + 2s (N'D − N D')``, for a plain polynomial ``1 + 3a₁s + 5a₂s² +
    7a₃s³ + …``; the fold is its smallest positive root, or the pole of f if that is smaller. A
    slope that touches zero without changing sign counts: an inverse exists there but cannot be
    computed stably.
    """
    first = smallest_positive_root(_slope_numerator(profile))
    if any(profile.denominator):
        first = min(first, smallest_positive_root(np.array((1.0, *profile.denominator))))
    return sqrt(first)


def image_of_fold(profile: RadialProfile, fold: float) -> float:
    """``f`` at its `fold_radius`: infinite if there is none, or if it is a pole."""
    if fold == inf:
        return inf
    image = float(evaluate(profile, fold))
    return image if 0.0 < image < 1e12 * fold else inf  # a pole, met up to rounding


def largest_image_radius(profile: RadialProfile) -> float:
    """``f`` at the fold, the largest image radius. Infinite if there is no fold."""
    return image_of_fold(profile, fold_radius(profile))


def nearest_turning_image(profile: RadialProfile) -> float:
    """``|f(r)²|`` at the zero of f' nearest to the axis in the plane of complex r²; inf for none.

    If that r² is real and positive, it is the fold. Otherwise f has no fold, but the inverse, as a
    function of f², has its nearest singularity at this distance.
    """
    furthest = max(_inverse_roots(_slope_numerator(profile)), key=abs, default=0.0)
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        s = np.asarray(1.0) / furthest
        g = _series(profile.numerator, s) / _series(profile.denominator, s)
        image = float(np.abs(s * g * g))
    return image if isfinite(image) else inf  # no zero, or a pole that it cancels


def _series(coefficients: tuple[float, ...], s: Floats) -> Floats:
    """``1 + c₁s + c₂s² + …`` by Horner's rule; trailing zeros cost nothing and cannot overflow."""
    used = _used(coefficients)
    if not used:
        return np.ones_like(s)
    total = used[-1] * s
    for coefficient in reversed(used[:-1]):
        total = (total + coefficient) * s
    return total + 1.0


def _series_and_slope(coefficients: tuple[float, ...], s: Floats) -> tuple[Floats, Floats]:
    """`_series` and its derivative: Horner's rule, differentiated line by line."""
    used = (1.0, *_used(coefficients))
    total, slope = np.full_like(s, used[-1]), np.zeros_like(s)
    for coefficient in reversed(used[:-1]):
        slope = slope * s + total
        total = total * s + coefficient
    return total, slope


def _used(coefficients: tuple[float, ...]) -> tuple[float, ...]:
    """Without the zeros at the end."""
    used = len(coefficients)
    while used and coefficients[used - 1] == 0.0:
        used -= 1
    return coefficients[:used]


def _slope_numerator(profile: RadialProfile) -> Floats:
    """Coefficients, in rising powers of s, of the polynomial that vanishes where f' does."""
    if not any(profile.denominator):
        return np.array([1.0, *((2 * i + 3) * a for i, a in enumerate(profile.numerator))])
    s = Polynomial((0.0, 1.0))
    n, d = Polynomial((1.0, *profile.numerator)), Polynomial((1.0, *profile.denominator))
    return np.asarray((n * d + 2.0 * s * (n.deriv() * d - n * d.deriv())).coef, float)


def _inverse_roots(coefficients: Floats) -> NDArray[np.inexact]:
    """All 1/s with ``1 + c₁s + c₂s² + … = 0``.

    Solved for 1/s, whose polynomial has the leading coefficient 1: a vanishing highest term
    then means a root at zero instead of a division by it.
    """
    return np.roots(coefficients)


def smallest_positive_root(coefficients: Floats) -> float:
    """The smallest s > 0 with ``1 + c₁s + c₂s² + … = 0``, or inf if there is none.

    ``coefficients`` (n + 1,) of rising powers, the first of them 1. A double root counts.
    """
    inverse_roots = _inverse_roots(coefficients)
    real = np.abs(inverse_roots.imag) <= 1e-9 * inverse_roots.real
    largest = max((root for root in inverse_roots.real[real] if root > 1e-300), default=0.0)
    return 1.0 / largest if largest else inf
