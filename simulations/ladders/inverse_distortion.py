"""Undoing lens distortion: where each pixel of a barrel photograph would be without the lens."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.distortion.lens_model import Distortion, Floats, undistort
from simulations.models.distortion.radial_table import inverse_table
from simulations.models.distortion.undistortion import (
    undistort_bracketed,
    undistort_first_order,
    undistort_fixed_point,
    undistort_newton,
    undistort_table,
)

WIDTH, HEIGHT = 640, 480


@dataclass(frozen=True, slots=True)
class Workload:
    """Points to be undone, and the lens that bent them."""

    seen: Floats
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


def reference(workload: Workload) -> Floats:
    """Bisection of the radius until floats run out: slow, and it cannot miss.

    The polynomial is written out here, so that the tiers and their judge share no code. With
    k₁ = −0.3 and k₂ = 0.1, as with k₁ > 0 alone, the map increases everywhere: the root is unique.
    With k₁ < 0 alone it does so up to r = √(−1/(3 k₁)), where the search ends.
    """
    k1, k2 = workload.lens.k1, workload.lens.k2
    seen_radius: Floats = np.linalg.norm(workload.seen, axis=-1)
    furthest = np.sqrt(-1.0 / (3.0 * k1)) if k1 < 0.0 and not k2 else 3.0
    low, high = np.zeros_like(seen_radius), np.full_like(seen_radius, furthest)
    for _ in range(60):
        middle = (low + high) / 2
        s = middle * middle
        too_far = middle * (1 + k1 * s + k2 * s * s) > seen_radius
        low, high = np.where(too_far, low, middle), np.where(too_far, middle, high)
    ideal: Floats = workload.seen * (high / seen_radius)[:, None]
    return ideal


def _distance_px(result: Floats, truth: Floats, workload: Workload) -> Floats:
    distance: Floats = workload.focal_px * np.linalg.norm(result - truth, axis=-1)
    return distance


def rms_px(result: Floats, truth: Floats, workload: Workload) -> float:
    return float(np.sqrt(np.mean(_distance_px(result, truth, workload) ** 2)))


def worst_px(result: Floats, truth: Floats, workload: Workload) -> float:
    return float(_distance_px(result, truth, workload).max())


def _fixed_point(workload: Workload, *, steps: int) -> Floats:
    return undistort_fixed_point(workload.seen, workload.lens, steps)


def _newton(workload: Workload, *, steps: int) -> Floats:
    return undistort_newton(workload.seen, workload.lens, steps)


def _checked_table(workload: Workload) -> Floats:
    """A lens never seen before: the table is made anew in every run."""
    inverse_table.cache_clear()
    return undistort(workload.seen, workload.lens)[0]


TIERS = (
    Tier(
        "first-order",
        "First order",
        "1 polynomial",
        lambda work: undistort_first_order(work.seen, work.lens),
    ),
    Tier(
        "lookup-table",
        "Lookup table",
        "1 table look-up",
        lambda work: undistort_table(work.seen, work.lens),
    ),
    *(
        Tier(
            f"newton-{steps}",
            f"Newton, {steps} steps",
            f"{2 * steps} polynomials",
            partial(_newton, steps=steps),
        )
        for steps in (3, 4, 5)
    ),
    *(
        Tier(
            f"fixed-point-{steps}",
            f"Fixed point, {steps} steps",
            f"{steps} polynomials",
            partial(_fixed_point, steps=steps),
        )
        for steps in (5, 10, 20)
    ),
    Tier(
        "checked-table",
        "Checked table",
        "2 square roots, 1 polynomial; 8 polynomials for each of 1285 nodes",
        _checked_table,
    ),
    Tier(
        "newton-bracketed",
        "Newton in a bracket, to the end",
        "1 table look-up, 7 polynomials, 12 choices",
        lambda work: undistort_bracketed(work.seen, work.lens),
    ),
)
"""Cheap to dear, for a mild lens."""

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
    default_tier="newton-5",
)
