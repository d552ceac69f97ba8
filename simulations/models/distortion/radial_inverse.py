"""The inverse of a radial profile, slow and safe.

`invert_bracketed` works for all coefficients and detects radii without an inverse. `radial_table`
does the same for a whole picture in a fraction of the time, and uses this module for the points at
which it is not accurate.
"""

from math import inf

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask
from simulations.models.distortion.radial_profile import (
    RadialProfile,
    evaluate,
    fold_radius,
    image_of_fold,
    slope,
    slope_towards,
)

MAX_NEWTON_STEPS = 100
"""Bound on the steps; two or three are usual, more occur near the fold."""

GUESS_SAMPLES = 1025
"""Samples of f from which the first guess is interpolated."""

FURTHEST = 2.0**149
"""Largest radius of the search, 7e44: r⁶ and its products are still finite."""


def invert_bracketed(profile: RadialProfile, image_radius: ArrayLike) -> tuple[Floats, Mask]:
    """The radius ``r`` in [0, fold) with ``f(r) = image_radius``.

    Newton's method inside a bracket that every step tightens, with bisection where a step would
    leave it: it cannot diverge, in strong pincushion either, where fixed-point iteration does.

    Returns
    -------
    radius : (...) floats
        The fold radius (0 if there is none) for entries that are not valid.
    valid : (...) bools
        False where no such radius exists (past the fold or `FURTHEST`, negative or not finite),
        and so close before a pole that the radius rounds to the pole itself.
    """
    target = np.asarray(image_radius, float)
    fold = fold_radius(profile)
    valid = np.asarray(np.isfinite(target) & (target >= 0.0))
    valid &= target < image_of_fold(profile, fold)
    if profile.neutral:
        return np.where(valid, target, 0.0), valid
    radius = np.full(target.shape, fold if fold < inf else 0.0)
    wanted = target[valid]
    found = _solve(profile, wanted, furthest_radius(profile, fold, wanted))
    solved = _solved(profile, found, wanted)
    radius[valid] = np.where(solved, found, radius[valid])
    valid[valid] = solved
    return radius, valid


def _solved(profile: RadialProfile, found: Floats, wanted: Floats) -> Mask:
    """Whether the image is right to ten digits or, if the curve is steep, the radius is.

    Close to a pole the last bit of the radius changes the image by more than that.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        residual = np.abs(evaluate(profile, found) - wanted)
        steep = found * slope(profile, found)
    solved: Mask = residual <= 1e-10 * np.maximum(wanted, np.where(np.isfinite(steep), steep, 0.0))
    return solved


def furthest_radius(profile: RadialProfile, fold: float, wanted: Floats | float) -> float:
    """The fold, or a radius nearer to the axis whose image is beyond all wanted ones."""
    radius = 1.0
    while radius < min(fold, FURTHEST) and np.any(evaluate(profile, radius) <= wanted):
        radius *= 2.0
    return min(radius, fold)


def _solve(profile: RadialProfile, wanted: Floats, upper: float) -> Floats:
    low, high = np.zeros_like(wanted), np.full_like(wanted, upper)
    radius = _first_guess(profile, wanted, upper)
    for _ in range(MAX_NEWTON_STEPS):
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            excess = evaluate(profile, radius) - wanted
            step = radius - excess / slope_towards(profile, radius, wanted)
        short = excess < 0.0
        low, high = np.where(short, radius, low), np.where(short, high, radius)
        inside = (step >= low) & (step <= high)  # false for NaN
        following = np.where(inside, step, 0.5 * (low + high))
        # Newton squares the error: after a step of 1e-8 nothing is left to gain. If bisection has
        # run out of floats, it has found the end of the bracket and no root.
        settled = np.abs(following - radius) <= np.where(inside, 1e-8, 4e-16) * following
        radius = following
        if np.all(settled):
            break
    return radius


def _first_guess(profile: RadialProfile, wanted: Floats, upper: float) -> Floats:
    """By linear interpolation, with samples crowding where a fold flattens f."""
    u = np.linspace(0.0, 1.0, GUESS_SAMPLES)[:-1]
    radii = upper * u * (2.0 - u)
    with np.errstate(over="ignore", invalid="ignore"):
        images = evaluate(profile, radii)
    usable = np.isfinite(images)
    return np.interp(wanted, np.maximum.accumulate(images[usable]), radii[usable])
