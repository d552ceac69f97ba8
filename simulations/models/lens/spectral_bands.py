"""A few wavelengths that represent the spectral sensitivity of a colour channel.

A channel's sensitivity is a bell curve on white light: a peak and a standard deviation, both in
micrometres. Quantities that depend on the wavelength are summed with the shares of `Band`, whose
sum is 1. Szeliski, 2nd ed., section 2.3.2.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.require import as_whole, require

MOST_CHOSEN = 100
"""Largest degree for which numpy guarantees the accuracy of Gauss–Hermite quadrature."""


@dataclass(frozen=True, slots=True)
class Band:
    """A channel as a quadrature rule."""

    wavelengths_um: Floats
    """(n,)."""
    shares: Floats
    """(n,) with sum 1."""


def chosen_wavelengths(peak_um: float, width_um: float, count: int) -> Band:
    """Gauss–Hermite quadrature of the bell curve: exact for polynomials up to 2 count − 1."""
    _check(width_um, count, peak_um)
    count = as_whole("count", count, 1, MOST_CHOSEN)
    steps, weights = np.polynomial.hermite_e.hermegauss(count)
    return Band(peak_um + width_um * steps, weights / weights.sum())


def even_wavelengths(
    peaks_um: Sequence[float], width_um: float, first_um: float, last_um: float, count: int
) -> tuple[Band, ...]:
    """The same ``count`` wavelengths for all channels, in the middles of even parts of a range.

    All channels share the pictures; the shares of each follow its own bell curve. A curve so narrow
    or so far off that it is 0 at all of them is taken at the nearest ones.
    """
    _check(width_um, count, *peaks_um, first_um, last_um)
    step = (last_um - first_um) / count
    wavelengths = first_um + (np.arange(count) + 0.5) * step
    off = np.square((wavelengths - np.asarray(peaks_um, float)[:, None]) / width_um)
    # Relative to the nearest wavelength, whose share is positive for any width.
    seen = np.exp(-0.5 * (off - off.min(axis=1, keepdims=True)))
    shares = seen / seen.sum(axis=1, keepdims=True)
    return tuple(Band(wavelengths, each) for each in shares)


def _check(width_um: float, count: int, *wavelengths_um: float) -> None:
    as_whole("count", count, 1)
    require("width_um", width_um, 1e-9 <= width_um <= 1e9, "1e-9 to 1e9")
    require(
        "wavelengths",
        wavelengths_um,
        all(abs(wavelength) <= 1e9 for wavelength in wavelengths_um),
        "finite, at most 1e9 in size",
    )
