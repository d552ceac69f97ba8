"""The inverse of a radial profile for a whole picture: a table of checked accuracy.

The inverse is the factor ρ = r / f(r) as a function of t = f(r)², the squared radius in the
picture: a point is multiplied by it, without a radius, a direction or an iteration. ρ(t) is smooth
but for a branch point t₀ where f turns back: the fold of a barrel, or a *negative* t for a
pincushion. ``u = √(1 − t/t₀)`` removes it. Where u grows without bound, the next bend of ρ is at u
= −1, and ``√(1 + u)`` removes that too. Short polynomials on equal cells of this variable give ρ to
nearly all digits, up to the fold.

Each cell is checked where the error of its polynomial is largest. Points whose cell errs by more
than `TOLERANCE`, or that are past the fold or out of reach, are left to
`radial_inverse.invert_bracketed`. So away from folds the table is less exact than the bracket. In
units of 2⁻⁵³ times the condition f / (r f'), its relative error is up to 21 for lenses of k₁ alone
and up to 3400 where k₁ and k₂ have opposite signs, and by the tolerance never more than 9000; that
of the bracket is 11 at most.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import frexp, sqrt

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.models.distortion.radial_inverse import furthest_radius
from simulations.models.distortion.radial_profile import (
    RadialProfile,
    fold_radius,
    image_of_fold,
    nearest_turning_image,
    scale,
    scale_and_slope,
)

FAR_FOLD = 64.0
"""A fold at this many times the wanted reach, as squared image radii, is ignored."""


@dataclass(frozen=True, slots=True)
class Grid:
    """Cells of equal width in a variable x of t: cell j is centred on ``first + j / density``."""

    bend: float
    """|t₀|."""
    folds: bool
    """If true, ``x = √(1 − t/t₀)``, from fold to axis; if not, ``x = √(1 + √(1 + t/|t₀|))``."""
    first: float
    density: float
    """Cells in a unit of x."""


def cell_of(grid: Grid, image_squared: Floats) -> Floats:
    """Position on the grid, in cells: x · density − first · density, in few passes."""
    unit = grid.density**2 if grid.folds else grid.density**4
    cell: Floats = image_squared * ((-unit if grid.folds else unit) / grid.bend)
    cell += unit
    np.sqrt(cell, out=cell)
    if not grid.folds:
        cell += grid.density**2
        np.sqrt(cell, out=cell)
    cell -= grid.first * grid.density
    return cell


def image_squared_at(grid: Grid, cell: Floats) -> Floats:
    """The inverse of `cell_of`."""
    x = grid.first + cell / grid.density
    if grid.folds:
        return grid.bend * (1.0 - x * x)
    u = x * x - 1.0
    return grid.bend * (u * u - 1.0)


def grid_for(profile: RadialProfile, limit: float, wanted_reach: float, cells: int) -> Grid:
    """Cells from the axis to the wanted reach, or to the fold if that is nearer."""
    if limit * limit < FAR_FOLD * wanted_reach:
        first = sqrt(max(1.0 - wanted_reach / (limit * limit), 0.0))
        return Grid(limit * limit, True, first, cells / (1.0 - first))
    # A bend far beyond the picture has no effect: √(1 + t/|t₀|) would hardly change.
    bend = max(min(nearest_turning_image(profile), wanted_reach), 1e-30)
    first, last = sqrt(2.0), sqrt(1.0 + sqrt(1.0 + wanted_reach / bend))
    return Grid(bend, False, first, cells / (last - first))


CELLS = (256, 2048)
"""Cells to try: the first is enough for most lenses, the second for some with bends close
together."""
DEGREE = 4
"""Degree of the polynomial in each cell."""
TOLERANCE = 1e-12
"""Largest relative error of ρ in a cell that is used: 2e-9 px where r = 1 and f = 2000 px."""
WORTH_A_TABLE = 2048
"""For fewer points, solving each is faster than making a table."""
LARGEST_REACH_LOG2 = 6
"""Squared image radius up to which a profile without a fold is tabulated, at most: 2⁶."""
GUESS_SAMPLES = 513
NEWTON_STEPS = 3
"""Newton steps from a guess by linear interpolation; each squares the error."""

NODES = 0.5 * np.cos(np.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1))
"""Chebyshev nodes, in cells."""
CHECKS = 0.5 * np.cos(np.pi * np.arange(DEGREE + 2) / (DEGREE + 1))
"""Places of the largest errors of a polynomial through the nodes: the edges, and between nodes."""
TO_POWERS = np.linalg.inv(np.vander(NODES, increasing=True))
"""From values at the nodes to coefficients of rising powers."""


@dataclass(frozen=True, slots=True)
class InverseTable:
    """ρ(t) as a polynomial for each cell of a grid."""

    grid: Grid
    coefficients: Floats
    """(DEGREE + 1, cells + 1) rising powers of the distance from the cell's centre, in cells."""
    reach: float
    """The squared image radius up to which every cell from the axis outwards has been checked."""


def shrinkage(profile: RadialProfile, image_squared: Floats) -> tuple[Floats, Mask]:
    """``r / f(r)`` for each ``f(r)²``, and where the table has it; 1 elsewhere.

    Other points may still have an inverse: use `invert_bracketed`.
    """
    furthest = float(image_squared.max())
    log2 = frexp(furthest)[1] if furthest < 2.0**LARGEST_REACH_LOG2 else LARGEST_REACH_LOG2
    table = inverse_table(profile, 2.0 ** max(log2, 0))
    known = image_squared < table.reach  # false for NaN
    if known.all():
        return _look_up(table, image_squared), known
    factor = np.ones_like(image_squared)
    if known.any():
        factor[known] = _look_up(table, image_squared[known])
    return factor, known


@lru_cache(maxsize=32)
def inverse_table(profile: RadialProfile, wanted_reach: float) -> InverseTable:
    """The table for one lens, up to the fold or, if there is none, to ``wanted_reach``.

    Pictures through one lens share a table, as reaches are rounded to powers of two.
    """
    fold = fold_radius(profile)
    limit = image_of_fold(profile, fold)
    with np.errstate(all="ignore"):  # a cell that overflows is not trusted
        furthest = furthest_radius(profile, fold, sqrt(wanted_reach))
        for cells in CELLS:
            grid = grid_for(profile, limit, wanted_reach, cells)
            nodes = image_squared_at(grid, np.arange(cells + 1) + NODES[:, None])
            ideal_squared = _solve(profile, grid, nodes, furthest**2)
            coefficients = TO_POWERS @ (1.0 / scale(profile, ideal_squared))
            reach = _checked_reach(profile, fold, grid, coefficients)
            if reach >= 0.999 * min(wanted_reach, limit * limit):
                break
    coefficients.flags.writeable = False
    return InverseTable(grid, coefficients, reach)


def _look_up(table: InverseTable, image_squared: Floats) -> Floats:
    cell = cell_of(table.grid, image_squared)
    nearest = np.rint(cell)
    cell -= nearest
    index = nearest.astype(np.intp)
    factor: Floats = table.coefficients[DEGREE].take(index, mode="clip")
    for power in range(DEGREE - 1, -1, -1):
        factor *= cell
        factor += table.coefficients[power].take(index, out=nearest, mode="clip")
    return factor


def _solve(profile: RadialProfile, grid: Grid, image_squared: Floats, furthest: float) -> Floats:
    """The squared ideal radius s for each t: Newton's method for ``s g(s)² = t``."""
    s = np.linspace(0.0, furthest, GUESS_SAMPLES)[:-1]
    outwards = -1.0 if grid.folds else 1.0
    cell_of_s = cell_of(grid, s * scale(profile, s) ** 2)
    guess: Floats = np.interp(outwards * cell_of(grid, image_squared), outwards * cell_of_s, s)
    for _ in range(NEWTON_STEPS):
        guess = guess - _excess(profile, guess, image_squared)
    return guess


def _excess(profile: RadialProfile, s: Floats, image_squared: Floats) -> Floats:
    """Error of s as a root of ``s g² = t``, to first order: (s g² − t) / (g f')."""
    g, g_slope = scale_and_slope(profile, s)
    return (s * g * g - image_squared) / (g * (g + 2.0 * s * g_slope))


def _checked_reach(profile: RadialProfile, fold: float, grid: Grid, coefficients: Floats) -> float:
    """The squared image radius up to which all cells, counted from the axis, meet `TOLERANCE`.

    The check is by the forward formula; inside the fold it has only one root.
    """
    cells = np.arange(coefficients.shape[1])
    image_squared = image_squared_at(grid, cells + CHECKS[:, None])
    factor = np.vander(CHECKS, DEGREE + 1, increasing=True) @ coefficients
    s = image_squared * factor * factor
    off = np.abs(_excess(profile, s, image_squared))
    good = np.all((off <= 2.0 * TOLERANCE * np.abs(s)) & (s < fold * fold), axis=0)
    outwards = slice(None, None, -1 if grid.folds else 1)
    bad = np.flatnonzero(~good[outwards])
    valid_count = int(bad[0]) if bad.size else good.size
    if not valid_count:
        return 0.0
    return float(image_squared.max(axis=0)[outwards][valid_count - 1])
