"""The inverse of a lens with k₁ alone: the root of its cubic in closed form.

With a triple angle, 3 sin φ − 4 sin³ φ = sin 3φ, a barrel ``r + k₁r³ = r_d`` becomes one sine, and
3 sinh φ + 4 sinh³ φ = sinh 3φ does the same for a pincushion. With ``w = (3/2) √(3|k₁|) r_d``,
which is 1 at the fold of a barrel::

    r / r_d = 3 sin(arcsin(w) / 3) / w        k₁ < 0, w ≤ 1
    r / r_d = 3 sinh(arsinh(w) / 3) / w       k₁ > 0

No digits cancel. In units of 2⁻⁵³ times the condition of the inverse, the relative error is 3 at
most for a barrel. For a pincushion it grows with the logarithm of w, to 20 at w = 10⁶.

Source: Press et al., Numerical Recipes, 3rd ed., 2007, §5.6.
"""

from math import sqrt

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.models.distortion.radial_profile import RadialProfile
from simulations.models.require import require

FAR_SQUARED = 1e80
"""Largest squared image radius of a pincushion, as in `radial_inverse.invert_bracketed`."""


def shrinkage(profile: RadialProfile, image_squared: Floats) -> tuple[Floats, Mask]:
    """``r / f(r)`` for each ``f(r)²``, and where the formula applies; 1 elsewhere.

    ``profile`` must be `RadialProfile.cubic`. Where the formula does not apply, use
    `radial_inverse.invert_bracketed`, which decides whether there is an inverse.
    """
    require("profile", profile, profile.cubic, "r + a₁r³, a₁ not 0")
    k1 = profile.numerator[0]
    # Points that rounding may have moved across the fold are left to the bracket.
    limit = (1.0 - 1e-14) * 4.0 / (-27.0 * k1) if k1 < 0.0 else FAR_SQUARED
    known = np.asarray(image_squared < limit)  # false for NaN
    if known.all():
        return shrinkage_of_cubic(k1, image_squared), known
    factor = np.ones_like(image_squared)
    factor[known] = shrinkage_of_cubic(k1, image_squared[known])
    return factor, known


def shrinkage_of_cubic(k1: float, image_squared: Floats) -> Floats:
    """``r / r_d`` (...) for each ``r_d²`` (...), for a k₁ that is not 0.

    For a barrel up to ``r_d² = 4 / (27 |k₁|)``; beyond, the result is on the fold circle.
    """
    w = 1.5 * sqrt(3.0 * abs(k1)) * np.sqrt(image_squared)
    w += np.finfo(float).tiny  # no 0 / 0 on the axis
    if k1 < 0.0:
        return 3.0 * np.sin(np.arcsin(np.minimum(w, 1.0)) / 3.0) / w
    return 3.0 * np.sinh(np.arcsinh(w) / 3.0) / w
