"""What is kept of each photograph: the corners of its chequerboard, and what the file says.

All photographs may show different boards or parts of one, as the pose of each is found with the
side of its own squares as the unit of length.
"""

from collections.abc import Mapping
from typing import Any

from simulations.engine.photograph import Photograph
from simulations.engine.reading import UnfitError
from simulations.models.chequerboard.board_search import NoBoardError
from simulations.models.chequerboard.find_board import find_board

DIGITS = 4
"""Decimals of the corners in px."""


def read(photograph: Photograph) -> Mapping[str, Any]:
    """The size of the photograph in px, its corners in px with columns and rows, and its facts.

    Returns
    -------
    ``width`` and ``height``; ``corners``, pairs of x and y; ``indices``, pairs of column and row;
    ``columns`` and ``rows``, how many there are; ``blur_px``; ``facts``.

    Raises
    ------
    UnfitError
        With the sentence of `NoBoardError`.
    """
    try:
        board = find_board(photograph.codes)
    except NoBoardError as reason:
        raise UnfitError(str(reason)) from None
    height, width = photograph.codes.shape[:2]
    columns, rows = board.size
    return {
        "width": width,
        "height": height,
        "corners": board.places.round(DIGITS).tolist(),
        "indices": board.indices.tolist(),
        "columns": columns,
        "rows": rows,
        "blur_px": round(board.blur_px, 2),
        "facts": dict(photograph.facts),
    }
