"""The workload of the ladder of homography estimates: noisy matches of known homographies."""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats

TRIALS, POINTS = 16, 40
NOISE_PX = 0.5
"""Standard deviation in each coordinate of either picture."""


@dataclass(frozen=True, slots=True)
class View:
    """Matches of a flat object in two pictures, measured several times."""

    name: str
    homography: tuple[float, ...]
    """h₁₁ … h₃₂ in pixels; h₃₃ = 1."""
    low: tuple[float, float]
    """Corner of the object in the first picture that is nearest to pixel (0, 0)."""
    high: tuple[float, float]
    """The opposite corner."""
    noise_px: float
    """Standard deviation in each coordinate of either picture."""


@dataclass(frozen=True, slots=True)
class Matches:
    """The data of a view for an estimator, and the points for comparison."""

    exact: Floats
    """(trials, points, 2) true pixels of the first picture, hidden from the estimators."""
    source: Floats
    """(trials, points, 2) measured pixels of the first picture."""
    target: Floats
    """(trials, points, 2) measured pixels of the second picture."""
    check: Floats
    """(144, 2) pixels of the first picture, a grid over the object."""


FRONTAL = (0.92, -0.17, 310.0, 0.12, 0.88, -140.0, 4e-5, -6e-5)
SLANTED = (0.3, -0.05, 310.0, 0.04, 0.3, -140.0, -2e-4, -1e-5)
VIEWS = (
    View("poster", FRONTAL, (3000.0, 2000.0), (3500.0, 2375.0), NOISE_PX),
    View("wall", SLANTED, (0.0, 0.0), (4000.0, 3000.0), NOISE_PX),
    View("exact", SLANTED, (0.0, 0.0), (4000.0, 3000.0), 0.0),
)
"""A small poster off the middle, a wall seen at a slant, and that wall without noise.

The second picture shows the wall rectified: its far end, with the noise of the first picture, is
enlarged up to 34 times as much as its near end.
"""

type Workload = tuple[Matches, ...]
"""One for each of `VIEWS`."""


def prepare() -> Workload:
    return tuple(matches_of(view) for view in VIEWS)


def matches_of(view: View) -> Matches:
    rng = np.random.default_rng(13)
    trials = TRIALS if view.noise_px else 1
    exact = rng.uniform(view.low, view.high, (trials, POINTS, 2))
    source, target = (
        seen + view.noise_px * rng.standard_normal(seen.shape)
        for seen in (exact, true_map(view, exact))
    )
    x, y = np.linspace(view.low, view.high, 12).T
    return Matches(exact, source, target, np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2))


def true_map(view: View, points: Floats) -> Floats:
    """The places in the second picture of points (..., 2) of the first."""
    return mapped(np.append(view.homography, 1.0), points)


def mapped(h: Floats, points: Floats) -> Floats:
    """The two fractions written out: the reference shares no code with the estimators.

    ``h`` (..., 9) any multiple of the entries, ``points`` (N, 2) or (..., N, 2).
    """
    a, b, c, d, e, f, g, i, j = (h[..., entry, None] for entry in range(9))
    x, y = points[..., 0], points[..., 1]
    w = g * x + i * y + j
    return np.stack([(a * x + b * y + c) / w, (d * x + e * y + f) / w], axis=-1)
