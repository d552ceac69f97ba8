"""Other ways to undo a radial lens, to be compared with `distortion.undistort`.

All take distorted points (..., 2) in normalised coordinates and return ideal ones; tangential
terms are not undone. All but the last assume points well inside the fold, and none of those
notices when it fails. `distortion.undistort` does, and is what to use where the answer must be
right.
Szeliski, 2nd ed., section 2.1.5; the fixed point is the method of OpenCV's undistortPoints.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models import radial_inverse, radial_profile
from simulations.models.distortion import Distortion, Floats

TABLE_ENTRIES = 1025
"""Enough for linear interpolation to err by thousandths of a pixel."""


def undistort_first_order(xy: ArrayLike, d: Distortion) -> Floats:
    """One division by the factor at the distorted radius instead of the ideal one.

    Off by about 2 k₁² r⁵ for small k₁.
    """
    return undistort_fixed_point(xy, d, steps=1)


def undistort_fixed_point(xy: ArrayLike, d: Distortion, steps: int) -> Floats:
    """Divide by the factor at the latest guess, ``steps`` times: x ← x_d / g(|x|²).

    Each step multiplies the error by about |2 s g'(s) / g(s)| with s = r²; where that exceeds
    1, as it does in strong pincushion, the iteration diverges although an inverse exists.
    """
    seen = np.asarray(xy, float)
    ideal = seen
    for _ in range(steps):
        r2 = ideal[..., 0] ** 2 + ideal[..., 1] ** 2
        ideal = seen / radial_profile.scale(d.radial, r2)[..., None]
    return ideal


def undistort_newton(xy: ArrayLike, d: Distortion, steps: int) -> Floats:
    """Newton's method for the radius alone, from the distorted one; the direction is kept.

    Each step squares the relative error. The whole plane needs one unknown a point, not two.
    """
    seen = np.asarray(xy, float)
    seen_radius = np.hypot(seen[..., 0], seen[..., 1])
    radius = seen_radius
    for _ in range(steps):
        excess = radial_profile.evaluate(d.radial, radius) - seen_radius
        radius = radius - excess / radial_profile.slope(d.radial, radius)
    return _scaled(seen, seen_radius, radius)


def undistort_table(xy: ArrayLike, d: Distortion, entries: int = TABLE_ENTRIES) -> Floats:
    """Linear interpolation in a table of the forward map, read backwards.

    Needs no iteration at all: the ideal radii are evenly spaced up to where their image passes
    the largest radius asked for, and the map is monotone there. Off by O(entries⁻²).
    """
    seen = np.asarray(xy, float)
    seen_radius = np.hypot(seen[..., 0], seen[..., 1])
    furthest, reach = float(seen_radius.max(initial=0.0)), radial_profile.fold_radius(d.radial)
    if reach == np.inf:
        reach = 1.0
        while radial_profile.evaluate(d.radial, reach) < furthest:
            reach *= 1.25
    radii = np.linspace(0.0, reach, entries)
    radius = np.interp(seen_radius, radial_profile.evaluate(d.radial, radii), radii)
    return _scaled(seen, seen_radius, radius)


def undistort_bracketed(xy: ArrayLike, d: Distortion) -> Floats:
    """`radial_inverse.invert_bracketed` for every point: to the last digit, at its price."""
    seen = np.asarray(xy, float)
    seen_radius = np.hypot(seen[..., 0], seen[..., 1])
    return _scaled(seen, seen_radius, radial_inverse.invert_bracketed(d.radial, seen_radius)[0])


def _scaled(seen: Floats, seen_radius: Floats, radius: Floats) -> Floats:
    """Points moved along their own radius; the axis itself stays where it is."""
    ratio = np.divide(radius, seen_radius, out=np.ones_like(radius), where=seen_radius > 0.0)
    ideal: Floats = seen * ratio[..., None]
    return ideal
