"""Darker corners: cos⁴ by its angle, without it, and by what lens profiles use instead."""

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.lens.vignetting import vignetting_cos4

SIZE = 512
WIDEST = 1.0
"""r/f in the corner: a field of view of 90° across the diagonal."""
TABLE_ENTRIES = 1025


def prepare() -> Floats:
    """r/f of every pixel, (512, 512); the corners' outer vertices lie at r = f."""
    half = (np.arange(SIZE) + 0.5) * 2.0 / SIZE - 1.0
    return np.hypot(half, half[:, None]) * (WIDEST / np.sqrt(2.0))


def reference(radius: Floats) -> Floats:
    """cos⁴α = (3 + 4 cos 2α + cos 4α)/8, with cos 2α = (1 − r²)/(1 + r²), extended precision."""
    square = radius.astype(np.longdouble) ** 2
    cos2 = (1 - square) / (1 + square)
    cos4 = 2 * cos2 * cos2 - 1
    return (3 + 4 * cos2 + cos4) / 8


def by_angle(radius: Floats) -> Floats:
    """The formula as written. Two products make the fourth power: `**` would take longer."""
    cos = np.cos(np.arctan(radius))
    cos2 = cos * cos
    return cos2 * cos2


def algebraic_float32(radius: Floats) -> Floats:
    r = radius.astype(np.float32)
    cos2 = 1 / (1 + r * r)
    return cos2 * cos2


def profile_coefficients(terms: int) -> tuple[float, ...]:
    """a₁, a₂ … of 1 + a₁r² + a₂r⁴ + …, the form of lens profiles, fitted on 0 ≤ r ≤ 1.

    Least squares at Chebyshev points, which spread the error evenly; the centre is held at 1.
    """
    s = 0.5 - 0.5 * np.cos(np.pi * (np.arange(64) + 0.5) / 64)
    design = np.stack([s**power for power in range(1, terms + 1)], axis=-1)
    fitted = np.linalg.lstsq(design, 1.0 / (1.0 + s) ** 2 - 1.0, rcond=None)[0]
    return tuple(float(each) for each in fitted)


_PROFILE = profile_coefficients(3)
_TABLE = 1.0 / (1.0 + np.linspace(0.0, WIDEST**2, TABLE_ENTRIES)) ** 2


def profile(radius: Floats) -> Floats:
    """The cubic in r² of a lens profile."""
    a1, a2, a3 = _PROFILE
    s = radius * radius
    return 1.0 + s * (a1 + s * (a2 + s * a3))


def table(radius: Floats) -> Floats:
    """The nearest entry of a table that is spaced evenly in r²."""
    place = radius * radius * ((TABLE_ENTRIES - 1) / WIDEST**2) + 0.5
    return _TABLE[place.astype(np.int32)]


def worst_error(result: Floats, truth: Floats, _radius: Floats) -> float:
    return float(np.abs(result - truth).max())


def worst_stops(result: Floats, truth: Floats, _radius: Floats) -> float:
    """In stops, as photographers count: log₂ of the ratio."""
    ratio = (result / truth).astype(np.float64)
    return float(np.abs(np.log2(ratio)).max())


LADDER = Ladder(
    id="vignetting",
    title="Natural vignetting",
    workload="512 × 512 pixels, 90° across the diagonal",
    prepare=prepare,
    tiers=(
        Tier("profile", "Lens profile, 3 terms", "4 products, 3 sums", profile),
        Tier("table", "Table of 1025 entries", "1 look-up", table),
        Tier("algebraic-32", "Without angle, float32", "1 division", algebraic_float32),
        Tier("algebraic", "Without angle", "1 division", vignetting_cos4),
        Tier("by-angle", "By the angle", "1 arctangent, 1 cosine, 2 products", by_angle),
    ),
    reference=reference,
    reference_label="the double-angle formula in extended precision",
    metrics=(
        Metric("worst", "Largest error", "of full light", worst_error),
        Metric("stops", "Largest error", "stops", worst_stops),
    ),
    default_tier="algebraic",
)
