"""How much fine detail a picture has, and how much of it is in the right place.

A difference of pixels cannot distinguish lost detail from displaced detail. The amplitude of a
picture's waves can: it stays the same if the picture is shifted, and falls if the picture is
blurred. Bracewell, *The Fourier Transform and Its Applications*, 3rd ed., 2000, chapter 6: the
shift theorem, and Rayleigh's.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.require import require

FINE = 1 / 6
"""Cycles per pixel: waves shorter than six pixels count as fine, up to the Nyquist frequency."""

LARGEST = 1e100
"""Largest value of a pixel, so that sums of squares are finite."""


@dataclass(frozen=True, slots=True)
class FineDetail:
    """Fine detail relative to the true picture, as shares of its contrast."""

    present: float
    """Contrast of all fine waves: 1 if none was lost, more if some are false."""
    in_place: float
    """The part that agrees with the truth: 1 if nothing was lost or displaced."""


def fine_detail(picture: ArrayLike, truth: ArrayLike, finest: float = FINE) -> FineDetail:
    """Compare pictures (H, W) in the waves from ``finest`` to 1/2 cycle per pixel.

    The spectrum treats a picture as periodic, so both should fade to the same grey at their
    borders. Raises `ValueError` for shapes that differ, values that are not finite, and a truth
    that has no such waves.
    """
    seen, true = (np.asarray(each, np.float64) for each in (picture, truth))
    if seen.shape != true.shape or seen.ndim != 2:
        raise ValueError(f"pictures of shapes {seen.shape} and {true.shape}; legal: equal, (H, W)")
    for name, values in (("picture", seen), ("truth", true)):
        legal = bool((np.abs(values) <= LARGEST).all())
        require(name, values, legal, f"finite, at most {LARGEST:g} in size")
    chosen = _band(true.shape[0], true.shape[1], finest)
    ours, theirs = (np.fft.fft2(each - each.mean())[chosen] for each in (seen, true))
    whole = float(np.sum(np.square(np.abs(theirs))))
    require("contrast of the truth's fine waves", whole, whole > 0, "above 0")
    return FineDetail(
        present=math.sqrt(float(np.sum(np.square(np.abs(ours)))) / whole),
        in_place=float(np.sum((ours * theirs.conj()).real)) / whole,
    )


def _band(height: int, width: int, finest: float) -> np.ndarray[tuple[int, ...], np.dtype[np.bool]]:
    frequency = _frequency(height, width)
    return (frequency >= finest) & (frequency <= 0.5)


def _frequency(height: int, width: int) -> Floats:
    """(H, W) cycles per pixel of each wave of the spectrum, whatever its direction."""
    return np.hypot(np.fft.fftfreq(height)[:, None], np.fft.fftfreq(width))
