"""Faster approximations of slerp, and a slow reference.

All interpolate between two unit quaternions on the same hemisphere, along the same great circle;
only their speed differs. Source: Szeliski, Computer Vision, 2nd ed., §2.1.3.
"""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.geometry import quaternions
from simulations.models.geometry.rotations import checked_share, nlerp, slerp

STRAIGHT = 0.9995
"""Cosine above which `threshold_slerp` interpolates linearly."""
HALVINGS = 40
"""Steps of `bisected_arc`: the last straight line is then no longer than 2e−12."""


def paced_nlerp(start: ArrayLike, end: ArrayLike, share: ArrayLike) -> Floats:
    """`nlerp` with a corrected share, so that the speed is nearly constant; no sine.

    Coefficients by A. Kapoulkine, "Approximating slerp", 2015, fitted over arcs up to 90° and
    shares from 0 to 1, which alone are legal.
    """
    q0, q1 = np.asarray(start, float), np.asarray(end, float)
    s = checked_share(share, 0.0, 1.0)[..., None]
    dot = np.abs((q0 * q1).sum(axis=-1, keepdims=True))
    a = 1.0904 + dot * (-3.2452 + dot * (3.55645 - dot * 1.43519))
    b = 0.848013 + dot * (-1.06021 + dot * 0.215638)
    off_centre = s - 0.5
    bent = s + s * off_centre * (s - 1.0) * (a * off_centre**2 + b)
    return nlerp(q0, q1, bent[..., 0])


def threshold_slerp(start: ArrayLike, end: ArrayLike, share: ArrayLike) -> Floats:
    """The slerp of many programs: Ω = acos(q₀·q₁), and linear interpolation if the cosine is near
    1.

    That avoids 0/0, but the customary threshold 0.9995 applies to all rotations up to 3.6°.
    """
    q0, q1 = np.asarray(start, float), np.asarray(end, float)
    s = checked_share(share)[..., None]
    dot = (q0 * q1).sum(axis=-1, keepdims=True)
    q1, dot = np.where(dot < 0.0, -q1, q1), np.abs(dot)
    straight = dot > STRAIGHT
    arc = np.arccos(np.where(straight, 0.0, dot))
    per_sine = 1.0 / np.sin(arc)
    weight0 = np.where(straight, 1.0 - s, np.sin((1.0 - s) * arc) * per_sine)
    weight1 = np.where(straight, s, np.sin(s * arc) * per_sine)
    return quaternions.normalise(weight0 * q0 + weight1 * q1)


type Blend = Callable[[ArrayLike, ArrayLike, ArrayLike], Floats]

BLENDS: Mapping[str, Blend] = {
    "nlerp": nlerp,
    "paced-nlerp": paced_nlerp,
    "slerp-threshold": threshold_slerp,
    "slerp": slerp,
}
"""Interpolations from start (..., 4) to end (..., 4), unit quaternions, by a share (...); from
cheap to expensive."""


def bisected_arc(start: ArrayLike, end: ArrayLike, share: ArrayLike) -> Floats:
    """Slerp by bisection: the sum of two unit vectors points to the middle between them.

    Each of `HALVINGS` steps goes into the half that holds the share, which must lie in [0, 1]; the
    rest is a straight line. No sine, no angle, extended precision: (..., 4) long doubles.
    """
    low, high = (_unit(np.asarray(each, np.longdouble)) for each in (start, end))
    rest = checked_share(share, 0.0, 1.0).astype(np.longdouble)[..., None]
    for _ in range(HALVINGS):
        middle = _unit(low + high)
        upper = rest >= 0.5
        low, high = np.where(upper, middle, low), np.where(upper, high, middle)
        rest = 2 * rest - upper
    return _unit((1 - rest) * low + rest * high)


def _unit(vectors: Floats) -> Floats:
    square = (vectors * vectors).sum(axis=-1, keepdims=True)
    length = np.sqrt(square.astype(np.float64)).astype(np.longdouble)
    # One Newton step, since a C library's extended square root may be no better than float64's.
    return vectors / ((length + square / length) / 2)


def turn_between_rad(one: Floats, other: Floats) -> Floats:
    """Angle (...) of the rotation between two unit quaternions (..., 4); q and −q are the same.

    The chord c of an arc φ is 2 sin φ/2, and the rotation turns by 2φ: accurate where the
    arccosine of the dot product is not.
    """
    square = np.minimum(
        ((one - other) ** 2).sum(axis=-1), ((one + other) ** 2).sum(axis=-1)
    ).astype(np.float64)
    return 4.0 * np.arcsin(np.sqrt(square) / 2.0)
