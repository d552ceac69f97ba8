"""A homography from noisy points: which error is minimised, and in which coordinates.

The estimators take matched points (N, 2) and return H (3, 3), of any scale and sign. They omit the
checks of `models.geometry.homography_estimation`, so that only the method is timed.

Source: Hartley and Zisserman, Multiple View Geometry, 2nd ed., §4.1, §4.2 and §4.4.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
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

    view: View
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


def draw(index: int) -> Workload:
    """Other matches and noise, with views that are slanted from half as much to a tenth more."""
    slant = np.random.default_rng(index).uniform(0.5, 1.1)
    views = (replace(view, homography=_slanted(view.homography, slant)) for view in VIEWS)
    return tuple(matches_of(view, 100 + index) for view in views)


def _slanted(homography: tuple[float, ...], factor: float) -> tuple[float, ...]:
    return (*homography[:6], *(factor * each for each in homography[6:]))


def matches_of(view: View, seed: int = 13) -> Matches:
    rng = np.random.default_rng(seed)
    trials = TRIALS if view.noise_px else 1
    exact = rng.uniform(view.low, view.high, (trials, POINTS, 2))
    source, target = (
        mapped_points + view.noise_px * rng.standard_normal(mapped_points.shape)
        for mapped_points in (exact, true_map(view, exact))
    )
    x, y = np.linspace(view.low, view.high, 12).T
    return Matches(view, exact, source, target, np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2))


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


type Estimates = tuple[Floats, ...]
"""(trials, 3, 3) for each view."""

LOST_PX = 1000.0
"""Upper bound of the error of a mapped point."""


def reference(workload: Workload) -> tuple[Floats, ...]:
    """The test grids mapped by the true homographies."""
    return tuple(true_map(matches.view, matches.check) for matches in workload)


def run(workload: Workload, *, estimate: Callable[[Floats, Floats], Floats]) -> Estimates:
    return tuple(
        np.stack([estimate(*pair) for pair in zip(matches.source, matches.target, strict=True)])
        for matches in workload
    )


def rms_px(
    result: Estimates, truth: tuple[Floats, ...], workload: Workload, *, views: tuple[str, ...]
) -> float:
    """RMS distance in the second picture, over the test grids of these views."""
    squares = []
    for H, true, matches in zip(result, truth, workload, strict=True):
        if matches.view.name in views:
            estimated = mapped(H.reshape(-1, 9), matches.check)
            squares.append(np.fmin(((estimated - true) ** 2).sum(axis=-1), LOST_PX**2).ravel())
    return float(np.sqrt(np.concatenate(squares).mean()))


STEPS = 2
"""Steps of Gauss–Newton: from a normalised start the second changes less than the noise."""


def plain(source: Floats, target: Floats) -> Floats:
    """Direct linear transform in pixels, with columns of 1 next to columns of 10⁷."""
    return _null_vector(_system(source, target))


def normalised(source: Floats, target: Floats) -> Floats:
    before, T, _ = _normalise(source)
    after, _, U_inverse = _normalise(target)
    return U_inverse @ _null_vector(_system(before, after)) @ T


def squared(source: Floats, target: Floats) -> Floats:
    """Normalised, by the 9 × 9 matrix AᵀA, whose size does not depend on the number of points.

    Squaring halves the digits of an ill-conditioned problem; normalised, this one is
    well-conditioned.
    """
    before, T, _ = _normalise(source)
    after, _, U_inverse = _normalise(target)
    return U_inverse @ _smallest_eigenvector(_system(before, after)) @ T


def four_points(source: Floats, target: Floats) -> Floats:
    """Exact for the four matches farthest out along the diagonals; the others are ignored."""
    sums, differences = source.sum(axis=1), source[:, 0] - source[:, 1]
    four = [sums.argmin(), differences.argmax(), sums.argmax(), differences.argmin()]
    before, T, _ = _normalise(source[four])
    after, _, U_inverse = _normalise(target[four])
    system = _system(before, after)
    h = np.append(np.linalg.solve(system[:, :8], -system[:, 8]), 1.0)
    return U_inverse @ h.reshape(3, 3) @ T


def one_sided(source: Floats, target: Floats) -> Floats:
    """From `squared`, least squares of the distances in the second picture.

    The most likely homography if the points of the first picture were exact.
    """
    return _refined(source, target, source_noise=0.0)


def two_sided(source: Floats, target: Floats) -> Floats:
    """The same, each match weighted by the noise of *both* its points (Sampson's distance).

    The map enlarges the noise of the first picture by its derivatives J, so that a residual has the
    covariance I + J Jᵀ in units of the noise.
    """
    return _refined(source, target, source_noise=1.0)


def _refined(source: Floats, target: Floats, *, source_noise: float) -> Floats:
    before, T, _ = _normalise(source)
    after, U, U_inverse = _normalise(target)
    h = _smallest_eigenvector(_system(before, after)).reshape(9)
    h = h / h[8]
    for _ in range(STEPS):
        residual, slope, J = _linearised(h, before, after)
        if source_noise:
            # In normalised units, the noise of the two pictures differs by their scales.
            _whiten(residual, slope, J * (source_noise * T[0, 0] / U[0, 0]))
        flat = slope.reshape(-1, 8)
        h[:8] -= np.linalg.solve(flat.T @ flat, flat.T @ residual.reshape(-1))
    return U_inverse @ h.reshape(3, 3) @ T


def _linearised(h: Floats, before: Floats, after: Floats) -> tuple[Floats, Floats, Floats]:
    """Mapped minus measured points, and the derivatives by eight entries of h and by the source
    point.

    (2, N), (2, N, 8) and (2, 2, N).
    """
    x, y = before.T
    inverse_w = 1.0 / (h[6] * x + h[7] * y + h[8])
    mapped_points = np.stack((h[0] * x + h[1] * y + h[2], h[3] * x + h[4] * y + h[5])) * inverse_w
    slope = np.zeros((2, len(before), 8))
    for axis in range(2):
        slope[axis, :, 3 * axis] = x * inverse_w
        slope[axis, :, 3 * axis + 1] = y * inverse_w
        slope[axis, :, 3 * axis + 2] = inverse_w
        slope[axis, :, 6] = -mapped_points[axis] * x * inverse_w
        slope[axis, :, 7] = -mapped_points[axis] * y * inverse_w
    linear = h[:6].reshape(2, 3)[:, :2, None]
    J = (linear - mapped_points[:, None] * h[6:8, None]) * inverse_w
    return mapped_points - after.T, slope, J


def _whiten(residual: Floats, slope: Floats, J: Floats) -> None:
    """Whiten residuals in place, by Cholesky factors of I + J Jᵀ."""
    xx, yy = 1.0 + (J * J).sum(axis=1)
    xy = (J[0] * J[1]).sum(axis=0)
    first = 1.0 / np.sqrt(xx)
    lean = xy * first
    second = 1.0 / np.sqrt(yy - lean * lean)
    residual[0] *= first
    residual[1] = (residual[1] - lean * residual[0]) * second
    slope[0] *= first[:, None]
    slope[1] = (slope[1] - lean[:, None] * slope[0]) * second[:, None]


def _normalise(points: Floats) -> tuple[Floats, Floats, Floats]:
    """Points about 0 at a mean distance of √2, the matrix that maps to them, and its inverse."""
    centre = points.mean(axis=0)
    moved = points - centre
    scale = math.sqrt(2.0) / float(np.sqrt((moved * moved).sum(axis=1)).mean())
    x, y = centre.tolist()
    T = np.array([[scale, 0.0, -scale * x], [0.0, scale, -scale * y], [0.0, 0.0, 1.0]])
    return moved * scale, T, np.array([[1 / scale, 0.0, x], [0.0, 1 / scale, y], [0.0, 0.0, 1.0]])


def _system(before: Floats, after: Floats) -> Floats:
    """(2N, 9): x' (h₃·x) = h₁·x and y' (h₃·x) = h₂·x."""
    n = len(before)
    rows = np.zeros((2, n, 9))
    for axis in range(2):
        rows[axis, :, 3 * axis : 3 * axis + 2] = before
        rows[axis, :, 3 * axis + 2] = 1.0
        rows[axis, :, 6:8] = -after[:, axis, None] * before
        rows[axis, :, 8] = -after[:, axis]
    return rows.reshape(2 * n, 9)


def _null_vector(system: Floats) -> Floats:
    null_vector: Floats = np.linalg.svd(system, full_matrices=False)[2][8]
    return null_vector.reshape(3, 3)


def _smallest_eigenvector(system: Floats) -> Floats:
    smallest: Floats = np.linalg.eigh(system.T @ system)[1][:, 0]
    return smallest.reshape(3, 3)


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
    draw=draw,
    default_tier="two-sided",
    items=33,
    item="homography",
)
