"""A grid of corners seen locally: where its neighbours say that a corner is.

Over a few squares a chequerboard in a photograph is a homography of whole numbers, whatever the
lens does to the whole of it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats, Mask

REACH = 2
"""Columns and rows on each side that take part."""
FLAT = 0.04
"""Weight, beside each corner's, of perspective terms of 0: few corners do not tell them."""
FEWEST = 5
"""Corners that a prediction needs."""

type Whole = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Lattice:
    """Places of corners by row and column; NaN where none is known."""

    places: Floats
    """(R, C, 2) px, with a border of NaN at least one cell wide."""
    light: bool
    """Whether it is light between the directions of the columns and the rows at cell (0, 0)."""

    @property
    def known(self) -> Mask:
        """(R, C)"""
        return np.isfinite(self.places[..., 0])


@dataclass(frozen=True, slots=True)
class Prediction:
    """What the neighbours say of M cells."""

    places: Floats
    """(M, 2) px; NaN where there are too few neighbours."""
    across: Floats
    """(M, 2) px to the next column."""
    down: Floats
    """(M, 2) px to the next row."""

    @property
    def spacing(self) -> Floats:
        """(M,) distance to the nearest line of the lattice that does not pass through the cell."""
        area = np.abs(self.across[:, 0] * self.down[:, 1] - self.across[:, 1] * self.down[:, 0])
        longest = np.maximum(np.hypot(*self.across.T), np.hypot(*self.down.T))
        return area / np.maximum(longest, 1e-9)


def lattice_of(places: Floats, indices: Whole, light: bool, border: int = 1) -> Lattice:
    """From corners (N, 2) with columns and rows (N, 2) of any origin; ``light`` is at index 0."""
    low = indices.min(axis=0) - border
    columns, rows = indices.max(axis=0) + border + 1 - low
    grid = np.full((rows, columns, 2), np.nan)
    grid[indices[:, 1] - low[1], indices[:, 0] - low[0]] = places
    return Lattice(grid, bool(light ^ (int(low.sum()) % 2 == 1)))


def predict(lattice: Lattice, cells: Whole) -> Prediction:
    """Cells (M, 2), row and column, from their neighbours without themselves.

    A homography from steps of rows and columns to pixels, by linear least squares in coordinates of
    about 1, the nearer the heavier.
    """
    v, u = (axis.ravel().astype(float) for axis in np.mgrid[-REACH : REACH + 1, -REACH : REACH + 1])
    padded = np.pad(
        lattice.places, ((REACH, REACH), (REACH, REACH), (0, 0)), constant_values=np.nan
    )
    row = cells[:, :1] + REACH + v.astype(int)
    column = cells[:, 1:] + REACH + u.astype(int)
    near = padded[row, column]
    weight = np.isfinite(near[..., 0]) / np.maximum(u * u + v * v, 1.0)
    weight[:, u.size // 2] = 0.0
    enough = _spans(weight, u, v)
    near = np.nan_to_num(near)
    total = np.maximum(weight.sum(axis=1), 1e-9)[:, None, None]
    centre = (weight[..., None] * near).sum(axis=1, keepdims=True) / total
    size = np.sqrt((weight[..., None] * (near - centre) ** 2).sum(axis=(1, 2)) / total[:, 0, 0])
    size = np.maximum(size, 1e-9)[:, None, None]
    h = _homography(u, v, (near - centre) / size, weight)
    across = h[:, [0, 3]] - h[:, [2, 5]] * h[:, 6:7]
    down = h[:, [1, 4]] - h[:, [2, 5]] * h[:, 7:8]
    places = centre[:, 0] + size[:, 0] * h[:, [2, 5]]
    places[~enough] = np.nan
    return Prediction(places, size[:, 0] * across, size[:, 0] * down)


def _spans(weight: Floats, u: Floats, v: Floats) -> Mask:
    """(M,) whether there are enough neighbours, over at least two rows and two columns."""
    taken = weight > 0.0
    spans: Mask = taken.sum(axis=1) >= FEWEST
    for along in (u, v):
        low = np.where(taken, along, np.inf).min(axis=1)
        high = np.where(taken, along, -np.inf).max(axis=1)
        spans &= high > low
    return spans


def _homography(u: Floats, v: Floats, near: Floats, weight: Floats) -> Floats:
    """(M, 8) entries h₁₁ … h₃₂ with h₃₃ = 1."""
    count = len(near)
    system = np.zeros((count, 2, u.size, 8))
    for axis in range(2):
        system[:, axis, :, 3 * axis] = u
        system[:, axis, :, 3 * axis + 1] = v
        system[:, axis, :, 3 * axis + 2] = 1.0
        system[:, axis, :, 6] = -near[..., axis] * u
        system[:, axis, :, 7] = -near[..., axis] * v
    rows = system.reshape(count, -1, 8)
    right = np.moveaxis(near, -1, 1).reshape(count, -1, 1)
    weighted = np.swapaxes(rows * np.tile(weight, (1, 2))[..., None], 1, 2)
    flat = np.diag([1e-9] * 6 + [FLAT] * 2)
    solution: Floats = np.linalg.solve(weighted @ rows + flat, weighted @ right)[..., 0]
    return solution
