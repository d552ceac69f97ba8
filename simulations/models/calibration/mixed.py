"""Photographs that one camera cannot have taken: turned, mirrored, or with another zoom or focus.

Each photograph's own focal length and principal point are estimated alone, with the rest of the
camera as all photographs have it. At the minimum a photograph's share of the camera's equations is
Sᵢ and gᵢ, and Σ gᵢ = 0 (`left_out`). With all others of the information S − Sᵢ, its own estimate is

    χ² = gᵢᵀ (Sᵢ⁻¹ + (S − Sᵢ)⁻¹) gᵢ / σ²

away from theirs. If one is too far for noise, the photographs are parted in two groups, whose
cameras are θ + δ and θ − δ. With the sign sᵢ of each, e = Σ sᵢ gᵢ and C = Σ sᵢ Sᵢ, the sum of
squares falls by eᵀ (S − Cᵀ S⁻¹ C)⁻¹ e, in the space of δ; the largest fall is found by changing
one sign at a time, from signs at random.
"""

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.models.calibration.bundle_adjustment import blocks_of, linearise, reduced
from simulations.models.calibration.camera import PINHOLE
from simulations.models.calibration.model_choice import Trial
from simulations.models.calibration.views import Views

APART = 16.0
"""χ² for each of the three numbers from which a photograph is by another camera. Errors of corners
that neighbours share reach 9 in photographs by one camera."""
CLEAR = 0.15
"""Share of all differences that two groups may leave within them; in photographs that each have a
focus of their own they leave a quarter."""
OPEN = 1e-6
"""Share of a mean photograph's information that counts as none: one board tells two numbers."""
RIDGE = 1e-9
"""Share of the information that keeps what photographs leave open from dividing by zero."""
STARTS, ROUNDS = 30, 100


def differing(views: Views, trial: Trial) -> tuple[int, ...]:
    """The smaller of two groups of photographs, if they differ; all, if each differs from the next;
    none, if all are by one camera."""
    fit, free = trial.fit, trial.free + trial.fit.poses.shape.names
    S, g = reduced(blocks_of(linearise(views, fit.camera, fit.poses, free)))
    by_own = np.zeros((len(free), 3))  # f as a share, c in px
    by_own[range(4), (0, 0, 1, 2)] = *fit.camera.values(PINHOLE[:2]), 1.0, 1.0
    own, share = by_own.T @ S @ by_own, g @ by_own
    every = own.sum(axis=0)
    own = own + OPEN / len(own) * np.diag(np.diagonal(every))
    gains = (share * np.linalg.solve(own, share[..., None])[..., 0]).sum(axis=-1)
    others = np.linalg.solve(every - own, share[..., None])[..., 0]
    spare = 2 * views.corners - len(free) - 9 * len(views)
    noise = (fit.cost - gains.sum()) / max(spare, 1)
    apart = gains + (share * others).sum(axis=-1)
    if len(views) < 4 or spare < 1 or apart.max() < 3.0 * APART * noise:
        return ()
    decentred = np.eye(len(free))[:, [name in ("p1", "p2") for name in free]]
    is_first, gain, losses = _parted(S, g, np.hstack((by_own, decentred)))
    if gain < (1.0 - CLEAR) * gains.sum():
        return tuple(range(len(views)))
    smaller = is_first if 2 * np.count_nonzero(is_first) <= len(views) else ~is_first
    noise = (fit.cost - gain) / spare
    return tuple(np.flatnonzero(smaller & (losses > 3.0 * APART * noise)).tolist())


def _parted(S: Floats, g: Floats, by_odd: Floats) -> tuple[Mask, float, Floats]:
    """The two groups of photographs (P,) whose cameras differ most, in what ``by_odd`` (m, k) has
    of the parameters; by how much the sum of squares falls with them, and by how much less (P,) if
    one photograph is in the other group."""
    every = S.sum(axis=0)
    scale = 1.0 / np.sqrt(np.diagonal(every))
    root = np.linalg.cholesky(every * scale * scale[:, None] + RIDGE * np.eye(len(every)))
    across = np.linalg.solve(root, scale[:, None] * (S @ by_odd))  # Cᵀ S⁻¹ C is its square
    share, odd = g @ by_odd, by_odd.T @ every @ by_odd

    def gain(e: Floats, C: Floats) -> Floats:
        left = odd - np.swapaxes(C, -1, -2) @ C
        left = left + RIDGE * np.diag(np.diagonal(odd))
        return np.asarray((e * np.linalg.solve(left, e[..., None])[..., 0]).sum(axis=-1))

    signs = np.random.default_rng(0).choice((-1.0, 1.0), (STARTS, len(S)))
    for _ in range(ROUNDS):
        e, C = signs @ share, np.einsum("sp,pmk->smk", signs, across)
        now = gain(e, C)
        twice = 2.0 * signs[..., None]
        then = gain(e[:, None] - twice * share, C[:, None] - twice[..., None] * across)
        best = then.argmax(axis=1)
        better = np.flatnonzero(then[range(STARTS), best] > now * (1.0 + RIDGE))
        if not len(better):
            break
        signs[better, best[better]] *= -1.0
    first = int(now.argmax())
    return signs[first] > 0.0, float(now[first]), now[first] - then[first]
