"""What would change without some of the photographs, without calibrating anew.

At the minimum each picture contributes Sᵢ and gᵢ to the camera's equations (`normal_equations`),
and Σ gᵢ = 0. Without some of them, one Gauss–Newton step from the common minimum leads to the
minimum of the rest: what is left out is less than a standard error, and the equations are nearly
linear over that. It is the leave-one-out formula of linear regression. R. D. Cook, *Detection of
influential observation in linear regression*, 1977.
"""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.bundle_adjustment import (
    Adjusted,
    blocks_of,
    linearise,
    reduced,
    solve_scaled,
)
from simulations.models.calibration.views import Views

FEWER = 4.0
"""By how many fewer photographs, but at least half, the spread between them is divided: then three
errors hold a number as often as of a normal distribution (Student's t)."""


def steps_without(S: Floats, g: Floats) -> Floats:
    """(P, m) how the parameters change without each photograph; raises `LinAlgError`."""
    return solve_scaled(S.sum(axis=0) - S, g - g.sum(axis=0))


def left_out_px(views: Views, fit: Adjusted, free: tuple[str, ...]) -> Floats:
    """(P,) RMS distance of each photograph's corners from their prediction by all the others.

    The camera is that of the others, the pose that which fits best with this camera.
    Raises `LinAlgError` if the others do not determine the camera.
    """
    at = linearise(views, fit.camera, fit.poses, free)
    blocks = blocks_of(at)
    S, g = reduced(blocks)
    residual, counts = at.residual, views.found.sum(axis=-1)
    if free:
        residual = residual + (at.by_camera @ steps_without(S, g)[..., None])[..., 0]
    along = np.swapaxes(at.by_pose, -1, -2) @ residual[..., None]
    regained = (along * np.linalg.solve(blocks.V, along)).sum(axis=(-2, -1))
    squares = (residual * residual).sum(axis=-1) - regained
    return np.sqrt(np.maximum(squares, 0.0) / counts)


def spread(S: Floats, g: Floats) -> Floats:
    """(m) the jackknife's standard errors, from each photograph's part of the equations, widened as
    few photographs tell them roughly; 0 where they do not bear that one is left out."""
    try:
        moved = steps_without(S, g) + solve_scaled(S.sum(axis=0), g.sum(axis=0))
    except np.linalg.LinAlgError:
        return np.zeros(S.shape[-1])
    others = len(S) - 1.0
    few = others / max(others - FEWER, 0.5 * others)
    return np.sqrt(few * others / len(S) * (moved * moved).sum(axis=0))


@dataclass(frozen=True, slots=True)
class Growth:
    """A parameter and its standard error by the count of photographs; NaN while open."""

    counts: tuple[int, ...]
    value: Floats
    error: Floats


def values_by_count(
    views: Views,
    fit: Adjusted,
    free: tuple[str, ...],
    sigma_px: float,
    name: str,
    least: int,
    model_error: float = 0.0,
) -> Growth:
    """The parameter ``name`` from the first ``least``, ``least`` + 1, … photographs;
    ``model_error`` is its error by the choice of the model."""
    S, g = reduced(blocks_of(linearise(views, fit.camera, fit.poses, free)))
    index = free.index(name)
    first = getattr(fit.camera, name)
    counts = tuple(range(least, len(views) + 1))
    value, error = np.full((2, len(counts)), np.nan)
    unit = np.zeros(len(free))
    unit[index] = 1.0
    for place, count in enumerate(counts):
        S_n, g_n = S[:count], g[:count]
        try:
            value[place] = first - solve_scaled(S_n.sum(axis=0), g_n.sum(axis=0))[index]
            variance = solve_scaled(S_n.sum(axis=0), unit)[index]
        except np.linalg.LinAlgError:
            continue
        if variance > 0.0:
            larger = max(sigma_px * np.sqrt(variance), spread(S_n, g_n)[index])
            error[place] = np.hypot(larger, model_error)
    return Growth(counts, value, error)
