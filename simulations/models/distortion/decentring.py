"""A lens whose elements are off centre, so that distortion depends on more than the radius.

With p = (p₂, p₁), x a point of the plane and g the radial factor of r² = x·x, Brown's map is ``x ↦
g(r²) x + 2 (p·x) x + r² p``. It is a gradient, so its Jacobian is symmetric. D. C. Brown,
*Decentering distortion of lenses*, 1966.

It is undone by Newton's method: one 2×2 system for each point, all solved together.

The inverse holds as far from the axis as the map preserves orientation. At the distance r, with a
and b the parts of p along the radius and across it, its Jacobian along and across the radius is

    f'(r) + 6 a r      2 b r
    2 b r              g(r²) + 2 a r

with f(r) = r g(r²), g = N/D. Its determinant times D³ is a polynomial in r, which must stay
positive. That is decided without sampling. Written in Bernstein's basis, a polynomial lies between
its smallest and its largest coefficient, and the first and the last are its values at the ends. If
all are positive, so is the polynomial; if an end is not positive, the polynomial is not. Intervals
that neither rule decides are halved.

Source: Farouki, The Bernstein polynomial basis: a centennial retrospective, 2012, §§3 and 5.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from math import comb

import numpy as np
from numpy.polynomial import Polynomial

from simulations.models.arrays import Floats, Mask
from simulations.models.distortion.radial_inverse import FURTHEST
from simulations.models.distortion.radial_profile import (
    RadialProfile,
    scale_and_slope,
    smallest_positive_root,
)

MOST_STEPS = 30
"""Bound on the steps; from a good start three or four are usual."""

SETTLED = 1e-9
"""Steps smaller than this, relative to the point (to 1 near the origin), end the iteration."""

type Linearisation = tuple[Floats, Floats, Floats, Floats, Floats]
"""Images x', y' of points, and the derivatives of x' by x, of either by the other, of y' by y."""


def solve_in_plane(
    linearised: Callable[[Floats, Floats], Linearisation], wanted: Floats, start: Floats
) -> Floats:
    """Points near ``start`` that a map takes to ``wanted``, if the iteration finds them.

    Parameters
    ----------
    linearised : function of x and y, (N,) each
        The map with its derivatives: a symmetric matrix, as that of any gradient.
    wanted, start : (N, 2) floats

    Returns
    -------
    (N, 2) floats. The caller must check that they are solutions, as points may diverge, even to
    NaN. Points that have converged are left out of further steps.
    """
    found = np.empty_like(start)
    places = np.arange(len(start))
    (x, y), (wanted_x, wanted_y) = start.T.copy(), wanted.T.copy()
    for _ in range(MOST_STEPS):
        step_x, step_y = newton_step(linearised, x, y, wanted_x, wanted_y)
        # The error is squared by each step, so the next one would gain nothing. NaN stops too.
        size = np.maximum(np.maximum(np.abs(x), np.abs(y)), 1.0)
        going = np.maximum(np.abs(step_x), np.abs(step_y)) > SETTLED * size
        x, y = x - step_x, y - step_y
        if going.all():
            continue
        found[places[~going]] = np.stack((x[~going], y[~going]), axis=-1)
        places, x, y = places[going], x[going], y[going]
        wanted_x, wanted_y = wanted_x[going], wanted_y[going]
        if not places.size:
            break
    found[places] = np.stack((x, y), axis=-1)
    return found


def newton_step(
    linearised: Callable[[Floats, Floats], Linearisation],
    x: Floats,
    y: Floats,
    wanted_x: Floats,
    wanted_y: Floats,
) -> tuple[Floats, Floats]:
    """The step of Newton's method, subtracted from x and y, by Cramer's rule; all (...)."""
    seen_x, seen_y, x_by_x, mixed, y_by_y = linearised(x, y)
    right, down = seen_x - wanted_x, seen_y - wanted_y
    inverse = 1.0 / (x_by_x * y_by_y - mixed * mixed)
    return (y_by_y * right - mixed * down) * inverse, (x_by_x * down - mixed * right) * inverse


DECIDING_HALVINGS = 26
"""Halvings, after which an undecided polynomial is zero to half of its digits."""


def stay_positive(coefficients: Floats) -> Mask:
    """Whether Σ cₖ tᵏ > 0 for all t from 0 to 1.

    Parameters
    ----------
    coefficients : (N, n + 1) floats
        Rising powers, a polynomial in each row.

    Returns
    -------
    (N,) bools; False also where a coefficient is not finite, and where a polynomial touches zero.
    """
    positive: Mask = np.asarray(np.isfinite(coefficients).all(axis=1))
    owner = np.flatnonzero(positive)
    from_powers, left, right = _changes_of_basis(coefficients.shape[1] - 1)
    pieces = coefficients[owner] @ from_powers
    for _ in range(DECIDING_HALVINGS):
        positive[owner[(pieces[:, 0] <= 0.0) | (pieces[:, -1] <= 0.0)]] = False
        open_still = positive[owner] & ~(pieces > 0.0).all(axis=1)
        owner, pieces = owner[open_still], pieces[open_still]
        if not owner.size:
            return positive
        owner, pieces = np.tile(owner, 2), np.concatenate((pieces @ left, pieces @ right))
    positive[owner] = False
    return positive


@lru_cache
def _changes_of_basis(degree: int) -> tuple[Floats, Floats, Floats]:
    """Matrices, multiplied from the right: powers to Bernstein's basis, and to each half."""
    n = range(degree + 1)
    from_powers = np.array([[comb(i, k) / comb(degree, k) for i in n] for k in n])
    left = np.array([[comb(i, k) / 2.0**i for i in n] for k in n])
    return from_powers, left, left[::-1, ::-1].copy()


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
    candidates = np.flatnonzero(~keeps & (radius < sheet.pole))
    if candidates.size:
        r = radius[candidates]
        x, y = ideal[candidates, 0] / r, ideal[candidates, 1] / r
        a, b = p2 * x + p1 * y, p1 * x - p2 * y
        with np.errstate(over="ignore", invalid="ignore"):
            direction = sheet.plain + np.outer(a, sheet.tilted)
            direction += np.outer(3.0 * a * a - b * b, sheet.bent)
            keeps[candidates] = stay_positive(direction * np.vander(r, sheet.plain.size, True))
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


CAREFUL_STEPS = 40
"""Bound on the steps for points that whole steps lose: halved steps along a fold are many."""

MOST_HALVINGS = 12
"""Halvings of a step before it is given up."""


@dataclass(frozen=True, slots=True)
class DecentredLens:
    """The radial part and the tangential coefficients."""

    radial: RadialProfile
    p1: float
    """Coefficient of lens elements decentred along y."""
    p2: float
    """Coefficient of lens elements decentred along x."""

    def linearised(self, x: Floats, y: Floats) -> Linearisation:
        """Images of points, and the derivatives there."""
        r2 = x * x + y * y
        g, g_slope = scale_and_slope(self.radial, r2)
        along = g + 2.0 * (self.p1 * y + self.p2 * x)
        steepening = 2.0 * x * g_slope
        x_by_x = along + x * (steepening + 4.0 * self.p2)
        y_by_y = along + y * (2.0 * y * g_slope + 4.0 * self.p1)
        mixed = y * (steepening + 2.0 * self.p2) + 2.0 * self.p1 * x
        return x * along + self.p2 * r2, y * along + self.p1 * r2, x_by_x, mixed, y_by_y

    def on_sheet(self, ideal: Floats) -> Mask:
        """Whether the map preserves orientation all the way from the axis to points (N, 2)."""
        return on_sheet_of_axis(ideal, self.radial, self.p1, self.p2)

    @property
    def sure_radius(self) -> float:
        """Radius up to which the map preserves orientation in every direction."""
        return sheet_of(self.radial, self.p1, self.p2).sure


def undo_decentred(seen: Floats, start: Floats, lens: DecentredLens) -> tuple[Floats, Mask]:
    """Ideal points (..., 2) of seen ones, by Newton's method in the plane; and validity.

    ``start`` is the inverse by the radial part alone; invalid points stay there. Points are valid
    within `FURTHEST` if the lens maps them to the seen point and the map preserves orientation on
    the straight line from the axis to them. Points behind a fold are invalid even beyond the fold's
    end, as some of them share their image with a valid point.

    Whole Newton steps find nearly all points. The others are searched again by steps that never
    leave the sheet of the axis.
    """
    wanted, begin = seen.reshape(-1, 2), start.reshape(-1, 2)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        ideal = solve_in_plane(lens.linearised, wanted, begin)
        valid = _solved(ideal, wanted, lens)
        lost = np.flatnonzero(~valid & np.isfinite(wanted).all(axis=1))
        if lost.size:
            ideal[lost] = _newton_on_sheet(wanted[lost], begin[lost], lens)
            valid[lost] = _solved(ideal[lost], wanted[lost], lens)
    ideal = np.where(valid[:, None], ideal, begin)
    return ideal.reshape(seen.shape), np.asarray(valid.reshape(seen.shape[:-1]))


def _solved(ideal: Floats, wanted: Floats, lens: DecentredLens) -> Mask:
    """Which of the points (N, 2) have the wanted image and are on the sheet of the axis."""
    size = np.abs(wanted).max(axis=1, initial=0.0)
    solved = _residual(ideal, wanted, lens) <= 1e-11 * (1.0 + size)  # false for NaN
    solved &= np.hypot(ideal[:, 0], ideal[:, 1]) < FURTHEST
    solved[solved] = lens.on_sheet(ideal[solved])
    return np.asarray(solved)


def _residual(ideal: Floats, wanted: Floats, lens: DecentredLens) -> Floats:
    """Distance of the images of points (N, 2) from the wanted ones: the larger coordinate."""
    x, y, *_ = lens.linearised(ideal[:, 0], ideal[:, 1])
    return np.maximum(np.abs(x - wanted[:, 0]), np.abs(y - wanted[:, 1]))


def _newton_on_sheet(wanted: Floats, start: Floats, lens: DecentredLens) -> Floats:
    """Newton's method from well within the sheet, each step halved until it stays there and helps.

    Whole steps can jump over a fold and converge behind it. A point that no step helps stays
    unsolved.
    """
    radius = np.hypot(start[:, 0], start[:, 1])
    points = start * np.minimum(1.0, 0.9 * lens.sure_radius / np.maximum(radius, 1e-300))[:, None]
    off = _residual(points, wanted, lens)
    moving = np.arange(len(points))
    for _ in range(CAREFUL_STEPS):
        places = (*points[moving].T, *wanted[moving].T)
        step = np.stack(newton_step(lens.linearised, *places), axis=-1)
        stuck = np.ones(len(moving), bool)
        for halvings in range(MOST_HALVINGS):
            tried = points[moving[stuck]] - step[stuck] / 2.0**halvings
            nearer = _residual(tried, wanted[moving[stuck]], lens)
            helps = nearer < off[moving[stuck]]
            helps[helps] = lens.on_sheet(tried[helps])
            taken = np.flatnonzero(stuck)[helps]
            points[moving[taken]], off[moving[taken]] = tried[helps], nearer[helps]
            stuck[taken] = False
            if not stuck.any():
                break
        moving = moving[~stuck]
        if not moving.size:
            break
    return points
