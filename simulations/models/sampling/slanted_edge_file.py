"""The light in the codes of a picture file, for measuring an edge."""

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.color.cie import luminance
from simulations.models.color.srgb import decode_srgb
from simulations.models.color.tone_curve import without_tone_curve
from simulations.models.sampling.slanted_edge_line import SMALLEST, TOO_SMALL, UnfitEdgeError

MOST_CLIPPED = 0.01
"""Share of the pixels that may have the smallest or the largest code."""

TOO_LIGHT = "The light side is overexposed: expose less, so that white stays below code 255."
TOO_DARK = "The dark side is at code 0: expose more, or turn down the contrast of the camera."


def light_of_codes(codes: NDArray[np.uint8], *, srgb: bool, tone: float = 0.0) -> Floats:
    """Luminance (H, W) of codes (H, W, 3), with 1 for white.

    Codes are decoded as ``srgb`` after a tone curve of this strength, or taken as proportional to
    the light. Raises `UnfitEdgeError`
    if there are too few, or too many are clipped: of those the light is unknown.
    """
    if codes.ndim != 3 or codes.shape[2] != 3 or codes.dtype != np.uint8:
        raise ValueError(f"codes {codes.shape} {codes.dtype}; legal: (H, W, 3) uint8")
    if min(codes.shape[:2]) < SMALLEST:
        raise UnfitEdgeError(TOO_SMALL)
    largest = np.maximum(np.maximum(codes[..., 0], codes[..., 1]), codes[..., 2])
    if np.mean(largest == 255) > MOST_CLIPPED:
        raise UnfitEdgeError(TOO_LIGHT)
    if np.mean(largest == 0) > MOST_CLIPPED:
        raise UnfitEdgeError(TOO_DARK)
    return luminance(light_of_code(srgb=srgb, tone=tone).astype(np.float32)[codes])


def light_of_code(*, srgb: bool, tone: float = 0.0) -> Floats:
    """(256,) the light of each code, likewise."""
    codes = np.linspace(0.0, 1.0, 256)
    return decode_srgb(without_tone_curve(codes, tone)) if srgb else codes
