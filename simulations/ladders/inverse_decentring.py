"""Undoing a lens that is off centre: one unknown a point is no longer enough."""

from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.ladders.inverse_distortion import (
    HEIGHT,
    WIDTH,
    Workload,
    rms_px,
    workload_of,
    worst_px,
)
from simulations.models.arrays import Floats
from simulations.models.distortion.decentred_undistortion import (
    undistort_decentred_fixed_point,
    undistort_decentred_newton,
)
from simulations.models.distortion.lens_model import Distortion, undistort
from simulations.models.distortion.radial_table import inverse_table
from simulations.models.distortion.undistortion import undistort_newton

LENS = Distortion(k1=-0.3, k2=0.1, p1=1e-3, p2=-5e-4)
FOCAL_PX = 400.0


def ideal_points() -> Floats:
    """An even grid of 320 × 240 points, 2 px apart: the truth that the lens then bends."""
    return workload_of(LENS, FOCAL_PX).seen


def prepare() -> Workload:
    """Where the lens images the grid.

    Brown's formula is written out here, so that the tiers and their judge share no code.
    """
    x, y = ideal_points().T
    s = x * x + y * y
    g = 1.0 + LENS.k1 * s + LENS.k2 * s * s
    seen_x = x * g + 2.0 * LENS.p1 * x * y + LENS.p2 * (s + 2.0 * x * x)
    seen_y = y * g + LENS.p1 * (s + 2.0 * y * y) + 2.0 * LENS.p2 * x * y
    return Workload(np.stack((seen_x, seen_y), axis=-1), LENS, FOCAL_PX)


def reference(_workload: Workload) -> Floats:
    """The points that were imaged: nothing needs to be undone to know them."""
    return ideal_points()


def _radial_only(workload: Workload) -> Floats:
    """As if the lens were centred."""
    lens = workload.lens
    return undistort_newton(workload.seen, Distortion(lens.k1, lens.k2, lens.k3), 4)


def _fixed_point(workload: Workload, *, steps: int) -> Floats:
    return undistort_decentred_fixed_point(workload.seen, workload.lens, steps)


def _newton(workload: Workload, *, steps: int) -> Floats:
    return undistort_decentred_newton(workload.seen, workload.lens, steps)


def _radial_then_newton(workload: Workload, *, steps: int) -> Floats:
    """The radial solution is 1 px off; each step in the plane squares that."""
    start = _radial_only(workload)
    return undistort_decentred_newton(workload.seen, workload.lens, steps, start)


def _checked(workload: Workload) -> Floats:
    """A lens never seen before: its table is made anew in every run."""
    inverse_table.cache_clear()
    return undistort(workload.seen, workload.lens)[0]


LADDER = Ladder(
    id="inverse-decentring",
    title="Undoing a lens off centre",
    workload=f"{WIDTH // 2} × {HEIGHT // 2} points, f = 400 px, k₁ = −0.3, k₂ = 0.1, "
    "p₁ = 0.001, p₂ = −0.0005",
    prepare=prepare,
    tiers=(
        Tier("radial-only", "Radial part only, Newton", "8 polynomials", _radial_only),
        *(
            Tier(
                f"fixed-point-{steps}",
                f"Fixed point, {steps} steps",
                f"{steps} polynomials and corrections",
                partial(_fixed_point, steps=steps),
            )
            for steps in (5, 10, 20)
        ),
        *(
            Tier(
                f"radial-plane-{steps}",
                f"Radial part, then Newton in the plane, {steps} step{'s' * (steps > 1)}",
                f"8 polynomials; {steps} × 2 polynomials and a 2 × 2 system",
                partial(_radial_then_newton, steps=steps),
            )
            for steps in (1, 2)
        ),
        *(
            Tier(
                f"plane-{steps}",
                f"Newton in the plane, {steps} steps",
                f"{steps} × 2 polynomials and a 2 × 2 system",
                partial(_newton, steps=steps),
            )
            for steps in (3, 4, 5)
        ),
        Tier(
            "checked",
            "Table, Newton to the end, and validity",
            "1 table look-up; 3 × 2 polynomials and a 2 × 2 system; a look for folds",
            _checked,
        ),
    ),
    reference=reference,
    reference_label="the points themselves, from which the picture was computed",
    metrics=(
        Metric("rms", "RMS error", "px", rms_px),
        Metric("worst", "Largest error", "px", worst_px),
    ),
    default_tier="plane-4",
)
