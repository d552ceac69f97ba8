"""Transfer functions of a pixel and of an anti-aliasing plate, and the resolution of a whole chain.

Frequencies are in cycles per millimetre of the sensor, lengths in micrometres. The transfer
function of a chain is the product of those of its links. Szeliski, 2nd ed., sections 2.3.1 and 3.4.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.require import require, require_positive

FULL_FRAME_DIAGONAL_MM = 43.267
"""Diagonal of 36 mm × 24 mm, to which the equivalent focal length in EXIF refers."""


def pixel_pitch_um(
    focal_mm: float, equivalent_mm: float, width_px: float, height_px: float
) -> float:
    """Pixel pitch of a sensor, from its lens's focal length and that with the same angle of view on
    36 mm × 24 mm, both as rounded by the maker of the camera."""
    for name, value in (("focal_mm", focal_mm), ("equivalent_mm", equivalent_mm)):
        require_positive(name, value)
    diagonal_px = float(np.hypot(width_px, height_px))
    require_positive("diagonal in px", diagonal_px)
    focal, equivalent = float(focal_mm), float(equivalent_mm)
    return 1000.0 * FULL_FRAME_DIAGONAL_MM * focal / equivalent / diagonal_px


def nyquist_per_mm(pitch_um: float) -> float:
    """Half a cycle per pixel: 1/(2p)."""
    require_positive("pitch_um", pitch_um)
    return 500.0 / float(pitch_um)


def pixel_transfer(frequency_per_mm: ArrayLike, width_um: float) -> Floats:
    """Transfer factor (...) of the mean over a pixel of this width: sinc(f w), with its sign."""
    return np.sinc(_cycles("width_um", width_um, frequency_per_mm))


def plate_transfer(frequency_per_mm: ArrayLike, separation_um: float) -> Floats:
    """Transfer factor (...) of a plate that doubles the picture, half to either side: cos(π f
    s)."""
    return np.cos(np.pi * _cycles("separation_um", separation_um, frequency_per_mm))


def _cycles(name: str, length_um: float, frequency_per_mm: ArrayLike) -> Floats:
    """Cycles over a length."""
    require(name, length_um, 0 <= length_um <= 1e12, "0 to 1e12")
    frequency = np.asarray(frequency_per_mm, float)
    require(
        "frequency_per_mm", frequency, np.all(np.abs(frequency) <= 1e12), "at most 1e12 in size"
    )
    return frequency * (length_um / 1000.0)
