"""Newton's method for points of a plane: one 2×2 system each, all solved together."""

from collections.abc import Callable

import numpy as np

from simulations.models.arrays import Floats

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
