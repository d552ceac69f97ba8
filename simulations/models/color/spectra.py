"""Spectra on a common grid of wavelengths: sums of bell curves, and splines.

A spectrum is an array (..., 81): its values at `WAVELENGTHS_NM`. A sum over the grid stands for an
integral over the visible range; CIE 15:2004, section 7.1, deems steps of 5 nm enough.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.require import require

WAVELENGTHS_NM: Floats = np.linspace(380.0, 780.0, 81)
"""(81,) the visible range in steps of 5 nm."""

type Bell = tuple[float, float, float, float]
"""Height, wavelength of the peak, widths below and above it in nm: see `bell`."""


def bell(wavelengths_nm: ArrayLike, peak_nm: float, below_nm: float, above_nm: float) -> Floats:
    """A bell curve of height 1 (...), whose two halves may differ in width.

    Raises `ValueError` unless both standard deviations are above 0.
    """
    narrowest = np.min((below_nm, above_nm))  # NaN if either is
    require("width_nm", narrowest, 0 < narrowest < np.inf, "above 0, finite")
    with np.errstate(over="ignore"):
        off = np.asarray(wavelengths_nm, float) - peak_nm
        return np.exp(-0.5 * np.square(off / np.where(off < 0, below_nm, above_nm)))


def bells(wavelengths_nm: ArrayLike, shapes: tuple[Bell, ...]) -> Floats:
    """The sum of some bells at wavelengths (...)."""
    at = np.asarray(wavelengths_nm, float)
    total = np.zeros(at.shape)
    for height, peak_nm, below_nm, above_nm in shapes:
        total += height * bell(at, peak_nm, below_nm, above_nm)
    return total


def through_knots(values: ArrayLike) -> Floats:
    """Spectra (..., 81) that run smoothly through values (..., K) evenly spaced over the range.

    A natural cubic spline: the curve of least bending, straight at its ends.
    """
    known = np.asarray(values, float)
    count = known.shape[-1]
    require("knots", count, count > 2, "three or more")
    # A tridiagonal system maps the curvatures, 0 at both ends, to second differences.
    inner = count - 2
    system = 4.0 * np.eye(inner) + np.eye(inner, k=1) + np.eye(inner, k=-1)
    bending = np.zeros(known.shape)
    second = 6.0 * np.diff(known, n=2, axis=-1)
    bending[..., 1:-1] = np.linalg.solve(system, second[..., None])[..., 0]
    place = np.linspace(0.0, count - 1.0, WAVELENGTHS_NM.size)
    knot = np.minimum(place.astype(int), count - 2)
    right = place - knot
    left = 1.0 - right
    return (
        left * known[..., knot]
        + right * known[..., knot + 1]
        + (left**3 - left) / 6.0 * bending[..., knot]
        + (right**3 - right) / 6.0 * bending[..., knot + 1]
    )
