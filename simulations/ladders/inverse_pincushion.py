"""The same ways to undo a lens, where the most common one runs away from the answer."""

from simulations.engine.ladder import Ladder
from simulations.ladders.inverse_distortion import (
    METRICS,
    TIERS,
    Workload,
    reference,
    workload_of,
)
from simulations.models.distortion import Distortion


def prepare() -> Workload:
    """The corners lie at r = 2 in the picture, and at 0.9 without the lens: 42° off the axis.

    There k₁ r² exceeds 1, and a step of the fixed point enlarges the error.
    """
    return workload_of(Distortion(k1=1.5), focal_px=200.0)


LADDER = Ladder(
    id="inverse-pincushion",
    title="Undoing a strong pincushion",
    workload="76 800 points of a 640 × 480 picture, f = 200 px, k₁ = 1.5",
    prepare=prepare,
    tiers=TIERS,
    reference=reference,
    reference_label="bisection of the radius down to the last bit",
    metrics=METRICS,
    default_tier="checked-table",
)
