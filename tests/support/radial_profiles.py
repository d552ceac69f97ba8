"""Radial profiles to try, and their inverse by a route that shares no code with the models."""

from collections.abc import Sequence

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.distortion.radial_profile import RadialProfile, fold_radius

PROFILES = [
    RadialProfile((0.1,)),
    RadialProfile((-0.05, 0.02, 0.01)),
    RadialProfile((0.2, 0.1), (0.3, 0.05, 0.01)),
    RadialProfile((), (0.1, 0.02)),
    RadialProfile((0.0, 0.2)),
    RadialProfile((0.0, 0.0, 0.1), (0.0, 0.2)),
    RadialProfile((1.0,), (2.0,)),  # rises for ever, and tends to r/2
]
"""The third and the fourth fold."""


def series(coefficients: Sequence[float], s: Floats) -> Floats:
    total = np.zeros_like(s)
    for coefficient in (*reversed(coefficients), 1.0):
        total = total * s + np.longdouble(coefficient)
    return total


def bisect(profile: RadialProfile, image_radius: Floats) -> Floats:
    """The ideal radius, by halving an interval that holds it until floats run out.

    In 80-bit floats; where those are 64 bits long, as with some compilers, it still serves.
    """
    wanted = np.asarray(image_radius).astype(np.longdouble)
    low = np.zeros_like(wanted)
    high = np.full_like(wanted, min(fold_radius(profile), 100.0))
    for _ in range(80):
        middle = (low + high) / 2
        s = middle * middle
        beyond = middle * series(profile.numerator, s) > wanted * series(profile.denominator, s)
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return low
