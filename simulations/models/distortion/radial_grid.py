"""The grid of a table of a radial profile's inverse: dense where the inverse bends.

See `radial_table` for ρ, t and u.
"""

from dataclasses import dataclass
from math import sqrt

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.distortion.radial_profile import RadialProfile, nearest_turning_image

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
