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
of δ; the largest fall is found by changing one sign at a time, from signs at random.

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
OPEN, RIDGE = 1e-6, 1e-9
"""Shares of the information that count as none: one board tells two numbers."""
LEAST = 4
"""Photographs that can be compared."""
GROUPS = 3
"""Most groups that are taken away one after another."""
STARTS, ROUNDS = 30, 100


def differing(views: Views, trial: Trial) -> tuple[int, ...]:
    """The photographs that differ from the larger group, which are taken away in up to `GROUPS`
    steps until the rest may be by one camera; all, if half does not do; none, if none differs."""
    fit, free = trial.fit, trial.free + trial.fit.poses.shape.names
    every = range(len(views))
    rest, alarms = list(every), FALSE_ALARMS
    for _ in range(GROUPS):
        found = _suspected(views.take(rest), fit, free, alarms)
        if found is None:
            return tuple(index for index in every if index not in rest)
        fit = replace(fit, poses=fit.poses.take(np.flatnonzero(~found).tolist()))
        rest = [index for index, is_odd in zip(rest, found, strict=True) if not is_odd]
        if 2 * len(rest) < len(views):
            break
        free, alarms = _with_own(fit, free), AGAIN
        try:
            fit = refine(views.take(rest), fit.camera, fit.poses, free)
        except UndeterminedError:
            return tuple(index for index in every if index not in rest)
    return tuple(every)


def _with_own(fit: Adjusted, free: tuple[str, ...]) -> tuple[str, ...]:
    """The free parameters, and `OWN` after focal lengths and principal point."""
    more = OWN[:2] if isinstance(fit.camera.lens, Fisheye) else OWN
    return (*dict.fromkeys(PINHOLE + more + free),)


def _suspected(
    views: Views, fit: Adjusted, free: tuple[str, ...], false_alarms: float
) -> Mask | None:
    """The smaller of the two groups (P,) that differ most, unless all may be by one camera."""
    count, names = len(views), _with_own(fit, free)
    more = tuple(name for name in names if name in OWN)
    S, g = reduced(blocks_of(linearise(views, fit.camera, fit.poses, names)))
    own = np.zeros((len(names), 3 + len(more)))  # f as a share, c in px
    own[range(4), (0, 0, 1, 2)] = *fit.camera.values(PINHOLE[:2]), 1.0, 1.0
    own[range(4, 4 + len(more)), range(3, 3 + len(more))] = 1.0
    gains, both = _gains(S, g, own[:, :3]), _gains(S, g, own)
    spare = 2 * views.corners - len(free) - (9 + len(more)) * count
    if count < LEAST or spare < 1:
        return None
    noise = (fit.cost - both.sum()) / spare
    noise = max(noise, float(both.sum() - gains.sum()) / (len(more) * count))
    is_free = [names.index(name) for name in free]
    by_odd = own[:, [0, 1, 2, *range(5, own.shape[1])]]  # without k1 and k2
    is_first, gain = _parted(S, g, by_odd, is_free)
    share, each = g @ own[:, :3], own[:, :3].T @ S @ own[:, :3]
    apart = gains + (share * _solved(each.sum(axis=0) - each, share)).sum(axis=-1)
    smaller = is_first if 2 * np.count_nonzero(is_first) <= count else ~is_first
    ways = math.comb(count, np.count_nonzero(smaller)) * (count // 2)
    numbers = by_odd.shape[1]
    left = 3 * (count - 1) - numbers
    within = max(float(gains.sum()) - gain, left * noise)
    alarms = (
        count * _exceeded(apart.max() / noise, 3, len(more) * count),
        ways * _exceeded(left * gain / within, numbers, left),
    )
    return smaller if min(alarms) < false_alarms else None


def _solved(matrices: Floats, right: Floats) -> Floats:
    """Solutions (..., m) of symmetric equations, without what they leave open."""
    scale = 1.0 / np.sqrt(np.maximum(np.diagonal(matrices, axis1=-2, axis2=-1), 1e-300))
    even = matrices * scale[..., :, None] * scale[..., None, :] + OPEN * np.eye(right.shape[-1])
    return np.asarray(scale * np.linalg.solve(even, (scale * right)[..., None])[..., 0])


def _gains(S: Floats, g: Floats, own: Floats) -> Floats:
    """(P,) by how much the sum of squares falls if a photograph has ``own`` (m, k) for itself."""
    share = g @ own
    return np.asarray((share * _solved(own.T @ S @ own, share)).sum(axis=-1))


def _exceeded(squares: float, numbers: int, left: int) -> float:
    """Probability that noise makes this sum of squares of numbers whose σ² is the mean of the
    squares of ``left`` others: at most, as (1 − t)^(numbers/2 − 1) ≤ 1 in the incomplete beta
    function."""
    a, b = 0.5 * left, 0.5 * numbers
    x = left / (left + squares)
    return math.exp(a * math.log(x) + math.lgamma(a + b) - math.lgamma(a + 1.0) - math.lgamma(b))


def _parted(S: Floats, g: Floats, by_odd: Floats, free: list[int]) -> tuple[Mask, float]:
    """The two groups of photographs (P,) whose cameras differ most, in what ``by_odd`` (m, k) has
    of the parameters, and by how much the sum of squares falls with them; common to both are those
    that are ``free``."""
    every = S.sum(axis=0)
    common = every[np.ix_(free, free)]
    scale = 1.0 / np.sqrt(np.diagonal(common))
    root = np.linalg.cholesky(common * scale * scale[:, None] + RIDGE * np.eye(len(free)))
    across = np.linalg.solve(root, scale[:, None] * (S[:, free] @ by_odd))  # CᵀS⁻¹C is its square
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
        then[abs(signs.sum(axis=1, keepdims=True) - twice[..., 0]) > len(S) - 1] = 0.0
        best = then.argmax(axis=1)
        better = np.flatnonzero(then[range(STARTS), best] > now * (1.0 + RIDGE))
        if not len(better):
            break
        signs[better, best[better]] *= -1.0
    first = int(now.argmax())
    return signs[first] > 0.0, float(now[first])
