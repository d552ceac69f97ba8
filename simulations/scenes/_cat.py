"""A photograph of a cat, taken to be sharp, through any blur."""

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats, Planes
from simulations.models.color.srgb import decode_srgb
from simulations.pictures.photographs import cat

MARGIN_PX = 16  # mirrored beyond each border


@cache
def sharp() -> Planes:
    """(3, 192, 240) linear light."""
    codes = np.float32(1 / 255) * cat.codes()
    return np.ascontiguousarray(decode_srgb(codes).astype(np.float32).transpose(2, 0, 1))


@cache
def _waves() -> NDArray[np.complexfloating]:
    around = (MARGIN_PX, MARGIN_PX)
    return np.fft.rfft2(np.pad(sharp(), ((0, 0), around, around), "reflect"))


def blurred(factor: Callable[[Floats, Floats], Floats]) -> Planes:
    """(3, 192, 240) with each wave multiplied by its ``factor``, given its frequencies down and
    across in cycles per pixel."""
    height, width = (side + 2 * MARGIN_PX for side in sharp().shape[1:])
    transfer = factor(np.fft.fftfreq(height)[:, None], np.fft.rfftfreq(width)).astype(np.float32)
    filtered = np.fft.irfft2(_waves() * transfer, (height, width))
    inside = slice(MARGIN_PX, -MARGIN_PX)
    return np.clip(filtered[:, inside, inside], 0.0, 1.0)
