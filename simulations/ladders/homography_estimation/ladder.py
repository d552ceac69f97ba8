"""A homography from noisy points: which error is minimised, and in which coordinates."""

from collections.abc import Callable
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.ladders.homography_estimation.estimators import (
    four_points,
    normalised,
    one_sided,
    plain,
    squared,
    two_sided,
)
from simulations.ladders.homography_estimation.matches import (
    VIEWS,
    Workload,
    mapped,
    prepare,
    true_map,
)
from simulations.models.arrays import Floats

type Estimates = tuple[Floats, ...]
"""(trials, 3, 3) for each view."""

LOST_PX = 1000.0
"""Upper bound of the error of a mapped point."""


def reference(workload: Workload) -> tuple[Floats, ...]:
    """The test grids mapped by the true homographies."""
    return tuple(
        true_map(view, matches.check) for view, matches in zip(VIEWS, workload, strict=True)
    )


def run(workload: Workload, *, estimate: Callable[[Floats, Floats], Floats]) -> Estimates:
    return tuple(
        np.stack([estimate(*pair) for pair in zip(matches.source, matches.target, strict=True)])
        for matches in workload
    )


def rms_px(
    result: Estimates,
    truth: tuple[Floats, ...],
    workload: Workload,
    *,
    views: tuple[str, ...],
) -> float:
    """RMS distance in the second picture, over the test grids of these views."""
    squares = []
    for view, H, true, matches in zip(VIEWS, result, truth, workload, strict=True):
        if view.name in views:
            ours = mapped(H.reshape(-1, 9), matches.check)
            squares.append(np.fmin(((ours - true) ** 2).sum(axis=-1), LOST_PX**2).ravel())
    return float(np.sqrt(np.concatenate(squares).mean()))


TIERS = (
    ("plain", "DLT in pixels, as a warning", "one 80 × 9 SVD", plain),
    ("four-points", "Four points", "one 8 × 8 system", four_points),
    ("squared", "Normalised DLT, AᵀA", "one 9 × 9 eigensystem", squared),
    ("normalised", "Normalised DLT", "one 80 × 9 SVD", normalised),
    (
        "one-sided",
        "AᵀA, then distances in the second picture",
        "one 9 × 9 eigensystem, two 8 × 8 systems",
        one_sided,
    ),
    (
        "two-sided",
        "AᵀA, then distances in both pictures",
        "one 9 × 9 eigensystem, two 8 × 8 systems, 2 × 80 weights",
        two_sided,
    ),
)
LADDER = Ladder(
    id="homography-estimation",
    title="A homography from noisy points",
    workload="33 times 40 matches on a poster and a slanted wall, 12 Mpx, "
    "σ = 0.5 px in both pictures",
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
    default_tier="two-sided",
    items=33,
    item="homography",
)
