"""The whole grid of a chequerboard, from corners that were linked to their neighbours.

Corners that do not lie where their neighbours say are removed; then the picture is searched where
further corners are expected: in gaps, such as glare leaves, and beyond the border.
"""

import numpy as np

from simulations.models.arrays import Floats, Mask, Planes, quantile_of
from simulations.models.chequerboard.local_lattice import (
    Lattice,
    Prediction,
    Whole,
    lattice_of,
    predict,
)
from simulations.models.chequerboard.quadratic_saddle import quadratic_saddle
from simulations.models.chequerboard.saddle_points import sample

ASTRAY = 0.2
"""Largest distance of a corner from its prediction, in spacings of the lattice."""
PALE = 0.2
"""Least contrast of a corner, as a share of the board's median."""
LEAST_CODES = 4.0
WIDEST_GAP = 2
"""Cells that may be missing between a corner and the rest."""
ROUNDS = 12
"""Rings of further corners that are looked for."""
FEWEST = 6
"""Corners of a grid that is worth completing."""
MOST = 1500
"""Corners from which on a grid is a fabric, not a board."""
QUADRANT = 0.3
"""Place of the samples within the four squares about a corner, in squares."""


def recover_grid(smooth: Planes, lattice: Lattice) -> Lattice:
    """The lattice without strays, and with all corners that the picture (H, W) shows."""
    lattice = in_squares(_without_strays(smooth, lattice))
    for _ in range(ROUNDS):
        if not FEWEST <= lattice.known.sum() <= MOST:
            break
        for gap in range(1, WIDEST_GAP + 1):
            grown = _grown(smooth, lattice, gap)
            if grown.known.sum() > lattice.known.sum():
                break
        else:
            break
        lattice = grown
    return in_squares(_without_strays(smooth, lattice))


def in_squares(lattice: Lattice) -> Lattice:
    """The corners that belong to a square whose four corners are known."""
    known = lattice.known
    full = known[:-1, :-1] & known[1:, :-1] & known[:-1, 1:] & known[1:, 1:]
    selected = np.zeros_like(known)
    for rows in (slice(None, -1), slice(1, None)):
        for columns in (slice(None, -1), slice(1, None)):
            selected[rows, columns] |= full
    return Lattice(np.where(selected[..., None], lattice.places, np.nan), lattice.light)


def corners_of(lattice: Lattice) -> tuple[Floats, Whole]:
    """Places (N, 2) of the known corners in px, and their columns and rows (N, 2)."""
    row, column = np.nonzero(lattice.known)
    return lattice.places[row, column], np.stack([column, row], axis=-1)


def contrasts(smooth: Planes, lattice: Lattice, cells: Whole, predicted: Prediction) -> Floats:
    """(M,) how much lighter the two light squares about a corner are than the two dark ones.

    The darker of the light ones is compared with the lighter of the dark ones, so that an edge or a
    T of edges has none.
    """
    sides = np.array([[1, 1], [-1, -1], [1, -1], [-1, 1]]) * QUADRANT
    vectors = np.stack([predicted.across, predicted.down], axis=1)
    values = sample(smooth, predicted.places[:, None] + sides @ vectors)
    odd = ((cells.sum(axis=1) % 2 == 1) ^ (not lattice.light))[:, None]
    values = np.where(odd, -values, values)
    return np.minimum(values[:, 0], values[:, 1]) - np.maximum(values[:, 2], values[:, 3])


def _without_strays(smooth: Planes, lattice: Lattice) -> Lattice:
    """Remove corners that lie astray or are none; a few at a time, the worst of their neighbours
    first."""
    for _ in range(6):
        places, indices = corners_of(lattice)
        if not len(places):
            break
        cells = indices[:, ::-1]
        predicted = predict(lattice, cells)
        error = np.hypot(*(places - predicted.places).T) / np.maximum(predicted.spacing, 1e-9)
        error = np.where(np.isfinite(error), error, np.inf)
        here = Prediction(places, predicted.across, predicted.down)
        error[_too_pale(contrasts(smooth, lattice, cells, here))] = np.inf
        bad = error > ASTRAY
        if not bad.any():
            break
        worst = bad & (error >= 0.7 * min(float(error.max()), 1e9))
        remaining = lattice.places.copy()
        remaining[cells[worst, 0], cells[worst, 1]] = np.nan
        lattice = Lattice(remaining, lattice.light)
    return lattice


def _too_pale(contrast: Floats) -> Mask:
    with np.errstate(invalid="ignore"):
        pale: Mask = ~(contrast > max(PALE * _median(contrast), LEAST_CODES))
    return pale


def _median(values: Floats) -> float:
    """Median of the entries that are numbers; 0 if none is."""
    numbers = values[np.isfinite(values)]
    return quantile_of(numbers) if numbers.size else 0.0


def _grown(smooth: Planes, lattice: Lattice, gap: int) -> Lattice:
    """With the corners found up to ``gap`` cells from the known ones."""
    places, indices = corners_of(lattice)
    lattice = lattice_of(places, indices, lattice.light, border=gap)
    cells = np.argwhere(_near(lattice.known, gap) & ~lattice.known)
    predicted = predict(lattice, cells)
    height, width = smooth.shape
    with np.errstate(invalid="ignore"):
        fits = np.all(
            (predicted.places > 3.0) & (predicted.places < [width - 4.0, height - 4.0]), axis=1
        )
        fits &= predicted.spacing > 3.0
    cells, predicted = cells[fits], _selected(predicted, fits)
    if not len(cells):
        return lattice
    radius = int(np.clip(round(0.35 * quantile_of(predicted.spacing)), 2, 6))
    found = quadratic_saddle(smooth, predicted.places, radius)
    astray = np.hypot(*(found - predicted.places).T) / predicted.spacing
    known_cells = np.argwhere(lattice.known)
    known = predict(lattice, known_cells)
    usual = _median(contrasts(smooth, lattice, known_cells, known))
    contrast = contrasts(
        smooth, lattice, cells, Prediction(found, predicted.across, predicted.down)
    )
    with np.errstate(invalid="ignore"):
        good = (astray < ASTRAY) & (contrast > max(PALE * usual, LEAST_CODES))
    grid = lattice.places.copy()
    grid[cells[good, 0], cells[good, 1]] = found[good]
    return Lattice(grid, lattice.light)


def _near(known: Mask, gap: int) -> Mask:
    """Cells within ``gap`` columns and rows of a known one."""
    padded = np.pad(known, gap)
    rows, columns = known.shape
    near = np.zeros_like(known)
    for down in range(2 * gap + 1):
        for right in range(2 * gap + 1):
            near |= padded[down : down + rows, right : right + columns]
    return near


def _selected(predicted: Prediction, mask: Mask) -> Prediction:
    return Prediction(predicted.places[mask], predicted.across[mask], predicted.down[mask])
