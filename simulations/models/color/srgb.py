"""The sRGB curve: from linear light to display values, and back.

*Linear* values are proportional to light; *sRGB* values are encoded for a display (IEC 61966-2-1).
Both lie in [0, 1] for colours that a display shows.

Overflow becomes infinite and undefined values become NaN, without a warning: these functions run on
pictures, and `simulations.engine.raster.to_rgba8` clips them at the end. Szeliski, 2nd ed., section
2.3.2.
"""

from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats, as_floats


def encode_srgb(linear: ArrayLike) -> Floats:
    """Linear light (...) as sRGB values: a straight toe, then the power 1/2.4.

    Exact on [0, 1]. Values outside are extended: above 1 by the same power, below 0 by odd
    symmetry, so that out-of-gamut colours survive a round trip. NaN stays NaN.
    """
    x = as_floats(linear)
    size = np.abs(x)
    curve = 1.055 * np.maximum(size, 0.0031308) ** (1 / 2.4) - 0.055
    toe = 12.92 * np.minimum(size, 0.0031308)
    return np.copysign(np.where(size <= 0.0031308, toe, curve), x)


def decode_srgb(srgb: ArrayLike) -> Floats:
    """sRGB values as linear light; the inverse of `encode_srgb`."""
    x = as_floats(srgb)
    size = np.abs(x)
    with np.errstate(over="ignore"):
        curve = ((np.maximum(size, 0.04045) + 0.055) / 1.055) ** 2.4
    return np.copysign(np.where(size <= 0.04045, size / 12.92, curve), x)


ENTRIES = 65536
"""Of the tables of `encode_srgb`."""


@cache
def _table() -> NDArray[np.float32]:
    """The table of `encode_srgb_table`, made on first use."""
    return encode_srgb(np.linspace(0.0, 1.0, ENTRIES)).astype(np.float32)


@cache
def _code_table() -> NDArray[np.uint8]:
    """The table of `encode_srgb_codes`, made on first use."""
    return np.rint(255.0 * _table()).astype(np.uint8)


def encode_srgb_table(linear: ArrayLike) -> NDArray[np.float32]:
    """`encode_srgb` from a table of 65 536 entries: quicker, for pictures.

    Clips to [0, 1] and takes NaN as 0. In the shadows, where the curve is steepest, an entry
    stands for 0.05 codes of 255: the table is off by half of that at most.
    """
    return _table()[_entries(linear)]


def encode_srgb_codes(linear: ArrayLike) -> NDArray[np.uint8]:
    """`encode_srgb_table` rounded to codes from 0 to 255."""
    return _code_table()[_entries(linear)]


def _entries(linear: ArrayLike) -> NDArray[np.intp]:
    """The entries (...) of linear light (...): int32 would be converted when they are taken. None
    is out of range."""
    place = np.asarray(np.maximum(as_floats(linear), 0))  # from here on in place: a new array
    if np.isnan(np.max(place, initial=0)):  # a cast of NaN to an index would be undefined
        np.fmax(place, 0, out=place)
    np.minimum(place, 1, out=place)
    place *= ENTRIES - 1
    place += 0.5
    return place.astype(np.intp)
