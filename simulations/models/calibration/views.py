"""Photographs of a flat board: where its corners lie on the board, and in each picture.

The board is the plane Z = 0 of its own frame, with the side of a square as the unit of length.
Pixel (0, 0) is centred at (0, 0).
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_vectors


@dataclass(frozen=True, slots=True)
class Views:
    """The corners of P photographs, as arrays of N, the largest number of corners in one."""

    board: Floats
    """(P, N, 2) on the board, in squares."""
    pixels: Floats
    """(P, N, 2) in the picture; 0 where there is no corner."""
    found: Mask
    """(P, N): where there is a corner."""

    @classmethod
    def stack(cls, photographs: Iterable[tuple[ArrayLike, ArrayLike]]) -> Self:
        """From pairs of corners on the board and in the picture, (N, 2) each.

        Raises `ValueError` for other shapes and numbers that are not finite.
        """
        pairs = [
            (as_vectors("board", board, 2), as_vectors("pixels", pixels, 2))
            for board, pixels in photographs
        ]
        for board, pixels in pairs:
            if board.ndim != 2 or board.shape != pixels.shape:
                raise ValueError(f"board {board.shape}, pixels {pixels.shape}; legal: both (N, 2)")
            if not (np.isfinite(board).all() and np.isfinite(pixels).all()):
                raise ValueError("corners; legal: finite numbers")
        most = max((len(board) for board, _ in pairs), default=0)
        stacked = np.zeros((2, len(pairs), most, 2))
        found = np.zeros((len(pairs), most), bool)
        for index, (board, pixels) in enumerate(pairs):
            stacked[0, index, : len(board)] = board
            stacked[1, index, : len(board)] = pixels
            found[index, : len(board)] = True
        return cls(stacked[0], stacked[1], found)

    def __len__(self) -> int:
        """The number of photographs."""
        return len(self.found)

    @property
    def corners(self) -> int:
        """The number of corners in all photographs."""
        return int(self.found.sum())

    def take(self, chosen: slice | Sequence[int]) -> "Views":
        """Some of the photographs."""
        index = chosen if isinstance(chosen, slice) else np.asarray(chosen, np.intp)
        return Views(self.board[index], self.pixels[index], self.found[index])

    def of(self, index: int) -> tuple[Floats, Floats]:
        """The corners of one photograph on the board and in the picture, (N, 2) each."""
        found = self.found[index]
        return self.board[index][found], self.pixels[index][found]
