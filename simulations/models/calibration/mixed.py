"""Photographs that one camera cannot have taken: turned, mirrored, or with another zoom or focus.

Each photograph's own focal length and principal point are estimated alone, with the rest of the
camera as all photographs have it. At the minimum a photograph's share of the camera's equations is
Sᵢ and gᵢ, and Σ gᵢ = 0 (`left_out`). With all others of the information S − Sᵢ, its own estimate is

    χ² = gᵢᵀ (Sᵢ⁻¹ + (S − Sᵢ)⁻¹) gᵢ / σ²

away from theirs. A lens or a board that is not quite as modelled, and errors that neighbours share,
set photographs apart as well, but in a distortion of their own as much as in these three numbers.
So σ² is what a number of a distortion of their own gains on average, if that is more than noise.

Or the photographs are parted in two groups, whose cameras are θ + δ and θ − δ. With the sign sᵢ of
each, e = Σ sᵢ gᵢ and C = Σ sᵢ Sᵢ, the sum of squares falls by eᵀ (S − Cᵀ S⁻¹ C)⁻¹ e, in the space
of δ; the largest fall is found by changing one sign at a time, from signs at random, and again at
the camera of the larger group.

Both falls are judged by the F distribution, each multiplied by the number of choices that were
compared: photographs, and ways to part them.
"""

import math
from dataclasses import replace

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.models.calibration.bundle_adjustment import (
    Adjusted,
    blocks_of,
    linearise,
    reduced,
    refine,
)
from simulations.models.calibration.camera import PINHOLE
from simulations.models.calibration.model_choice import Trial
from simulations.models.calibration.views import Views
from simulations.models.calibration.zhang import UndeterminedError
from simulations.models.distortion.fisheye import Fisheye

FALSE_ALARMS = 5e-3
"""Share of sets by one camera that each of the two tests may suspect."""
AGAIN = 0.02
"""The same of those that are left, once some have been found to differ."""
OWN = "k1", "k2", "p1", "p2"
"""Numbers of a distortion of their own; of a fisheye the first two."""
OPEN = 1e-9
"""Share of the information that counts as none: one board tells two numbers."""
LEAST = 4
"""Photographs that can be compared."""
GROUPS = 3
"""Most groups that are taken away one after another."""
STARTS, ROUNDS = 30, 4


def differing(views: Views, trial: Trial) -> tuple[int, ...]:
    """The photographs that differ from the larger group, which are taken away in up to `GROUPS`
    steps until the rest may be by one camera; all, if half does not do; none, if none differs."""
    fit, free = trial.fit, trial.free + trial.fit.poses.shape.names
    own = OWN[:2] if isinstance(fit.camera.lens, Fisheye) else OWN
    every = range(len(views))
    rest, alarms = np.arange(len(views)), FALSE_ALARMS
    for _ in range(GROUPS):
        now = views.take(rest.tolist())
        found = _suspected(now, fit, free, own, alarms)
        if found is None:
            return tuple(index for index in every if index not in rest)
        free, alarms = (*dict.fromkeys(PINHOLE + own + free),), AGAIN
        try:
            fit, found = _larger(now, fit, free, own, found)
        except UndeterminedError:
            return tuple(index for index in every if index not in rest[~found])
        rest = rest[~found]
        if 2 * len(rest) < len(views):
            break
    return tuple(every)


def _larger(
    views: Views, fit: Adjusted, free: tuple[str, ...], own: tuple[str, ...], smaller: Mask
) -> tuple[Adjusted, Mask]:
    """The camera of the larger group, and the smaller group (P,) by that camera: one between the
    two may part them wrongly."""
    for _ in range(ROUNDS):
        found, larger = smaller, np.flatnonzero(~smaller).tolist()
        alone = refine(views.take(larger), fit.camera, fit.poses.take(larger), free)
        poses = replace(fit.poses, shape=alone.poses.shape)
        fit = refine(views, alone.camera, poses, (), draft=True)
        again = _suspected(views, fit, free, own, math.inf)
        if again is None or len(set(again ^ found)) == 1:
            break
        smaller = again
    return alone, found


def _suspected(
    views: Views, fit: Adjusted, free: tuple[str, ...], more: tuple[str, ...], false_alarms: float
) -> Mask | None:
    """The smaller of the two groups (P,) that differ most, unless all may be by one camera."""
    count, names = len(views), (*dict.fromkeys(PINHOLE + more + free),)
    spare = 2 * views.corners - len(free) - (9 + len(more)) * count
    if count < LEAST or spare < 1:
        return None
    S, g = reduced(blocks_of(linearise(views, fit.camera, fit.poses, names)))
    scale = 1.0 / np.sqrt(np.diagonal(S.sum(axis=0)))
    S, g = S * scale[:, None] * scale, g * scale
    own = np.eye(len(names))[:, 1 : 4 + len(more)]
    own[:2, 0] = fit.camera.values(PINHOLE[:2]) / scale[:2]
    own /= np.sqrt(np.diagonal(own.T @ S.sum(axis=0) @ own))
    share, each = g @ own, own.T @ S @ own
    first, first_each, both = share[:, :3], each[:, :3, :3], _falls(share, each).sum()
    gains = _falls(first, first_each)
    noise = (fit.cost - both) / spare
    noise = max(noise, float(both - gains.sum()) / (len(more) * count))
    by = [0, 1, 2, *range(5, own.shape[1])]  # without k1 and k2
    is_free = [names.index(name) for name in free]
    root = np.linalg.cholesky(S.sum(axis=0)[np.ix_(is_free, is_free)] + OPEN * np.eye(len(free)))
    across = np.linalg.solve(root, S[:, is_free] @ own[:, by])  # CᵀS⁻¹C is its square
    common = np.linalg.solve(root, g.sum(axis=0)[is_free])
    odd = share[:, by] - common @ across
    smaller, gain = _parted(odd, each.sum(axis=0)[np.ix_(by, by)], across)
    apart = gains + _falls(first, first_each.sum(axis=0) - first_each)
    left = 3 * (count - 1) - len(by)
    within = max(float(gains.sum()) - gain, left * noise)
    ways = math.comb(count, np.count_nonzero(smaller)) * (count // 2)
    alarms = (
        count * _exceeded(apart.max() / noise, 3, len(more) * count),
        ways * _exceeded(left * gain / within, len(by), left),
    )
    return smaller if min(alarms) < false_alarms else None


def _falls(slopes: Floats, matrices: Floats) -> Floats:
    """By how much sums of squares fall (...,) to the minimum of equations (..., m, m)."""
    steps = np.linalg.solve(matrices + OPEN * np.eye(slopes.shape[-1]), slopes[..., None])
    return np.asarray((slopes * steps[..., 0]).sum(axis=-1))


def _exceeded(squares: float, numbers: int, left: int) -> float:
    """Probability that noise makes this sum of squares of numbers whose σ² is the mean of the
    squares of ``left`` others: at most, as (1 − t)^(numbers/2 − 1) ≤ 1 in the incomplete beta
    function."""
    a, b = 0.5 * left, 0.5 * numbers
    x = left / (left + squares)
    return math.exp(a * math.log(x) + math.lgamma(a + b) - math.lgamma(a + 1.0) - math.lgamma(b))


def _parted(share: Floats, odd: Floats, across: Floats) -> tuple[Mask, float]:
    """The smaller of the two groups of photographs (P,) whose cameras differ most, and by how much
    the sum of squares falls with them; from S, g and C of the numbers that differ."""
    signs = np.random.default_rng(0).choice((-1.0, 1.0), (STARTS, len(share)))
    while True:
        e, C, twice = signs @ share, np.einsum("sp,pmk->smk", signs, across), 2.0 * signs[..., None]
        now = _falls(e, odd - np.swapaxes(C, -1, -2) @ C)
        e, C = e[:, None] - twice * share, C[:, None] - twice[..., None] * across
        then = _falls(e, odd - np.swapaxes(C, -1, -2) @ C)
        then[abs(signs.sum(axis=1, keepdims=True) - twice[..., 0]) > len(share) - 1] = 0.0
        best = then.argmax(axis=1)
        better = np.flatnonzero(then[range(STARTS), best] > now * (1.0 + OPEN))
        if not len(better):
            most = now.argmax()
            return signs[most] * (signs[most].sum() or 1.0) < 0.0, float(now[most])
        signs[better, best[better]] *= -1.0
