"""Least squares by damped steps, for few unknowns."""

from collections.abc import Callable

import numpy as np

from simulations.models.arrays import Floats

WEAKEST = 1e-9
"""Share of the best determined unknown's information that every unknown is damped by at least."""

ROUNDS = 60
"""Most steps tried."""


def levenberg_marquardt[S](
    residuals: Callable[[S], tuple[Floats, Floats]],
    moved: Callable[[S, Floats], S],
    start: S,
) -> S:
    """The state near ``start`` whose residuals have the least sum of squares.

    A step solves (JᵀJ + μ D) δ = −Jᵀ r with D = diag JᵀJ. The damping μ falls tenfold after a step
    that lowers the sum, and grows tenfold after one that does not, which is not taken.

    Parameters
    ----------
    residuals : gives r (N,) and its derivatives J (N, M) by a step from a state.
    moved : the state a step (M,) away.

    Source: Marquardt, SIAM J. Appl. Math. 11, 1963; Hartley and Zisserman, 2nd ed., A6.2.
    """
    state, (r, J) = start, residuals(start)
    damping = 1e-3
    for _ in range(ROUNDS):
        information, slope = J.T @ J, J.T @ r
        weights = np.diag(information)
        weights = np.maximum(weights, WEAKEST * max(float(weights.max()), WEAKEST))
        trial = moved(state, np.linalg.solve(information + damping * np.diag(weights), -slope))
        r_trial, J_trial = residuals(trial)
        gain = float(r @ r - r_trial @ r_trial)
        if gain >= 0.0:
            ended = gain <= 1e-12 * float(r @ r)
            state, r, J, damping = trial, r_trial, J_trial, damping / 10.0
            if ended:
                break
        elif (damping := damping * 10.0) > 1e9:
            break
    return state
