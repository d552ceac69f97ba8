"""The images of a point and of waves by a perfect lens with a round opening, in and out of focus.

Light is incoherent and of one wavelength; the lens is wide against it and far from the sensor.
Frequencies on the sensor are in cycles per millimetre, small lengths in micrometres. Goodman,
*Introduction to Fourier Optics*, 3rd ed., 2005, chapter 6; Hopkins, *The frequency response of a
defocused optical system*, 1955. J₀: Abramowitz and Stegun, *Handbook of Mathematical Functions*,
1964, 9.4.1 and 9.4.3.
"""

from functools import lru_cache

import numpy as np
from numpy.polynomial.polynomial import polyval
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.lens.vignetting import disc_overlap_area
from simulations.models.require import require, require_positive

NEAR = (1.0, -2.2499997, 1.2656208, -0.3163866, 0.0444479, -0.0039444, 0.0002100)
"""Coefficients of the powers of (x/3)², for x up to 3."""
SIZE = (0.79788456, -0.00000077, -0.00552740, -0.00009512, 0.00137237, -0.00072805, 0.00014476)
LAG = (-0.78539816, -0.04166397, -0.00003954, 0.00262573, -0.00054125, -0.00029333, 0.00013558)
"""Coefficients of the powers of 3/x, for x above 3: the amplitude of a cosine that falls with √x,
and the difference of its phase from x."""


def bessel_j0(x: ArrayLike) -> Floats:
    """J₀ at real arguments (...), to 1e-7.

    Raises `ValueError` beyond ±1e6, where the phase begins to lose that accuracy to rounding.
    """
    size = np.abs(np.asarray(x, float))
    require("x", size, np.all(size <= 1e6), "at most 1e6 in size")
    close, answer = size <= 3.0, np.empty_like(size)
    answer[close] = polyval((size[close] / 3.0) ** 2, NEAR)
    far = size[~close]
    turns = far + polyval(3.0 / far, LAG)
    answer[~close] = polyval(3.0 / far, SIZE) / np.sqrt(far) * np.cos(turns)
    return answer


FIRST_ZERO = 1.2196698912665045
"""Radius of the spot's first dark ring, in λN: the first zero of J₁ over π."""
NODES = 96
"""Points of the quadrature over the opening: enough for so many waves of defocus ..."""
MOST_WAVES = 12.0
WIDEST_RINGS = 60.0
"""... and for so wide a part of the spot, in λN."""


def cutoff_per_mm(wavelength_um: float, f_number: float) -> float:
    """The highest frequency that the lens transmits: 1/(λN)."""
    wavelength_um, f_number = _checked(wavelength_um, f_number)
    return 1000.0 / wavelength_um / f_number


def spot_diameter_um(wavelength_um: float, f_number: float) -> float:
    """Diameter of the first dark ring around the image of a point in focus: 2.44 λN."""
    wavelength_um, f_number = _checked(wavelength_um, f_number)
    return 2.0 * FIRST_ZERO * wavelength_um * f_number


def defocus_waves(defocus_um: float, wavelength_um: float, f_number: float) -> float:
    """Error of the wave front at the rim of the opening, in wavelengths: δ/(8λN²).

    For a sensor at ``defocus_um`` from the focus. At one wave the middle of the spot is dark.
    """
    wavelength_um, f_number = _checked(wavelength_um, f_number)
    require("defocus_um", defocus_um, np.isfinite(defocus_um), "finite")
    return float(defocus_um) / 8.0 / wavelength_um / f_number / f_number


def lens_transfer(
    frequency_per_mm: ArrayLike, wavelength_um: float, f_number: float, defocus_um: float = 0.0
) -> Floats:
    """Factor (...) on the contrast of waves of a frequency (...): the lens's transfer function.

    It is the share of the opening that overlaps a copy of itself, shifted in proportion to the
    frequency. In focus that is ``2/π (arccos ν − ν √(1 − ν²))``, ν = f/cut-off, which loses its
    digits near the cut-off; `disc_overlap_area` keeps them. Out of focus the two differ in phase
    from place to place, and the factor may be negative: dark and light are exchanged. Its size is
    the MTF.

    Raises `ValueError` for NaN, and for a defocus of more than `MOST_WAVES`.
    """
    frequency = np.abs(np.asarray(frequency_per_mm, float))
    require("frequency_per_mm", frequency, not np.isnan(frequency).any(), "numbers")
    waves = _waves(defocus_um, wavelength_um, f_number)
    shortest = float(wavelength_um) * float(f_number) / 1000.0  # 0 or infinite at the extremes
    with np.errstate(over="ignore", invalid="ignore"):
        share = np.minimum(np.where(frequency > 0.0, frequency * shortest, 0.0), 1.0)
    share = np.where(np.isinf(frequency), 1.0, share)
    if waves == 0.0:
        through = share < 1.0
        factor = np.zeros_like(share)
        factor[through] = disc_overlap_area(2.0 * share[through], 1.0, 1.0) / np.pi
        return factor
    widest = np.arctan2(np.sqrt((1.0 - share) * (1.0 + share)), share)  # all digits of it near 1
    nodes, weights = _quadrature()
    angle = widest[..., None] * nodes
    off = 8.0 * np.pi * waves * share[..., None] * (np.cos(angle) - share[..., None])
    heights = np.sin(angle) ** 2 * np.cos(off)
    return 4.0 / np.pi * widest * np.einsum("...n,n->...", heights, weights)


def spot(
    radius_um: ArrayLike, wavelength_um: float, f_number: float, defocus_um: float = 0.0
) -> Floats:
    """Light (...) at distances (...) from the middle of a point's image: 1 there in focus.

    Raises `ValueError` for radii above `WIDEST_RINGS` λN and a defocus of more than `MOST_WAVES`.
    """
    waves = _waves(defocus_um, wavelength_um, f_number)
    with np.errstate(over="ignore"):
        rings = np.asarray(radius_um, float) / wavelength_um / f_number
    require("radius_um", rings, np.all(np.abs(rings) <= WIDEST_RINGS), f"to {WIDEST_RINGS:g} λN")
    nodes, weights = _quadrature()
    waves_at = 2.0 * nodes * weights * np.exp(2j * np.pi * waves * nodes * nodes)
    amplitude = np.einsum("...n,n->...", bessel_j0(np.pi * rings[..., None] * nodes), waves_at)
    return np.square(amplitude.real) + np.square(amplitude.imag)


def _waves(defocus_um: float, wavelength_um: float, f_number: float) -> float:
    waves = defocus_waves(defocus_um, wavelength_um, f_number)
    require("defocus in waves", waves, abs(waves) <= MOST_WAVES, f"at most {MOST_WAVES:g} in size")
    return waves


@lru_cache
def _quadrature() -> tuple[Floats, Floats]:
    """Gauss–Legendre nodes (n,) in [0, 1] and weights (n,) that add up to 1."""
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    return 0.5 + 0.5 * nodes, 0.5 * weights


def _checked(wavelength_um: float, f_number: float) -> tuple[float, float]:
    """The two as Python's floats, whose products and quotients overflow without a warning."""
    require_positive("wavelength_um", wavelength_um)
    require_positive("f_number", f_number)
    return float(wavelength_um), float(f_number)
