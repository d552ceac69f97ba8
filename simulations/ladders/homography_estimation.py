"""A homography from noisy points: which error is minimised, and in which coordinates."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.homography_estimation import estimate_homography, normalisation
from simulations.models.transforms import apply_homography, projective

type Floats = NDArray[np.floating]

TRIALS, POINTS = 16, 40
NOISE_PX = 0.5
"""Standard deviation in each coordinate of the second picture."""


@dataclass(frozen=True, slots=True)
class View:
    """Matches of one flat thing in two pictures, measured several times over."""

    name: str
    homography: tuple[float, ...]
    """h₁₁ … h₃₂ in pixels; h₃₃ = 1."""
    low: tuple[float, float]
    """Corner of the thing in the first picture that is nearest pixel (0, 0)."""
    high: tuple[float, float]
    """The opposite corner."""
    noise_px: float
    """Standard deviation in each coordinate of the second picture."""


@dataclass(frozen=True, slots=True)
class Matches:
    """What a view gives an estimator, and where its estimate is judged."""

    source: Floats
    """(trials, points, 2) pixels, exact."""
    target: Floats
    """(trials, points, 2) pixels."""
    check: Floats
    """(144, 2) pixels of the first picture, a grid over the thing."""


FRONTAL = (0.92, -0.17, 310.0, 0.12, 0.88, -140.0, 4e-5, -6e-5)
OBLIQUE = (0.92, -0.17, 310.0, 0.12, 0.88, -140.0, 1e-3, -1e-4)
VIEWS = (
    View("poster", FRONTAL, (3000.0, 2000.0), (3500.0, 2375.0), NOISE_PX),
    View("wall", OBLIQUE, (0.0, 0.0), (4000.0, 3000.0), NOISE_PX),
    View("exact", OBLIQUE, (0.0, 0.0), (4000.0, 3000.0), 0.0),
)
"""A small poster off the middle, a wall that recedes steeply, and that wall without noise."""

type Workload = tuple[Matches, ...]
"""One for each of `VIEWS`."""


def prepare() -> Workload:
    return tuple(_matches(view) for view in VIEWS)


def _matches(view: View) -> Matches:
    rng = np.random.default_rng(13)
    trials = TRIALS if view.noise_px else 1
    source = rng.uniform(view.low, view.high, (trials, POINTS, 2))
    target = true_map(view, source) + view.noise_px * rng.standard_normal(source.shape)
    x, y = np.linspace(view.low, view.high, 12).T
    return Matches(source, target, np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2))


def true_map(view: View, points: Floats) -> Floats:
    """The two fractions written out: the judge shares no code with what it judges."""
    a, b, c, d, e, f, g, h = view.homography
    x, y = points[..., 0], points[..., 1]
    w = g * x + h * y + 1.0
    mapped: Floats = np.stack([(a * x + b * y + c) / w, (d * x + e * y + f) / w], axis=-1)
    return mapped


def reference(workload: Workload) -> tuple[Floats, ...]:
    """Where the true homographies take the judging grids."""
    return tuple(
        true_map(view, matches.check) for view, matches in zip(VIEWS, workload, strict=True)
    )


def four_points(source: Floats, target: Floats) -> Floats:
    """Exactly through the four matches farthest out along the diagonals; the rest is ignored."""
    sums, differences = source.sum(axis=1), source[:, 0] - source[:, 1]
    four = [sums.argmin(), differences.argmax(), sums.argmax(), differences.argmin()]
    return estimate_homography(source[four], target[four])[0]


def plain(source: Floats, target: Floats) -> Floats:
    """Direct linear transform in pixels as they come: columns of 1 beside columns of 10⁷."""
    return _null_vector(_system(source, target))


def squared(source: Floats, target: Floats) -> Floats:
    """Normalised, by the 9 × 9 matrix AᵀA: one size for any number of points.

    Squaring halves the digits of an ill-posed problem; normalised, this one is far from that.
    """
    T, U = _normalisations(source, target)
    A = _system(apply_homography(T, source)[0], apply_homography(U, target)[0])
    smallest = np.linalg.eigh(A.T @ A)[1][:, 0].reshape(3, 3)
    H: Floats = np.linalg.solve(U, smallest @ T)
    return H


def normalised(source: Floats, target: Floats) -> Floats:
    return estimate_homography(source, target)[0]


def refined(source: Floats, target: Floats) -> Floats:
    """From `squared`, two Gauss–Newton steps on the distance in pixels: maximum likelihood."""
    T, U = _normalisations(source, target)
    before, after = apply_homography(T, source)[0], apply_homography(U, target)[0]
    H = U @ squared(source, target) @ np.linalg.inv(T)
    h = (H / H[2, 2]).reshape(9)[:8]
    for _ in range(2):
        residual, slope = _residual_and_slope(h, before, after)
        h = h - np.linalg.solve(slope.T @ slope, slope.T @ residual)
    refined_H: Floats = np.linalg.solve(U, np.append(h, 1.0).reshape(3, 3) @ T)
    return refined_H


def _residual_and_slope(h: Floats, before: Floats, after: Floats) -> tuple[Floats, Floats]:
    """Mapped minus measured, (2N,), and its derivatives by the eight free entries, (2N, 8)."""
    ones = np.column_stack([before, np.ones(len(before))])
    w = before @ h[6:] + 1.0
    mapped = np.column_stack([ones @ h[:3], ones @ h[3:6]]) / w[:, None]
    rows, zero = ones / w[:, None], np.zeros_like(ones)
    slope_x = np.hstack([rows, zero, -mapped[:, :1] * rows[:, :2]])
    slope_y = np.hstack([zero, rows, -mapped[:, 1:] * rows[:, :2]])
    return (mapped - after).T.reshape(-1), np.concatenate([slope_x, slope_y])


def _normalisations(source: Floats, target: Floats) -> tuple[Floats, Floats]:
    T, U = normalisation(np.asarray(source, float)), normalisation(np.asarray(target, float))
    if T is None or U is None:
        raise ValueError("matches; legal: points that do not coincide")
    return T, U


def _system(before: Floats, after: Floats) -> Floats:
    """(2N, 9): x' (h₃·x) = h₁·x and y' (h₃·x) = h₂·x."""
    ones = np.column_stack([before, np.ones(len(before))])
    zero = np.zeros_like(ones)
    first = np.hstack([ones, zero, -after[:, :1] * ones])
    return np.concatenate([first, np.hstack([zero, ones, -after[:, 1:] * ones])])


def _null_vector(system: Floats) -> Floats:
    null_vector: Floats = np.linalg.svd(system, full_matrices=False)[2][8]
    return null_vector.reshape(3, 3)


def run(workload: Workload, *, estimate: Callable[[Floats, Floats], Floats]) -> tuple[Floats, ...]:
    """Where each trial's estimate takes the judging grid, (trials, 144, 2) a view.

    A null vector comes with either sign; `projective` picks the one that sees the origin.
    """
    return tuple(
        np.stack(
            [
                apply_homography(projective(estimate(source, target)), matches.check)[0]
                for source, target in zip(matches.source, matches.target, strict=True)
            ]
        )
        for matches in workload
    )


def rms_px(
    result: tuple[Floats, ...],
    truth: tuple[Floats, ...],
    _workload: Workload,
    *,
    views: tuple[str, ...],
) -> float:
    """RMS distance on the judging grids. A point that is lost counts as 1000 px off."""
    squares = [
        np.fmin(((ours - true) ** 2).sum(axis=-1), 1e6).ravel()
        for view, ours, true in zip(VIEWS, result, truth, strict=True)
        if view.name in views
    ]
    return float(np.sqrt(np.concatenate(squares).mean()))


TIERS = (
    ("plain", "DLT in pixels", "one 80 × 9 SVD", plain),
    ("squared", "Normalised DLT, AᵀA", "one 9 × 9 eigensystem", squared),
    ("four-points", "Four points", "one 8 × 9 SVD, checks", four_points),
    ("normalised", "Normalised DLT", "one 80 × 9 SVD, checks", normalised),
    ("refined", "AᵀA, then least squares", "one 9 × 9 eigensystem, two 8 × 8 solves", refined),
)
LADDER = Ladder(
    id="homography-estimation",
    title="A homography from noisy points",
    workload="33 times 40 matches on a poster and a receding wall, 12 Mpx, σ = 0.5 px",
    prepare=prepare,
    tiers=tuple(
        Tier(name, label, cost, partial(run, estimate=estimate))
        for name, label, cost, estimate in TIERS
    ),
    reference=reference,
    reference_label="the homographies that made the matches",
    metrics=(
        Metric("rms", "RMS error", "px", partial(rms_px, views=("poster", "wall"))),
        Metric("poster", "RMS error, poster only", "px", partial(rms_px, views=("poster",))),
        Metric("wall", "RMS error, wall only", "px", partial(rms_px, views=("wall",))),
        Metric("exact", "RMS error without noise", "px", partial(rms_px, views=("exact",))),
    ),
    default_tier="refined",
)
