"""The methods of `inverse_distortion`, and the closed form, for two difficult lenses.

In a strong pincushion the most common method diverges. A barrel seen nearly out to its fold needs
many steps, as the slope there almost vanishes. Both have k₁ alone, so that the closed form, which
exists only for such lenses, can be compared.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.ladders import inverse_distortion
from simulations.ladders.inverse_distortion import HEIGHT, TIERS, WIDTH, Workload, workload_of
from simulations.models.arrays import Floats
from simulations.models.distortion.lens_model import Distortion, largest_distorted_radius
from simulations.models.distortion.undistortion import undistort_closed_form
from simulations.models.error_measures import root_mean_square

type Lenses = tuple[Workload, Workload]
"""The pincushion and the barrel."""
PINCUSHION, BARREL = 0, 1
type Points = tuple[Floats, ...]


def _lenses(pincushion: Workload, barrel: Workload) -> Lenses:
    return replace(pincushion, distorted=pincushion.distorted[::2]), replace(
        barrel, distorted=barrel.distorted[::2]
    )


def prepare() -> Lenses:
    """The pincushion's corners lie at r = 2 in the picture, and at 0.9 without the lens.

    There k₁ r² exceeds 1, and a step of the fixed point enlarges the error. The barrel's corners
    are at 99.9 % of its largest image radius.
    """
    lenses = (Distortion(k1=1.5), 200.0), (Distortion(k1=-0.3), 569.0)
    return _lenses(*(workload_of(lens, focal_px) for lens, focal_px in lenses))


def draw(index: int) -> Lenses:
    """Other pincushions whose corners lie beyond k₁ r² = 1, and barrels seen to 99 to 99.9 % of
    their largest radius."""
    rng = np.random.default_rng(index)
    pincushion, barrel = Distortion(k1=rng.uniform(1.3, 3.0)), Distortion(k1=-rng.uniform(0.1, 0.5))
    corner = rng.uniform(0.99, 0.999) * largest_distorted_radius(barrel)
    half_diagonal = 0.5 * float(np.hypot(WIDTH, HEIGHT))
    return _lenses(workload_of(pincushion, 200.0), workload_of(barrel, half_diagonal / corner))


def reference(workload: Lenses) -> Points:
    """Bisection of the radius, for the barrel up to its fold: see `inverse_distortion`."""
    return tuple(inverse_distortion.reference(part) for part in workload)


def _both(workload: Lenses, *, run: Callable[[Workload], Floats]) -> Points:
    return tuple(run(part) for part in workload)


def _formula(workload: Workload) -> Floats:
    return undistort_closed_form(workload.distorted, workload.lens)


CLOSED_FORM = Tier(
    "closed-form",
    "Closed form if k₂ = 0, else checked table",
    "1 square root, 1 arcsine, 1 sine, 1 division",
    _formula,
)
ALL_TIERS = (*TIERS[:-2], CLOSED_FORM, *TIERS[-2:])
"""The formula is for these two lenses, the last two tiers are for every lens."""


def rms_px(result: Points, truth: Points, workload: Lenses) -> float:
    """The error over the points of both pictures."""
    each = [inverse_distortion.rms_px(*part) for part in zip(result, truth, workload, strict=True)]
    return root_mean_square(each)


def worst_px(result: Points, truth: Points, workload: Lenses, *, part: int) -> float:
    return inverse_distortion.worst_px(result[part], truth[part], workload[part])


LADDER = Ladder(
    id="inverse-strong",
    title="Undoing strong lenses",
    workload="2 × 38 400 points: f = 200 px, k₁ = 1.5; f = 569 px, k₁ = −0.3",
    prepare=prepare,
    tiers=tuple(replace(tier, run=partial(_both, run=tier.run)) for tier in ALL_TIERS),
    reference=reference,
    reference_label="bisection of the radius down to the last bit",
    metrics=(
        Metric("rms", "RMS error", "px", rms_px),
        Metric("pincushion", "Largest error, pincushion", "px", partial(worst_px, part=PINCUSHION)),
        Metric("fold", "Largest error, near the fold", "px", partial(worst_px, part=BARREL)),
    ),
    default_tier="closed-form",
    draw=draw,
    items=76_800,
    item="point",
)
