"""How far from the axis a lens images a point: odd rational functions of the radius.

Brown's radial distortion and the Kannala–Brandt fisheye share one form,
``f(r) = r · N(r²) / D(r²)`` with polynomials N and D that start at 1. Everything that can be
said of it (slope, fold, inverse) is said once, here.
"""

from dataclasses import dataclass
from math import inf, sqrt

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import ArrayLike, NDArray

type Floats = NDArray[np.floating]

MAX_NEWTON_STEPS = 100
"""A bound on the work, not a tuning: two or three steps are usual, more occur near the fold."""

LARGEST_COEFFICIENT = 1e9
"""Far beyond any lens, and small enough for the products of two polynomials never to overflow."""

GUESS_SAMPLES = 1025
"""Samples of f from which the first guess is interpolated."""


@dataclass(frozen=True, slots=True)
class RadialProfile:
    """``f(r) = r (1 + a₁r² + a₂r⁴ + …) / (1 + b₁r² + b₂r⁴ + …)``."""

    numerator: tuple[float, ...] = ()
    """a₁, a₂, …"""
    denominator: tuple[float, ...] = ()
    """b₁, b₂, …"""

    def __post_init__(self) -> None:
        if not np.all(np.abs((*self.numerator, *self.denominator)) <= LARGEST_COEFFICIENT):
            raise ValueError(
                f"coefficients {self}: must be finite, at most {LARGEST_COEFFICIENT:g} in size"
            )

    @property
    def neutral(self) -> bool:
        """Whether every coefficient is zero, so that f(r) = r."""
        return not any(self.numerator) and not any(self.denominator)


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
        image: Floats = r * scale(profile, r * r)
    return image


def scale_slope(profile: RadialProfile, radius_squared: ArrayLike) -> Floats:
    """Derivative of `scale` with respect to s = r²."""
    s = np.asarray(radius_squared, float)
    numerator, denominator = _polynomials(profile)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        n, d = polynomial.polyval(s, numerator), polynomial.polyval(s, denominator)
        n_slope = polynomial.polyval(s, polynomial.polyder(numerator))
        d_slope = polynomial.polyval(s, polynomial.polyder(denominator))
        result: Floats = (n_slope * d - n * d_slope) / (d * d)
    return result


def slope(profile: RadialProfile, radius: ArrayLike) -> Floats:
    """``f'(r)``: term by term for a polynomial, else ``g + 2 s g'`` with g = `scale`, s = r²."""
    with np.errstate(over="ignore", invalid="ignore"):
        s = np.square(np.asarray(radius, float))
        if any(profile.denominator):
            result: Floats = scale(profile, s) + 2.0 * s * scale_slope(profile, s)
            return result
        odd = tuple((2 * i + 3) * a for i, a in enumerate(profile.numerator))
        return _series(odd, s)


def fold_radius(profile: RadialProfile) -> float:
    """The radius where f stops increasing, or inf where it never does.

    The numerator of f' is ``N D + 2s (N'D − N D')``, for a plain polynomial
    ``1 + 3a₁s + 5a₂s² + 7a₃s³ + …``; the fold is its smallest positive root, or the pole of
    f where that comes first. A slope that touches zero without changing sign counts: an
    inverse exists there but cannot be computed stably.
    """
    n, d = _polynomials(profile)
    n_slope, d_slope = polynomial.polyder(n), polynomial.polyder(d)
    turning = polynomial.polysub(polynomial.polymul(n_slope, d), polynomial.polymul(n, d_slope))
    slope_numerator = polynomial.polyadd(
        polynomial.polymul(n, d), 2.0 * polynomial.polymulx(turning)
    )
    first = min(_smallest_positive_root(slope_numerator), _smallest_positive_root(d))
    return sqrt(first)


def largest_image_radius(profile: RadialProfile) -> float:
    """``f`` at the fold: no point is imaged further out. Infinite where there is no fold."""
    fold = fold_radius(profile)
    if fold == inf:
        return inf
    image = float(evaluate(profile, fold))
    return image if 0.0 < image < 1e12 * fold else inf  # a pole, met up to rounding


def invert(profile: RadialProfile, image_radius: ArrayLike) -> tuple[Floats, NDArray[np.bool_]]:
    """The radius ``r`` in [0, fold) with ``f(r) = image_radius``.

    Newton's method inside a bracket that every step tightens, with bisection where a step
    would leave it: it cannot diverge, in strong pincushion either, where fixed-point
    iteration does.

    Returns
    -------
    radius : (...) floats
        The fold radius (0 where there is none) for entries that are not valid.
    valid : (...) bools
        False where no such radius exists (past the fold, negative or not finite).
    """
    target = np.asarray(image_radius, float)
    fold, limit = fold_radius(profile), largest_image_radius(profile)
    valid = np.isfinite(target) & (target >= 0.0) & (target < limit)
    if profile.neutral:
        return np.where(valid, target, 0.0), valid
    wanted = np.where(valid, target, 0.0)
    radius = _solve(profile, wanted, fold if fold < inf else _upper_bound(profile, wanted))
    residual = np.abs(evaluate(profile, radius) - wanted)
    valid &= residual <= 1e-10 * np.maximum(wanted, 1e-300)
    valid |= np.isfinite(target) & (target == 0.0)
    return np.where(valid, radius, fold if fold < inf else 0.0), valid


def _solve(profile: RadialProfile, wanted: Floats, upper: float) -> Floats:
    low, high = np.zeros_like(wanted), np.full_like(wanted, upper)
    radius = np.minimum(_tabulated_inverse(profile, wanted, upper), 0.999999 * upper)
    for _ in range(MAX_NEWTON_STEPS):
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            excess = evaluate(profile, radius) - wanted
            step = radius - excess / slope(profile, radius)
        low = np.where(excess < 0.0, radius, low)
        high = np.where(excess > 0.0, radius, high)
        inside = (step >= low) & (step <= high)  # false for NaN
        following = np.where(inside, step, 0.5 * (low + high))
        # Newton squares the error: after a step of 1e-8 nothing is left to gain.
        settled = inside & (np.abs(following - radius) <= 1e-8 * following)
        settled |= (excess == 0.0) | (high - low <= 4e-16 * high)
        radius = np.where(excess == 0.0, radius, following)
        if np.all(settled):
            break
    return radius


def _tabulated_inverse(profile: RadialProfile, wanted: Floats, upper: float) -> Floats:
    """A first guess by linear interpolation, with samples crowding where a fold flattens f."""
    u = np.linspace(0.0, 1.0, GUESS_SAMPLES)[:-1]
    radii = upper * u * (2.0 - u)
    with np.errstate(over="ignore", invalid="ignore"):
        images = evaluate(profile, radii)
    usable = np.isfinite(images)
    guess: Floats = np.interp(wanted, np.maximum.accumulate(images[usable]), radii[usable])
    return guess


def _upper_bound(profile: RadialProfile, wanted: Floats) -> float:
    """A radius whose image lies beyond all ``wanted``; f grows without bound where no fold is."""
    furthest, upper = float(wanted.max(initial=0.0)), 1.0
    while upper < 1e150 and evaluate(profile, upper) <= furthest:
        upper *= 2.0
    return upper


def _series(coefficients: tuple[float, ...], s: Floats) -> Floats:
    """``1 + c₁s + c₂s² + …`` by Horner's rule; trailing zeros cost nothing and cannot overflow."""
    used = len(coefficients)
    while used and coefficients[used - 1] == 0.0:
        used -= 1
    if not used:
        return np.ones_like(s)
    total = coefficients[used - 1] * s
    for coefficient in reversed(coefficients[: used - 1]):
        total = (total + coefficient) * s
    result: Floats = total + 1.0
    return result


def _polynomials(profile: RadialProfile) -> tuple[Floats, Floats]:
    return np.array((1.0, *profile.numerator)), np.array((1.0, *profile.denominator))


def _smallest_positive_root(coefficients: Floats) -> float:
    """Smallest s > 0 with ``1 + c₁s + c₂s² + … = 0``, or inf.

    Solved for 1/s, whose polynomial has the leading coefficient 1: a vanishing highest term
    then means a root at zero instead of a division by it.
    """
    inverse_roots = np.roots(coefficients)
    real = np.abs(inverse_roots.imag) <= 1e-9 * np.abs(inverse_roots)
    largest = max((root for root in inverse_roots.real[real] if root > 1e-300), default=0.0)
    return 1.0 / largest if largest else inf
