"""Encoding linear light for a display: the sRGB curve, and what is used in its place."""

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_gamma, encode_srgb, encode_srgb_table
from simulations.models.error_measures import root_mean_square

SHAPE = (256, 256, 3)


def prepare() -> Floats:
    """Linear values, float32, whose codes are spread about evenly, in no order."""
    codes = np.random.default_rng(2).random(SHAPE)
    return (codes**2.2).astype(np.float32)


def reference(linear: Floats) -> Floats:
    """IEC 61966-2-1 piece by piece, through logarithms, in float64."""
    light = linear.astype(np.float64).ravel()
    encoded = light * 12.92
    bright = light > 0.0031308
    encoded[bright] = 1.055 * np.exp(np.log(light[bright]) / 2.4) - 0.055
    return encoded.reshape(linear.shape)


def _codes(result: Floats, truth: Floats) -> Floats:
    """Difference in codes of an 8-bit display, before rounding."""
    return 255.0 * np.abs(result.astype(np.float64) - truth)


def worst_codes(result: Floats, truth: Floats, _linear: Floats) -> float:
    return float(_codes(result, truth).max())


def rms_codes(result: Floats, truth: Floats, _linear: Floats) -> float:
    return root_mean_square(_codes(result, truth))


LADDER = Ladder(
    id="srgb",
    title="Encoding for a display",
    workload="256 × 256 RGB pixels of linear light, float32",
    prepare=prepare,
    tiers=(
        Tier("power-1/2.2", "Power 1/2.2", "1 power", encode_gamma),
        Tier("table", "Table of 65\u202f536 entries", "1 look-up", encode_srgb_table),
        Tier("exact", "Exact curve", "1 power, 1 choice", encode_srgb),
    ),
    reference=reference,
    reference_label="the standard's formula, piece by piece in float64",
    metrics=(
        Metric("worst", "Largest error", "codes of 255", worst_codes),
        Metric("rms", "RMS error", "codes of 255", rms_codes),
    ),
    default_tier="table",
)
