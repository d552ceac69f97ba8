"""Newton's method for points of a plane: one 2×2 system each, all solved together."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

type Floats = NDArray[np.floating]

MOST_STEPS = 30
"""A bound on the work: from a start in reach of the root three or four are usual."""

SETTLED = 1e-9
"""A step smaller than this, relative to the point (to 1 near the origin), was the last needed."""

type Linearisation = tuple[Floats, Floats, Floats, Floats, Floats]
"""Images x', y' of points, and the derivatives of x' by x, of either by the other, of y' by y."""


def solve_in_plane(
    linearised: Callable[[Floats, Floats], Linearisation], wanted: Floats, start: Floats
) -> Floats:
    """Points near ``start`` that a map sends to ``wanted``, where the iteration finds them.

    Parameters
    ----------
    linearised : function of x and y, (N,) each
        The map with its derivatives: a symmetric matrix, as that of any gradient.
    wanted, start : (N, 2) floats

    Returns
    -------
    (N, 2) floats. Whoever calls asks the map whether they are solutions: a point may have run
    off, to NaN even. A point that has settled costs nothing more while others go on.
    """
    points = start.T.copy()
    moving = np.arange(len(start))
    for _ in range(MOST_STEPS):
        x, y = points[:, moving]
        step_x, step_y = _step(linearised, x, y, wanted[moving, 0], wanted[moving, 1])
        points[0, moving], points[1, moving] = x - step_x, y - step_y
        # The error was squared: at the next step nothing would be left to gain. NaN stops too.
        size = np.maximum(np.maximum(np.abs(x), np.abs(y)), 1.0)
        going = np.maximum(np.abs(step_x), np.abs(step_y)) > SETTLED * size
        if not going.any():
            break
        moving = moving[going]
    return points.T


def newton_step(
    linearised: Callable[[Floats, Floats], Linearisation], points: Floats, wanted: Floats
) -> Floats:
    """What one step of Newton's method subtracts from points (N, 2)."""
    return np.stack(_step(linearised, *points.T, *wanted.T), axis=-1)


def _step(
    linearised: Callable[[Floats, Floats], Linearisation],
    x: Floats,
    y: Floats,
    wanted_x: Floats,
    wanted_y: Floats,
) -> tuple[Floats, Floats]:
    """By Cramer's rule; all (N,)."""
    seen_x, seen_y, x_by_x, mixed, y_by_y = linearised(x, y)
    right, down = seen_x - wanted_x, seen_y - wanted_y
    determinant = x_by_x * y_by_y - mixed * mixed
    return (y_by_y * right - mixed * down) / determinant, (
        x_by_x * down - mixed * right
    ) / determinant
