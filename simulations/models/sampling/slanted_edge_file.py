"""The light in the codes of a picture file, for measuring an edge."""

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.color.cie import luminance
from simulations.models.color.srgb import decode_srgb
from simulations.models.color.tone_curve import without_tone_curve
from simulations.models.sampling.slanted_edge_line import SMALLEST, TOO_SMALL, UnfitEdgeError

MOST_CLIPPED = 0.01
"""Share of the pixels that may have the code 0 or 255."""
PLATEAU, LEAST_NOISE = 0.7, 0.3
"""Share of the pixels of a side that have its last code where it is clipped, and least noise in
codes by that of the other side: with less, so many may have it by chance."""

TOO_LIGHT = "The light side is overexposed: expose less, so that white stays below code {}."
TOO_DARK = "The dark side is at code {}: expose more, or turn down the contrast of the camera."


def light_of_codes(codes: NDArray[np.uint8], *, srgb: bool, tone: float = 0.0) -> Floats:
    """Luminance (H, W) of codes (H, W, 3), with 1 for white.

    Codes are decoded as ``srgb`` after a tone curve of this strength, or taken as proportional to
    the light. Raises `UnfitEdgeError` if there are too few, or too many are clipped, at the ends of
    the scale or at others: of those the light is unknown.
    """
    if codes.ndim != 3 or codes.shape[2] != 3 or codes.dtype != np.uint8:
        raise ValueError(f"codes {codes.shape} {codes.dtype}; legal: (H, W, 3) uint8")
    if min(codes.shape[:2]) < SMALLEST:
        raise UnfitEdgeError(TOO_SMALL)
    largest = np.maximum(np.maximum(codes[..., 0], codes[..., 1]), codes[..., 2])
    if np.mean(largest == 255) > MOST_CLIPPED:
        raise UnfitEdgeError(TOO_LIGHT.format(255))
    if np.mean(largest == 0) > MOST_CLIPPED:
        raise UnfitEdgeError(TOO_DARK.format(0))
    light = light_of_code(srgb=srgb, tone=tone)
    # a grey picture has three equal channels
    for counts in {np.bincount(codes[..., k].ravel(), minlength=256).tobytes() for k in range(3)}:
        require_no_plateau(np.frombuffer(counts, np.intp), light)
    return luminance(light.astype(np.float32)[codes])


def require_no_plateau(counts: NDArray[np.intp], light: Floats) -> None:
    """Raises `UnfitEdgeError` if one side of an edge is clipped, by the counts of the codes (256,):
    most of its pixels share its last code, though the other side has noise. Noise in the light is
    no less than in the dark, and in the dark no less than in proportion to √light."""
    low, high = (int(np.searchsorted(np.cumsum(counts), s * counts.sum())) for s in (0.05, 0.95))
    split = int(np.searchsorted(light, 0.5 * (light[low] + light[high])))
    (dark, by_dark), (bright, by_bright) = (
        _middle_and_noise(counts[::step], light[::step], count)
        for step, count in ((1, split), (-1, len(light) - split))
    )
    used, per_code = np.flatnonzero(counts), np.gradient(light)
    last, first = int(used[-1]), int(used[0])
    if counts[last] > PLATEAU * counts[split:].sum() and by_dark > LEAST_NOISE * per_code[last]:
        raise UnfitEdgeError(TOO_LIGHT.format(last))
    fainter = by_bright * np.sqrt(max(dark, 0.0) / max(bright, 1e-9))
    if counts[first] > PLATEAU * counts[:split].sum() and fainter > LEAST_NOISE * per_code[first]:
        raise UnfitEdgeError(TOO_DARK.format(first))


def _middle_and_noise(counts: NDArray[np.intp], light: Floats, side: int) -> tuple[float, float]:
    """Median light of the first ``side`` codes, and the standard deviation of those before it, away
    from the edge."""
    total = np.cumsum(counts[:side])
    middle = int(np.searchsorted(total, 0.5 * total[-1])) if side else 0
    beyond = counts[: middle + 1]
    square = np.sum(beyond * (light[: middle + 1] - light[middle]) ** 2) / max(beyond.sum(), 1)
    return float(light[middle]), float(np.sqrt(square))


def light_of_code(*, srgb: bool, tone: float = 0.0) -> Floats:
    """(256,) the light of each code, likewise."""
    codes = np.linspace(0.0, 1.0, 256)
    return decode_srgb(without_tone_curve(codes, tone)) if srgb else codes
