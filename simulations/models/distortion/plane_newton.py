"""Newton's method for points of a plane: one 2×2 system each, all solved together."""

from collections.abc import Callable

import numpy as np

from simulations.models.arrays import Floats

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
    found = np.empty_like(start)
    places = np.arange(len(start))
    (x, y), (wanted_x, wanted_y) = start.T.copy(), wanted.T.copy()
    for _ in range(MOST_STEPS):
        step_x, step_y = newton_step(linearised, x, y, wanted_x, wanted_y)
        # The error was squared: at the next step nothing would be left to gain. NaN stops too.
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
    """What one step of Newton's method subtracts from x and y, by Cramer's rule; all (...)."""
    seen_x, seen_y, x_by_x, mixed, y_by_y = linearised(x, y)
    right, down = seen_x - wanted_x, seen_y - wanted_y
    inverse = 1.0 / (x_by_x * y_by_y - mixed * mixed)
    return (y_by_y * right - mixed * down) * inverse, (x_by_x * down - mixed * right) * inverse
