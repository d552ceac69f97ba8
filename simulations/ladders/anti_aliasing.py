"""Anti-aliasing: what a sensor makes of rings too fine for it, by the filter before sampling.

The zone plate's frequency grows with the distance from its centre, so that one picture holds
every frequency in every direction. Beyond half a cycle per pixel nothing of it can be shown, and
whatever a method still shows there is false.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats, Mask
from simulations.models.error_measures import root_mean_square
from simulations.models.pixel_grid import centred
from simulations.models.sampling.aliasing import (
    box_filter,
    filter_and_sample,
    sinc_kernel,
    zone_plate,
    zone_plate_area,
)

SIZE = 192
SCALE = 128.0
"""Rings per pixel reach 1/2 at 64 pixels from the centre and 3/4 at the middle of each side."""
GUARD = 0.1
"""Frequencies this close to 1/2 are judged neither in band nor out of it."""


@dataclass(frozen=True, slots=True)
class Truth:
    """What should be seen, in two senses."""

    area: Floats
    """(192, 192) exact mean over each pixel: what light falling on it adds up to."""
    in_band: Mask
    """(192, 192) whether the rings there can be shown by pixels."""
    out_of_band: Mask
    """(192, 192) whether only grey is right."""
    plate: Floats
    """(192, 192) the rings at pixel centres: right where they are in band."""


def prepare() -> Floats:
    """Positions of pixel centres along either axis, from the middle of the picture."""
    return centred(SIZE)


def _samples(centres: Floats, factor: int) -> Floats:
    """The plate at ``factor`` × ``factor`` evenly spaced points in each pixel."""
    within = (np.arange(factor) + 0.5) / factor - 0.5
    along = (centres[:, None] + within).reshape(-1).astype(np.float32)
    return zone_plate(along, along[:, None], SCALE)


def _box(centres: Floats, *, factor: int) -> Floats:
    return box_filter(_samples(centres, factor), factor)


def _sinc(centres: Floats, *, factor: int) -> Floats:
    taps = sinc_kernel(factor).astype(np.float32)  # in the format of the samples
    return filter_and_sample(_samples(centres, factor), factor, taps)


def _area(centres: Floats) -> Floats:
    along = centres.astype(np.float32)
    return zone_plate_area(along, along[:, None], SCALE)


def reference(centres: Floats) -> Truth:
    """Gauss–Legendre quadrature of exp(i π x² / scale) over each pixel, 24 nodes an axis.

    The plate is the real part of a product of one factor in x and one in y, so that two
    integrals along a line give those of all pixels; at most 3/4 of a cycle fits in a pixel,
    and the quadrature is exact to rounding.
    """
    nodes, weights = np.polynomial.legendre.leggauss(24)
    points = centres[:, None] + nodes / 2
    factor = np.exp(1j * np.pi * points**2 / SCALE) @ (weights / 2)
    plate = np.exp(1j * np.pi * centres**2 / SCALE)
    frequency = np.maximum(np.abs(centres), np.abs(centres[:, None])) / SCALE
    return Truth(
        area=0.5 + 0.5 * np.real(factor * factor[:, None]),
        in_band=frequency < 0.5 - GUARD,
        out_of_band=frequency > 0.5 + GUARD,
        plate=0.5 + 0.5 * np.real(plate * plate[:, None]),
    )


def alias_rms(result: Floats, truth: Truth, _centres: Floats) -> float:
    return root_mean_square((result[truth.out_of_band] - 0.5).astype(np.float64))


def area_rms(result: Floats, truth: Truth, _centres: Floats) -> float:
    return root_mean_square(result - truth.area)


def contrast_loss(result: Floats, truth: Truth, _centres: Floats) -> float:
    """How far the rings that pixels can show fall short of their full contrast, RMS."""
    return root_mean_square((result - truth.plate)[truth.in_band])


def _box_tier(factor: int) -> Tier:
    cost = f"{factor**2} samples a pixel"
    return Tier(f"box-{factor}", f"Box, {factor} × {factor}", cost, partial(_box, factor=factor))


LADDER = Ladder(
    id="anti-aliasing",
    title="Filtering before sampling",
    workload="a zone plate on 192 × 192 pixels, up to 3/4 of a cycle per pixel along each axis",
    prepare=prepare,
    tiers=(
        Tier("point", "Point sample", "1 sample a pixel", partial(_samples, factor=1)),
        Tier("area", "Pixel area, by formula", "1 sample, 2 sines a pixel", _area),
        _box_tier(2),
        _box_tier(4),
        Tier(
            "sinc-4",
            "Windowed sinc on 4 × 4",
            "16 samples, 165 taps a pixel",
            partial(_sinc, factor=4),
        ),
        _box_tier(8),
    ),
    reference=reference,
    reference_label="grey beyond Nyquist; pixel integrals by Gauss–Legendre quadrature",
    metrics=(
        Metric("alias", "False rings", "RMS of range", alias_rms),
        Metric("area", "Off the pixel's exact mean", "RMS of range", area_rms),
        Metric("loss", "Off full contrast in band", "RMS of range", contrast_loss),
    ),
    default_tier="area",
)
