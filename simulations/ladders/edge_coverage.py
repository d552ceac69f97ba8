"""Smooth edges: by counting samples inside the shape, or by working out the covered area."""

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.edge_coverage import (
    curved_edge_coverage,
    ramp_coverage,
    straight_edge_coverage,
)

type Floats = NDArray[np.floating]

SIZE = 96
RADIUS_PX = 37.3
CENTRE_PX = (47.2, 48.9)
"""Of the disc, as (x, y) with pixel centres at whole numbers: no symmetry helps any method."""


@dataclass(frozen=True, slots=True)
class Workload:
    """Pixel centres, seen from the centre of the disc."""

    x: Floats
    """(96,) pixels to the right."""
    y: Floats
    """(96,) pixels down."""


def prepare() -> Workload:
    pixels = np.arange(SIZE, dtype=float)
    return Workload(pixels - CENTRE_PX[0], pixels - CENTRE_PX[1])


def _supersample(workload: Workload, *, factor: int) -> Floats:
    """Share of ``factor`` × ``factor`` points of every pixel that lie in the disc."""
    within = (np.arange(factor) + 0.5) / factor - 0.5
    x = (workload.x[:, None] + within).ravel()
    y = (workload.y[:, None] + within).ravel()
    inside = np.square(x) + np.square(y)[:, None] < RADIUS_PX**2
    share: Floats = inside.reshape(SIZE, factor, SIZE, factor).mean(axis=(1, 3))
    return share


def _supersample_edges(workload: Workload, *, factor: int) -> Floats:
    """The same, but only where the edge can pass: within half a diagonal of the centre."""
    x, y = np.broadcast_arrays(workload.x, workload.y[:, None])
    distance = RADIUS_PX - np.hypot(x, y)
    edge = np.abs(distance) < np.sqrt(0.5)
    within = (np.arange(factor) + 0.5) / factor - 0.5
    squares_x = np.square(x[edge][:, None] + within)
    squares_y = np.square(y[edge][:, None] + within)
    inside = squares_x[:, None, :] + squares_y[:, :, None] < RADIUS_PX**2
    coverage: Floats = (distance > 0).astype(float)
    coverage[edge] = inside.mean(axis=(1, 2))
    return coverage


def _edge(workload: Workload) -> tuple[Floats, Floats]:
    """Distance to the disc's edge (H, W), and the direction of its normal (H, W, 2)."""
    x, y = np.broadcast_arrays(workload.x, workload.y[:, None])
    radius = np.hypot(x, y)
    normal = np.stack([x, y], axis=-1) / np.maximum(radius, 1e-12)[..., None]
    return RADIUS_PX - radius, normal


def _ramp(workload: Workload) -> Floats:
    return ramp_coverage(RADIUS_PX - np.hypot(workload.x, workload.y[:, None]))


def _straight(workload: Workload) -> Floats:
    return straight_edge_coverage(*_edge(workload))


def _curved(workload: Workload) -> Floats:
    return curved_edge_coverage(*_edge(workload), 1.0 / RADIUS_PX)


def reference(workload: Workload) -> Floats:
    """Exact area, by the integral of the circle between the pixel's borders, in closed form."""
    left, right = workload.x - 0.5, workload.x + 0.5
    top, bottom = (workload.y - 0.5)[:, None], (workload.y + 0.5)[:, None]
    return (
        _area_to(right, bottom)
        - _area_to(left, bottom)
        - _area_to(right, top)
        + _area_to(left, top)
    )


def _area_to(x: Floats, y: Floats) -> Floats:
    """Area of the disc within the rectangle from its centre to (x, y); odd in both."""
    a, b = np.minimum(np.abs(x), RADIUS_PX), np.minimum(np.abs(y), RADIUS_PX)
    flat = np.minimum(a, np.sqrt(RADIUS_PX**2 - b**2))  # up to here the rectangle is the lower
    under_arc = _under_arc(a) - _under_arc(flat)
    area: Floats = np.sign(x) * np.sign(y) * (b * flat + under_arc)
    return area


def _under_arc(x: Floats) -> Floats:
    """Integral of sqrt(R² − x²) from 0."""
    area: Floats = 0.5 * (
        x * np.sqrt(RADIUS_PX**2 - x**2) + RADIUS_PX**2 * np.arcsin(x / RADIUS_PX)
    )
    return area


def _edge_errors(result: Floats, truth: Floats) -> Floats:
    """Differences in those pixels that the edge passes through."""
    edge = (truth > 1e-9) & (truth < 1 - 1e-9)
    return (result - truth)[edge]


def rms(result: Floats, truth: Floats, _workload: Workload) -> float:
    return float(100 * np.sqrt(np.mean(np.square(_edge_errors(result, truth)))))


def worst(result: Floats, truth: Floats, _workload: Workload) -> float:
    return float(100 * np.abs(result - truth).max())


def _box_tier(factor: int) -> Tier:
    run = partial(_supersample, factor=factor)
    if factor == 1:
        return Tier("point", "Point sample", "1 sample a pixel", run)
    return Tier(f"box-{factor}", f"Box, {factor} × {factor}", f"{factor**2} samples a pixel", run)


def _edge_box_tier(factor: int) -> Tier:
    return Tier(
        f"edge-box-{factor}",
        f"Box, {factor} × {factor} on the edge",
        f"{factor**2} samples an edge pixel",
        partial(_supersample_edges, factor=factor),
    )


LADDER = Ladder(
    id="edge-coverage",
    title="Smooth edges",
    workload="a disc of radius 37.3 pixels on 96 × 96",
    prepare=prepare,
    tiers=(
        _box_tier(1),
        Tier("ramp", "Distance ramp", "1 distance a pixel", _ramp),
        Tier("straight", "Area behind a straight edge", "1 distance, 1 normal a pixel", _straight),
        _box_tier(2),
        _edge_box_tier(16),
        Tier(
            "curved",
            "Area behind a curved edge",
            "1 distance, 1 normal, 1 chord a pixel",
            _curved,
        ),
        _box_tier(4),
        _box_tier(8),
        _edge_box_tier(64),
        _box_tier(16),
    ),
    reference=reference,
    reference_label="the area of the circle within each pixel, in closed form",
    metrics=(
        Metric("rms", "RMS error on the edge", "% of a pixel", rms),
        Metric("worst", "Largest error", "% of a pixel", worst),
    ),
    default_tier="straight",
)
