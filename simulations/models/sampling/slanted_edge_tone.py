"""How far an unknown tone curve of a camera may have changed an MTF50.

A steeper curve makes an edge steeper, so it reads as sharpness, the more the farther the edge's two
sides are apart. ISO 12233:2017 therefore asks for an edge of 4 : 1.
"""

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.color.tone_curve import without_tone_curve
from simulations.models.sampling.first_fall import first_fall
from simulations.models.sampling.slanted_edge import FREQUENCIES, EdgeReading

STEPS = 8
"""Per pixel, of the sum over the edge."""


def tone_error(reading: EdgeReading, strength: float) -> float:
    """Standard error of MTF50 that is due to an unknown curve, in cycles per pixel.

    The edge is straightened as if a curve of this strength had been applied to it.
    """
    reach = reading.pixels.reach
    place = np.arange(-round(STEPS * reach), round(STEPS * reach) + 1) / STEPS
    dark, light = reading.pixels.levels
    seen = dark + (light - dark) * reading.curve.spread(place)
    straight = without_tone_curve(encode_srgb(np.clip(seen, 0.0, 1.0)), strength)
    halves = [_half(place, each) for each in (seen, decode_srgb(straight))]
    return abs(halves[0] - halves[1]) if np.isfinite(halves).all() else 0.0


def _half(place: Floats, light: Floats) -> float:
    """MTF50 of light at places."""
    rises, middles = np.diff(light), 0.5 * (place[1:] + place[:-1])
    waves = np.exp(-2j * np.pi * FREQUENCIES[:, None] * middles)
    return first_fall(FREQUENCIES, np.abs(waves @ rises) / abs(rises.sum()), 0.5)
