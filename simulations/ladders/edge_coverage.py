"""Smooth edges, by counting samples inside the shape or by computing the covered area."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.error_measures import root_mean_square
from simulations.models.light.edge_coverage import (
    curved_edge_coverage,
    ramp_coverage,
    straight_edge_coverage,
)


@dataclass(frozen=True, slots=True)
class Disc:
    """A disc on a square of pixels, seen from its centre."""

    x: Floats
    """(n,) pixel centres to the right, without symmetry of the grid, which would favour some
    methods."""
    y: Floats
    """(n,) pixel centres down."""
    radius: float
    """Radius in pixels."""


type Workload = tuple[Disc, Disc]
"""A large one, whose edge is nearly straight in each pixel, and a small one."""
type Result = list[Floats]
"""Coverage (n, n) of each disc."""


def disc_on(size: int, radius: float, centre: tuple[float, float]) -> Disc:
    """A disc around ``centre``, with pixel centres at whole numbers."""
    pixels = np.arange(size, dtype=float)
    return Disc(pixels - centre[0], pixels - centre[1], radius)


def prepare() -> Workload:
    return disc_on(96, 37.3, (47.2, 48.9)), disc_on(16, 5.0, (7.2, 7.9))


def draw(index: int) -> Workload:
    """Other places of both discs on the grid, and other radii: 30 to 44 pixels and 4 to 6."""
    rng = np.random.default_rng(index)
    large, small = rng.uniform(30.0, 44.0), rng.uniform(4.0, 6.0)
    return (
        disc_on(96, large, (47.0 + rng.uniform(), 47.0 + rng.uniform())),
        disc_on(16, small, (7.0 + rng.uniform(), 7.0 + rng.uniform())),
    )


def _for_every_disc(coverage: Callable[[Disc], Floats]) -> Callable[[Workload], Result]:
    return lambda workload: [coverage(disc) for disc in workload]


def _sub_pixels(factor: int) -> Floats:
    """Offsets (factor,) of sample points from the middle of a pixel."""
    return (np.arange(factor) + 0.5) / factor - 0.5


def _supersample(disc: Disc, *, factor: int) -> Floats:
    """Share of ``factor`` × ``factor`` points of every pixel that are in the disc.

    Summed over the rows in bytes, as counts are at most 255.
    """
    squares_x = np.square((disc.x[:, None] + _sub_pixels(factor)).ravel())
    squares_y = np.square((disc.y[:, None] + _sub_pixels(factor)).ravel())
    inside = squares_x < disc.radius**2 - squares_y[:, None]
    if factor == 1:
        return inside.astype(float)
    samples = inside.view(np.uint8).reshape(disc.y.size, factor, -1)
    columns = samples.sum(axis=1, dtype=np.uint8).reshape(disc.y.size, disc.x.size, factor)
    return np.einsum("yxs->yx", columns, dtype=np.int32) / factor**2


def _distance(disc: Disc) -> Floats:
    """Distance (n, n) from each pixel's centre to the edge, positive inside."""
    return disc.radius - np.hypot(disc.x, disc.y[:, None])


type OnEdge = Callable[[Floats, Floats, Floats, float], Floats]
"""A function for the coverage of the pixels that the edge may cross, of their places right and down
from the disc's centre and their distances to its edge, (m,) each, and the radius."""


def _on_the_edge(disc: Disc, coverage: OnEdge) -> Floats:
    """0 or 1 where the edge is more than half a diagonal away, else ``coverage``."""
    distance = _distance(disc)
    rows, columns = np.nonzero(np.abs(distance) < np.sqrt(0.5))
    covered = (distance > 0).astype(float)
    covered[rows, columns] = coverage(
        disc.x[columns], disc.y[rows], distance[rows, columns], disc.radius
    )
    return covered


def _counted(x: Floats, y: Floats, _distance: Floats, radius: float, *, factor: int) -> Floats:
    squares_x = np.square(x[:, None] + _sub_pixels(factor))
    squares_y = np.square(y[:, None] + _sub_pixels(factor))
    inside = squares_x[:, None, :] < radius**2 - squares_y[:, :, None]
    counted = np.einsum("ps->p", inside.reshape(x.size, factor**2).view(np.uint8), dtype=np.int32)
    return counted / factor**2


def _normal(x: Floats, y: Floats, distance: Floats, radius: float) -> Floats:
    """Unit vectors (m, 2) away from the disc's centre, (0, 0) at the centre itself."""
    return np.stack([x, y], axis=-1) / np.maximum(radius - distance, 1e-12)[:, None]


def _straight(x: Floats, y: Floats, distance: Floats, radius: float) -> Floats:
    return straight_edge_coverage(distance, _normal(x, y, distance, radius))


def _curved(x: Floats, y: Floats, distance: Floats, radius: float) -> Floats:
    return curved_edge_coverage(distance, _normal(x, y, distance, radius), 1.0 / radius)


def reference(workload: Workload) -> Result:
    """Exact area, by the integral of the circle between the pixel's borders, in closed form."""
    return [_exact(disc) for disc in workload]


def _exact(disc: Disc) -> Floats:
    left, right = disc.x - 0.5, disc.x + 0.5
    top, bottom = (disc.y - 0.5)[:, None], (disc.y + 0.5)[:, None]
    return (
        _area_to(right, bottom, disc.radius)
        - _area_to(left, bottom, disc.radius)
        - _area_to(right, top, disc.radius)
        + _area_to(left, top, disc.radius)
    )


def _area_to(x: Floats, y: Floats, radius: float) -> Floats:
    """Area of the disc within the rectangle from its centre to (x, y); odd in both."""
    a, b = np.minimum(np.abs(x), radius), np.minimum(np.abs(y), radius)
    flat = np.minimum(a, np.sqrt(radius**2 - b**2))  # up to here the rectangle is lower
    under_arc = _under_arc(a, radius) - _under_arc(flat, radius)
    return np.sign(x) * np.sign(y) * (b * flat + under_arc)


def _under_arc(x: Floats, radius: float) -> Floats:
    """Integral of sqrt(R² − x²) from 0."""
    return 0.5 * (x * np.sqrt(radius**2 - x**2) + radius**2 * np.arcsin(x / radius))


def rms(result: Result, truth: Result, _workload: Workload, *, which: int) -> float:
    """RMS error in the pixels that the edge of the disc crosses, percent of a pixel."""
    edge = (truth[which] > 1e-9) & (truth[which] < 1 - 1e-9)
    return 100 * root_mean_square((result[which] - truth[which])[edge])


def worst(result: Result, truth: Result, _workload: Workload, *, which: int) -> float:
    return float(100 * np.abs(result[which] - truth[which]).max())


def _box_tier(factor: int) -> Tier:
    run = _for_every_disc(partial(_supersample, factor=factor))
    if factor == 1:
        return Tier("point", "Point sample", "1 sample a pixel", run)
    cost = f"{factor**2} samples in every pixel"
    return Tier(f"box-{factor}", f"Box, {factor} × {factor} everywhere", cost, run)


def _edge_tier(tier_id: str, label: str, cost: str, coverage: OnEdge) -> Tier:
    return Tier(tier_id, label, cost, _for_every_disc(partial(_on_the_edge, coverage=coverage)))


def _edge_box_tier(factor: int) -> Tier:
    label, cost = f"Box, {factor} × {factor} on the edge", f"{factor**2} samples an edge pixel"
    return _edge_tier(f"edge-box-{factor}", label, cost, partial(_counted, factor=factor))


LADDER = Ladder(
    id="edge-coverage",
    title="Smooth edges",
    workload="a disc of radius 37.3 pixels on 96 × 96, and one of radius 5 on 16 × 16",
    prepare=prepare,
    tiers=(
        _box_tier(1),
        Tier(
            "ramp",
            "Distance ramp",
            "1 distance a pixel",
            _for_every_disc(lambda disc: ramp_coverage(_distance(disc))),
        ),
        _box_tier(2),
        _edge_tier(
            "straight",
            "Area behind a straight edge",
            "1 distance a pixel, 1 normal on the edge",
            _straight,
        ),
        _edge_tier(
            "curved",
            "Area behind a curved edge",
            "1 distance a pixel, 1 normal and 1 chord on the edge",
            _curved,
        ),
        _box_tier(4),
        _box_tier(8),
        _edge_box_tier(16),
        _edge_box_tier(64),
        _box_tier(16),
    ),
    reference=reference,
    reference_label="the area of the circle within each pixel, in closed form",
    metrics=(
        Metric("rms", "RMS error on the edge", "% of a pixel", partial(rms, which=0)),
        Metric("worst", "Largest error", "% of a pixel", partial(worst, which=0)),
        Metric("rms-small", "The same, radius 5", "% of a pixel", partial(rms, which=1)),
        Metric("worst-small", "Largest, radius 5", "% of a pixel", partial(worst, which=1)),
    ),
    default_tier="straight",
    draw=draw,
    items=9_472,
)
