"""Where in a photograph a chequerboard is: its grid of corners, to about a pixel.

The photograph is searched at a size of about two megapixels, and at half, a quarter, … of it, where
a blurred board is sharp again.
"""

from collections.abc import Iterator

import numpy as np

from simulations.models.arrays import Floats, Planes, quantile_of
from simulations.models.chequerboard.corner_links import link_corners, walk
from simulations.models.chequerboard.corner_windows import LUMA, Picture
from simulations.models.chequerboard.grid_recovery import FEWEST as SEED
from simulations.models.chequerboard.grid_recovery import MOST, corners_of, recover_grid
from simulations.models.chequerboard.local_lattice import Lattice, lattice_of, predict
from simulations.models.chequerboard.saddle_points import find_saddles, smoothed

STRIP = 64
"""Rows of the result that are made at once, which bounds the memory for large photographs."""


def reduced(picture: Picture, factor: int) -> Planes:
    """The means (h, w) of the luma of ``factor`` × ``factor`` pixels of codes (H, W) or (H, W, 3).

    Rows and columns left over are left out. Pixel (x, y) of the result is centred at
    factor · (x + ½) − ½ of the picture.
    """
    height, width = (length // factor for length in picture.shape[:2])
    colours = 1 if picture.ndim == 2 else 3
    weight = np.ones(1) if colours == 1 else np.array(LUMA)
    weights = np.tile(weight, factor).astype(np.float32) / np.float32(factor**2)
    grey = np.empty((height, width), np.float32)
    wide = np.uint16 if picture.dtype == np.uint8 and factor < 256 else np.float64
    for top in range(0, height, STRIP):
        rows = min(STRIP, height - top)
        strip = picture[top * factor : (top + rows) * factor, : width * factor]
        strip = strip.reshape(rows, factor, width * factor * colours)
        total = strip.sum(axis=1, dtype=wide) if factor > 1 else strip[:, 0]
        grey[top : top + rows] = (
            total.reshape(rows, width, factor * colours).astype(np.float32) @ weights
        )
    return grey


MEGAPIXELS = 2.2
"""Largest reduced photograph that is searched."""
SMALLEST_PX = 60
"""Least height or width of a reduced photograph."""
FEWEST, NARROWEST = 12, 3
"""Least number of corners, and of columns and rows, of a board."""
PART = 8
"""Corners of a grid from which on it may be a part of a board."""
FULLEST = 0.5
"""Least share of corners found within the columns and rows between the outermost ones."""
TRIES = 3
"""Connected grids that may be boards."""
SECOND = 0.35
"""Area, as a share of the largest board's, from which on a second one counts."""

NONE = "No chequerboard found; photograph the whole board, flat and evenly lit."
FEW = "Only {count} corners of a chequerboard found; photograph the whole board, without glare."
TWO = (
    "Two chequerboards found, or one of which too little is seen between two parts; "
    "leave only one in the picture, and all of it."
)


class NoBoardError(ValueError):
    """A photograph without usable corners; the message says why, and what to do."""


def search_board(picture: Picture) -> tuple[int, Lattice]:
    """The corners of the board in a photograph (H, W) or (H, W, 3) of codes.

    Returns
    -------
    factor : by how much the photograph was reduced where the board was found.
    lattice : the corners, in px of the reduced photograph.

    Raises
    ------
    NoBoardError
        For no board, only a few corners of one, and two boards of similar size.
    """
    best: tuple[int, Lattice] | None = None
    part = 0
    for factor in _factors(picture):
        boards, corners = _boards_in(smoothed(reduced(picture, factor)))
        part = max(part, corners)
        if len(boards) > 1 and _area(boards[1]) > SECOND * _area(boards[0]):
            raise NoBoardError(TWO)
        if boards and (
            best is None or _area(boards[0]) * factor**2 > _area(best[1]) * best[0] ** 2
        ):
            best = factor, boards[0]
        if boards and fullness(boards[0]) == 1.0:
            break
    if best is None:
        raise NoBoardError(FEW.format(count=part) if part else NONE)
    return best


def full_size(lattice: Lattice, factor: int) -> Lattice:
    """The lattice in px of the photograph that was reduced by this factor."""
    return Lattice(factor * (lattice.places + 0.5) - 0.5, lattice.light)


def fullness(board: Lattice) -> float:
    """Share of corners that are known between the outermost columns and rows."""
    _, indices = corners_of(board)
    columns, rows = np.ptp(indices, axis=0) + 1
    return len(indices) / float(columns * rows)


def _factors(picture: Picture) -> Iterator[int]:
    height, width = picture.shape[:2]
    factor = max(int(np.ceil(np.sqrt(height * width / (1e6 * MEGAPIXELS)))), 1)
    factor = min(factor, height, width)
    yield factor
    while min(height, width) // (2 * factor) >= SMALLEST_PX:
        factor *= 2
        yield factor


def _boards_in(smooth: Planes) -> tuple[list[Lattice], int]:
    """Boards, the largest first, and the corners of the largest grid that is too small for one."""
    saddles = find_saddles(smooth)
    boards: list[Lattice] = []
    part = 0
    for grid in walk(saddles, link_corners(saddles, smooth))[:TRIES]:
        if len(grid.places) < SEED or any(_covers(board, grid.places) for board in boards):
            continue
        lattice = recover_grid(smooth, lattice_of(grid.places, grid.indices, light=True))
        corners = int(lattice.known.sum())
        if not PART <= corners <= MOST or fullness(lattice) < FULLEST:
            continue
        columns_rows = np.ptp(corners_of(lattice)[1], axis=0) + 1
        if corners >= FEWEST and columns_rows.min() >= NARROWEST:
            boards.append(lattice)
        else:
            part = max(part, corners)
    return sorted(boards, key=lambda board: -_area(board)), part


def _covers(board: Lattice, places: Floats) -> bool:
    """Whether most of these corners lie on the board."""
    board_corners, _ = corners_of(board)
    distance = np.hypot(*(board_corners[:, None] - places).transpose(2, 0, 1)).min(axis=0)
    return bool(quantile_of(distance) < _spacing(board))


def _spacing(board: Lattice) -> float:
    return quantile_of(predict(board, np.argwhere(board.known)).spacing)


def _area(board: Lattice) -> float:
    seen = predict(board, np.argwhere(board.known))
    return float(np.sum(np.abs(np.linalg.det(np.stack([seen.across, seen.down], axis=1)))))
