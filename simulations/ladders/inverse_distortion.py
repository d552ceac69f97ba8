"""Inverse lens distortion: where each pixel of a barrel photograph would be without distortion."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.distortion.lens_model import Distortion
from simulations.models.distortion.radial_table import inverse_table
from simulations.models.distortion.undistortion import INVERSES, Inverse
from simulations.models.error_measures import root_mean_square

WIDTH, HEIGHT = 640, 480


@dataclass(frozen=True, slots=True)
class Workload:
    """Distorted points and the lens."""

    distorted: Floats
    """(N, 2) normalised distorted coordinates."""
    lens: Distortion
    focal_px: float


def workload_of(lens: Distortion, focal_px: float) -> Workload:
    """Every second pixel of every second row."""
    x = (np.arange(0, WIDTH, 2) + 0.5 - WIDTH / 2) / focal_px
    y = (np.arange(0, HEIGHT, 2) + 0.5 - HEIGHT / 2) / focal_px
    return Workload(np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2), lens, focal_px)


def prepare() -> Workload:
    """The corners lie at r = 1."""
    return workload_of(Distortion(k1=-0.3, k2=0.1), focal_px=400.0)


def draw(index: int) -> Workload:
    """Other lenses whose map does not fold in the picture: mild barrels, pincushions and both."""
    rng = np.random.default_rng(index)
    return workload_of(Distortion(k1=rng.uniform(-0.3, 0.2), k2=rng.uniform(0.05, 0.1)), 400.0)


def reference(workload: Workload) -> Floats:
    """Bisection of the radius to the last digit: slow but safe.

    The polynomial is written out here, so that the tiers and the reference share no code. With k₁ =
    −0.3 and k₂ = 0.1, as with k₁ > 0 alone, the map increases everywhere: the root is unique. With
    k₁ < 0 alone it does so up to r = √(−1/(3 k₁)), where the search ends.
    """
    k1, k2 = workload.lens.k1, workload.lens.k2
    distorted_radius: Floats = np.linalg.norm(workload.distorted, axis=-1)
    furthest = np.sqrt(-1.0 / (3.0 * k1)) if k1 < 0.0 and not k2 else 3.0
    low, high = np.zeros_like(distorted_radius), np.full_like(distorted_radius, furthest)
    for _ in range(60):
        middle = (low + high) / 2
        s = middle * middle
        too_far = middle * (1 + k1 * s + k2 * s * s) > distorted_radius
        low, high = np.where(too_far, low, middle), np.where(too_far, middle, high)
    return workload.distorted * (high / distorted_radius)[:, None]


def _distance_px(result: Floats, truth: Floats, workload: Workload) -> Floats:
    return workload.focal_px * np.linalg.norm(result - truth, axis=-1)


def rms_px(result: Floats, truth: Floats, workload: Workload) -> float:
    return root_mean_square(_distance_px(result, truth, workload))


def worst_px(result: Floats, truth: Floats, workload: Workload) -> float:
    return float(_distance_px(result, truth, workload).max())


def _run(workload: Workload, *, inverse: Inverse) -> Floats:
    """A lens that is not cached: a table is made anew in every run."""
    inverse_table.cache_clear()
    return inverse(workload.distorted, workload.lens)


TIERS = tuple(
    Tier(name, label, cost, partial(_run, inverse=INVERSES[name]))
    for name, label, cost in (
        ("first-order", "First order", "1 polynomial"),
        ("lookup-table", "Lookup table", "1 table look-up"),
        ("newton-3", "Newton, 3 steps", "7 polynomials"),
        ("newton-4", "Newton, 4 steps", "9 polynomials"),
        ("newton-5", "Newton, 5 steps", "11 polynomials"),
        ("fixed-point-5", "Fixed point, 5 steps", "5 polynomials"),
        ("fixed-point-10", "Fixed point, 10 steps", "10 polynomials"),
        ("fixed-point-20", "Fixed point, 20 steps", "20 polynomials"),
        (
            "checked-table",
            "Checked table",
            "2 square roots, 1 polynomial; 8 polynomials for each of 1285 nodes",
        ),
        (
            "newton-bracketed",
            "Newton in a bracket, to the end",
            "1 table look-up, 7 polynomials, 12 choices",
        ),
    )
)
"""The tiers from cheap to expensive, for a mild lens."""

METRICS = (
    Metric("rms", "RMS error", "px", rms_px),
    Metric("worst", "Largest error", "px", worst_px),
)

LADDER = Ladder(
    id="inverse-distortion",
    title="Undoing lens distortion",
    workload="76 800 points of a 640 × 480 picture, f = 400 px, k₁ = −0.3, k₂ = 0.1",
    prepare=prepare,
    tiers=TIERS,
    reference=reference,
    reference_label="bisection of the radius down to the last bit",
    metrics=METRICS,
    default_tier="newton-4",
    draw=draw,
    items=76_800,
    item="point",
)
