"""Whether polynomials are positive on an interval, decided without sampling.

Written in Bernstein's basis, a polynomial lies between its smallest and its largest coefficient,
and the first and the last are its values at the ends. If all are positive, so is the polynomial; if
an end is not positive, the polynomial is not. Intervals that neither rule decides are halved.

Source: Farouki, The Bernstein polynomial basis: a centennial retrospective, 2012, §§3 and 5.
"""

from functools import lru_cache
from math import comb

import numpy as np

from simulations.models.arrays import Floats, Mask

MOST_HALVINGS = 26
"""Halvings, after which an undecided polynomial is zero to half of its digits."""


def stay_positive(coefficients: Floats) -> Mask:
    """Whether Σ cₖ tᵏ > 0 for all t from 0 to 1.

    Parameters
    ----------
    coefficients : (N, n + 1) floats
        Rising powers, a polynomial in each row.

    Returns
    -------
    (N,) bools; False also where a coefficient is not finite, and where a polynomial touches zero.
    """
    positive: Mask = np.asarray(np.isfinite(coefficients).all(axis=1))
    owner = np.flatnonzero(positive)
    from_powers, left, right = _changes_of_basis(coefficients.shape[1] - 1)
    pieces = coefficients[owner] @ from_powers
    for _ in range(MOST_HALVINGS):
        positive[owner[(pieces[:, 0] <= 0.0) | (pieces[:, -1] <= 0.0)]] = False
        open_still = positive[owner] & ~(pieces > 0.0).all(axis=1)
        owner, pieces = owner[open_still], pieces[open_still]
        if not owner.size:
            return positive
        owner, pieces = np.tile(owner, 2), np.concatenate((pieces @ left, pieces @ right))
    positive[owner] = False
    return positive


@lru_cache
def _changes_of_basis(degree: int) -> tuple[Floats, Floats, Floats]:
    """Matrices, multiplied from the right: powers to Bernstein's basis, and to each half."""
    n = range(degree + 1)
    from_powers = np.array([[comb(i, k) / comb(degree, k) for i in n] for k in n])
    left = np.array([[comb(i, k) / 2.0**i for i in n] for k in n])
    return from_powers, left, left[::-1, ::-1].copy()
