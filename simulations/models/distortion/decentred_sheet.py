"""How far from the axis, in each direction, a decentred lens preserves orientation.

At the distance r from the axis, with a and b the parts of p = (p₂, p₁) along the radius and across
it, the Jacobian of the map of `decentring` is, along and across the radius,

    f'(r) + 6 a r      2 b r
    2 b r              g(r²) + 2 a r

with f(r) = r g(r²), g = N/D. Its determinant times D³ is a polynomial in r.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial import Polynomial

from simulations.models.arrays import Floats, Mask
from simulations.models.distortion.positive_polynomials import stay_positive
from simulations.models.distortion.radial_profile import RadialProfile, smallest_positive_root


@dataclass(frozen=True, slots=True)
class Sheet:
    """The polynomials of a lens's determinant: ``plain + a · tilted + (3 a² − b²) · bent``."""

    plain: Floats
    """(n + 1,) coefficients of rising powers of r; likewise the other two."""
    tilted: Floats
    bent: Floats
    pole: float
    """Radius of the first pole of g; infinite if there is none."""
    sure: float
    """Radius up to which the determinant is positive in every direction."""


@lru_cache(maxsize=32)
def sheet_of(radial: RadialProfile, p1: float, p2: float) -> Sheet:
    """The polynomials of one lens.

    The tangential part of the Jacobian, ``2 (p·x I + p xᵀ + x pᵀ)``, has the norm 6 |p| r at
    most: as long as g and f' are larger, no direction turns over.
    """
    s, r = Polynomial((0.0, 1.0)), Polynomial((0.0, 1.0))
    n, d = Polynomial((1.0, *radial.numerator)), Polynomial((1.0, *radial.denominator))
    slope = n * d + 2.0 * s * (n.deriv() * d - n * d.deriv())  # f' D²
    n, d, slope = (_of_squares(polynomial) for polynomial in (n, d, slope))
    pole = smallest_positive_root(_coefficients(d))
    most = 6.0 * float(np.hypot(p1, p2)) * r
    sure = [smallest_positive_root(_coefficients(q)) for q in (n - most * d, slope - most * d * d)]
    parts = (n * slope, 2.0 * r * d * (slope + 3.0 * d * n), 4.0 * r**2 * d**3)
    plain, tilted, bent = (_coefficients(part) for part in parts)
    size = max(plain.size, tilted.size, bent.size)
    plain, tilted, bent = (np.pad(part, (0, size - part.size)) for part in (plain, tilted, bent))
    return Sheet(plain, tilted, bent, pole, min(pole, *sure))


def on_sheet_of_axis(ideal: Floats, radial: RadialProfile, p1: float, p2: float) -> Mask:
    """Whether the map preserves orientation all the way from the axis to points (N, 2).

    Also False where the powers of a radius overflow, which never happens within `Sheet.sure`.
    """
    sheet = sheet_of(radial, p1, p2)
    radius = np.hypot(ideal[:, 0], ideal[:, 1])
    keeps = radius < sheet.sure
    asked = np.flatnonzero(~keeps & (radius < sheet.pole))
    if asked.size:
        r = radius[asked]
        x, y = ideal[asked, 0] / r, ideal[asked, 1] / r
        a, b = p2 * x + p1 * y, p1 * x - p2 * y
        with np.errstate(over="ignore", invalid="ignore"):
            direction = sheet.plain + np.outer(a, sheet.tilted)
            direction += np.outer(3.0 * a * a - b * b, sheet.bent)
            keeps[asked] = stay_positive(direction * np.vander(r, sheet.plain.size, True))
    return keeps


def _of_squares(polynomial: Polynomial) -> Polynomial:
    """P(r²) from P(s)."""
    coefficients = _coefficients(polynomial)
    spread = np.zeros(2 * coefficients.size - 1)
    spread[::2] = coefficients
    return Polynomial(spread)


def _coefficients(polynomial: Polynomial) -> Floats:
    """(n + 1,) of rising powers."""
    return np.asarray(polynomial.coef, float)
