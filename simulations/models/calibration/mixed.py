"""Photographs that one camera cannot have taken: turned, mirrored, or with another zoom or focus.

Each photograph's own focal length and principal point are estimated alone, with the rest of the
camera as all photographs have it. At the minimum a photograph's share of the camera's equations is
Sᵢ and gᵢ, and Σ gᵢ = 0 (`left_out`). With all others of the information S − Sᵢ, its own estimate is

    χ² = gᵢᵀ (Sᵢ⁻¹ + (S − Sᵢ)⁻¹) gᵢ / σ²

away from theirs. If one is too far for noise, the photographs are parted in the two groups that
agree best among themselves. J. MacQueen, *Some methods for classification*, 1967.
"""

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.bundle_adjustment import blocks_of, linearise, reduced
from simulations.models.calibration.camera import PINHOLE
from simulations.models.calibration.model_choice import Trial
from simulations.models.calibration.views import Views

APART = 16.0
"""χ² for each of the three numbers from which a photograph is by another camera. Errors of corners
that neighbours share reach 9 in photographs by one camera."""
CLEAR = 0.25
"""Share of all differences that two groups may leave within them; in photographs that each have a
focus of their own they leave a third."""
OPEN = 1e-6
"""Share of a mean photograph's information that counts as none: one board tells two numbers."""
ROUNDS = 10


def differing(views: Views, trial: Trial) -> tuple[int, ...]:
    """The smaller of two groups of photographs, if they differ; all, if each differs from the next;
    none, if all are by one camera."""
    fit, free = trial.fit, trial.free + trial.fit.poses.shape.names
    S, g = reduced(blocks_of(linearise(views, fit.camera, fit.poses, free)))
    by_own = np.zeros((len(free), 3))  # f as a share, c in px
    by_own[range(4), (0, 0, 1, 2)] = *fit.camera.values(PINHOLE[:2]), 1.0, 1.0
    S, g = by_own.T @ S @ by_own, g @ by_own
    every = S.sum(axis=0)
    S = S + OPEN / len(S) * np.diag(np.diagonal(every))
    own = -np.linalg.solve(S, g[..., None])[..., 0]
    gains = -(g * own).sum(axis=-1)
    others = np.linalg.solve(every - S, g[..., None])[..., 0]
    spare = 2 * views.corners - len(free) - 9 * len(views)
    noise = (fit.cost - gains.sum()) / max(spare, 1)
    apart = gains + (g * others).sum(axis=-1)
    if len(views) < 4 or spare < 1 or apart.max() < 3.0 * APART * noise:
        return ()
    lead, within = min((_parted(S, own, first) for first in own), key=lambda parted: parted[1])
    if within > CLEAR * np.einsum("pi,pij,pj", own, S, own):
        return tuple(range(len(views)))
    smaller = lead if 2 * np.count_nonzero(lead > 0.0) <= len(lead) else -lead
    return tuple(np.flatnonzero(smaller > 3.0 * APART * noise).tolist())


def _parted(S: Floats, own: Floats, first: Floats) -> tuple[Floats, float]:
    """Two groups of estimates (P, 3) of the information (P, 3, 3), from one at ``first`` and one
    at the common estimate: by how much (P,) each is nearer to the mean of the first, in squares,
    and how far all are from the means of their groups."""
    means: list[Floats] = [first, np.zeros(3)]
    for _ in range(ROUNDS):
        off = [own - mean for mean in means]
        far = np.array([np.einsum("pi,pij,pj->p", each, S, each) for each in off])
        is_first = far[0] < far[1]
        if is_first.all() or not is_first.any():
            break
        means = [
            np.linalg.solve(S[group].sum(axis=0), np.einsum("pij,pj->i", S[group], own[group]))
            for group in (is_first, ~is_first)
        ]
    return far[1] - far[0], float(far.min(axis=0).sum())
