"""The tiers of the ladder `depth-of-field`, with discs as wide as the book's figures draw them."""

from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Tier
from simulations.ladders.depth_of_field import (
    METRICS,
    SPIRALS,
    Workload,
    binned,
    discs,
    gather,
    layered,
    pinhole,
    reference,
    workload_of,
)
from simulations.models.arrays import Floats, Planes
from simulations.models.lens.disc_blur import disc_kernel, summed
from simulations.models.lens.disc_pyramid import pyramid_blur


def prepare() -> Workload:
    """Discs of 24 pixels' radius for the nearest card, of 17 for the wall."""
    return workload_of(160, lens_radius=0.55, crop=24)


def draw(index: int) -> Workload:
    """Lenses from half as wide to 1.2 times as wide."""
    return workload_of(160, 0.55 * np.random.default_rng(index).uniform(0.5, 1.2), 28, index)


def _by_taps(planes: Planes, radius_px: float) -> Planes:
    return summed(planes, disc_kernel(radius_px))


def _reference(workload: Workload) -> Floats:
    return reference(workload, rays=2048)


LADDER = Ladder(
    id="wide-discs",
    title="Depth of field, wide discs",
    workload="160 × 120 pixels: the same cards, discs of confusion up to 48 pixels wide",
    prepare=prepare,
    tiers=(
        Tier("pinhole", "Pinhole", "1 ray a pixel", pinhole),
        Tier(
            "layered-pyramid",
            "Layers, discs on a coarser grid",
            "4 layers, 113 taps at most",
            partial(layered, blur=pyramid_blur),
        ),
        Tier("layered", "Layers, discs by spectrum", "4 layers, 2 transforms a blur", layered),
        Tier("discs", "Discs chosen by depth", "1 ray, 6 blurred pictures", discs),
        Tier("binned", "Gaussians chosen by depth", "1 ray, 6 blurred pictures", binned),
        Tier(
            "layered-taps",
            "Layers, discs tap by tap",
            "4 layers, up to 2700 taps a pixel",
            partial(layered, blur=_by_taps),
        ),
        *SPIRALS,
        Tier("gather", "Gather from neighbours", "1 ray, 2700 taps a pixel", gather),
    ),
    reference=_reference,
    reference_label="2048 rays a pixel that hit or miss, by code of their own, in float64",
    metrics=METRICS,
    draw=draw,
    default_tier="layered",
    items=19_200,
)
