"""The tone curve that a camera lays over sRGB, and its strength by several exposures.

Cameras raise the contrast of the middle tones of their JPEGs, each by its own curve. Light that is
exposed twice as long is twice as much: so exposures of one thing tell the curve (S. Mann and R. W.
Picard, "On being 'undigital' with digital cameras", IS&T 48th Annual Conference, 1995). One number
describes it here.
"""

import math

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.require import require

TYPICAL = 0.5
"""Standard deviation of the strength among cameras."""
STRENGTHS = np.linspace(-0.95, 0.95, 381)
"""That are tried; at 1 a curve is flat at its ends."""
FEWEST = 4
"""Exposures of which the strength is told."""
USABLE = (0.02, 0.97)
"""Codes, from 0 to 1, that are neither lost in black nor clipped."""
LEAST_STOPS = 0.05
"""Standard deviation at least of exposures from what the files say."""


def tone_curve(codes: Floats, strength: float) -> Floats:
    """Codes (...) from 0 to 1, steeper by ``strength`` in the middle tones, flatter at the ends.

    Raises `ValueError` for other codes, and for strengths that are not between -1 and 1.
    """
    codes = _checked(codes)
    require("strength", strength, -1 < strength < 1, "between -1 and 1")
    return codes - strength / (2 * np.pi) * np.sin(2 * np.pi * codes)


def without_tone_curve(codes: Floats, strength: float) -> Floats:
    """Codes (...) before a curve of this strength, likewise."""
    before = np.linspace(0.0, 1.0, 4097)
    return np.interp(_checked(codes), tone_curve(before, strength), before)


def _checked(codes: Floats) -> Floats:
    codes = np.asarray(codes, float)
    require("codes", codes, np.all((codes >= 0) & (codes <= 1)), "0 to 1")
    return codes


def tone_by_exposures(light: Floats, exposures: Floats) -> tuple[float, float] | None:
    """Strength of a camera's curve and its standard error; ``None`` if there are too few frames.

    ``light`` (N,) is what the codes of evenly lit frames mean in sRGB, 1 for white; ``exposures``
    (N,) are in any unit, NaN where they are not known. No camera has just this family of curves:
    what the frames are off by more than their shutters is taken for one common fault, and the
    strength of the darker ones is compared with that of the brighter ones.
    """
    codes = encode_srgb(np.clip(light, 0.0, 1.0))
    used = np.flatnonzero((codes > USABLE[0]) & (codes < USABLE[1]) & (exposures > 0))
    used = used[np.argsort(codes[used])]
    stops, count = np.log2(exposures[used]), len(used)
    if len(set(stops.tolist())) < FEWEST:
        return None
    found = [np.log2(decode_srgb(without_tone_curve(codes[used], each))) for each in STRENGTHS]
    off = np.array(found) - stops
    strength, scatter, slope = _best(off)
    common = math.sqrt(count * max(scatter**2 - LEAST_STOPS**2, 0.0))
    third = count // 3
    apart = _best(off[:, third:])[0] - _best(off[:, :-third])[0] if third > 1 else 0.0
    return strength, math.hypot(LEAST_STOPS / slope, common / slope, apart)


def _best(off: Floats) -> tuple[float, float, float]:
    """The strength for which frames differ least by their stops (strengths, N), the deviation that
    is left, and how much they change with the strength, root of the sum of squares."""
    off = off - off.mean(axis=1, keepdims=True)
    best = int(np.argmin((off**2).sum(axis=1)))
    slope = np.gradient(off, STRENGTHS, axis=0)[best]
    strength = STRENGTHS[best] - (slope @ off[best]) / (slope @ slope)
    scatter = math.sqrt((off[best] @ off[best]) / max(len(slope) - 2, 1))
    return float(strength), scatter, math.sqrt(slope @ slope)
