"""Other inverses of a radial lens, for comparison with `lens_model.undistort`.

All take distorted points (..., 2) in normalised coordinates and return ideal ones; all but the
closed form ignore tangential terms. The first order, the fixed point, Newton's method and the
lookup table assume points well inside the fold and do not detect when they fail;
`lens_model.undistort` does. Those four compute the factor ρ = r / r_d as a function of t = r_d²,
without a square root: the lens's polynomials are in r² = ρ² t, and a point is multiplied by its
factor.

Szeliski, 2nd ed., section 2.1.5; the fixed point is the method of OpenCV's undistortPoints.
"""

from collections.abc import Callable, Mapping
from functools import partial
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.distortion import radial_inverse, radial_profile
from simulations.models.distortion.lens_model import Distortion, undistort_clamped, undo_by_table
from simulations.models.distortion.radial_profile import RadialProfile

TABLE_ENTRIES = 1025
"""Enough for linear interpolation to err by ten-thousandths of a pixel."""

LEAST_START = 0.6
"""Least first guess of r / r_d in Newton's method; the ratio itself is larger if k₁ r_d² < 1.8."""

SAMPLES_PER_ENTRY = 4
"""Samples of the forward map per entry; their error is then a sixteenth of that of
interpolation."""


def undistort_first_order(xy: ArrayLike, d: Distortion) -> Floats:
    """One division by the factor at the distorted radius instead of the ideal one.

    Off by about 2 k₁² r⁵ for small k₁.
    """
    return undistort_fixed_point(xy, d, steps=1)


def undistort_fixed_point(xy: ArrayLike, d: Distortion, steps: int) -> Floats:
    """Divide by the lens's factor at the latest guess, ``steps`` times: ρ ← 1 / g(ρ² t).

    Each step multiplies the error by about |2 s g'(s) / g(s)| with s = r²; where that exceeds
    1, as it does in strong pincushion, the iteration diverges although an inverse exists.
    """
    return _along_radius(xy, lambda t: _fixed_point(d.radial, t, steps))


def _fixed_point(profile: RadialProfile, t: Floats, steps: int) -> Floats:
    factor, s = np.ones_like(t), t
    for _ in range(steps):
        factor = 1.0 / radial_profile.scale(profile, s)
        s = factor * factor * t
    return factor


def undistort_newton(xy: ArrayLike, d: Distortion, steps: int) -> Floats:
    """Newton's method for ρ g(ρ² t) = 1, from the first-order value: that for r, in units of r_d.

    Each step squares the relative error. For a barrel and a mild pincushion that start is worth a
    step for half a step's price. A strong pincushion shrinks points by less than the first order
    says, and from there the method would need more steps than from ρ = 1: hence `LEAST_START`.
    """
    return _along_radius(xy, lambda t: _newton(d.radial, t, steps))


def _newton(profile: RadialProfile, t: Floats, steps: int) -> Floats:
    factor = np.maximum(1.0 / radial_profile.scale(profile, t), LEAST_START)
    s = factor * factor * t
    for _ in range(steps):
        factor = factor - (
            factor * radial_profile.scale(profile, s) - 1.0
        ) / radial_profile.slope_at_squared(profile, s)
        s = factor * factor * t
    return factor


def undistort_table(xy: ArrayLike, d: Distortion, entries: int = TABLE_ENTRIES) -> Floats:
    """Linear interpolation in a table of ρ over t, whose entries are evenly spaced.

    Needs no iteration: the entries are read from the forward map, which is monotone up to the
    fold, and a place in the table is a multiplication. Off by O(entries⁻²).
    """
    return _along_radius(xy, lambda t: _look_up(t, *_table(d.radial, float(t.max()), entries)))


def _table(profile: RadialProfile, furthest: float, entries: int) -> tuple[Floats, float]:
    """ρ at evenly spaced t, and the largest t, which is ``furthest`` or the fold's."""
    reach = radial_profile.fold_radius(profile) ** 2
    if reach == np.inf:
        reach = 1.0
        while reach * radial_profile.scale(profile, reach) ** 2 < furthest:
            reach *= 1.5
    s = np.linspace(0.0, reach, SAMPLES_PER_ENTRY * entries)
    g = radial_profile.scale(profile, s)
    images = s * g * g
    limit = min(furthest, float(images[-1]))
    return np.interp(np.linspace(0.0, limit, entries), images, 1.0 / g), limit


def _look_up(t: Floats, values: Floats, limit: float) -> Floats:
    last = len(values) - 1
    place = t * (last / limit if limit > 0.0 else 0.0)
    index = np.minimum(place.astype(np.intp), last - 1)
    place -= index
    place *= np.diff(values).take(index)
    factor: Floats = values.take(index)
    factor += place
    return factor


def _along_radius(xy: ArrayLike, factor_of: Callable[[Floats], Floats]) -> Floats:
    """Points moved along their own radius, each by the factor of its squared radius."""
    seen = np.asarray(xy, float)
    if not seen.size:
        return seen
    x, y = seen[..., 0], seen[..., 1]
    factor = factor_of(x * x + y * y)
    ideal = np.empty_like(seen)
    np.multiply(x, factor, out=ideal[..., 0])  # by columns: three times as quick as
    np.multiply(y, factor, out=ideal[..., 1])  # seen * factor[..., None]
    return ideal


def undistort_bracketed(xy: ArrayLike, d: Distortion) -> Floats:
    """`radial_inverse.invert_bracketed` for every point: exact to the last digit, and slow."""
    seen = np.asarray(xy, float)
    seen_radius = np.hypot(seen[..., 0], seen[..., 1])
    radius, _ = radial_inverse.invert_bracketed(d.radial, seen_radius)
    ratio = np.divide(radius, seen_radius, out=np.ones_like(radius), where=seen_radius > 0.0)
    return seen * ratio[..., None]


def undistort_checked_table(xy: ArrayLike, d: Distortion) -> Floats:
    """`lens_model.undo_by_table` without its mask: past the fold, the fold circle."""
    return undo_by_table(np.asarray(xy, float), d.radial)[0]


def undistort_closed_form(xy: ArrayLike, d: Distortion) -> Floats:
    """`lens_model.undistort_clamped`: the formula for k₁ alone, for other lenses the table."""
    return undistort_clamped(xy, d)[0]


type Inverse = Callable[[ArrayLike, Distortion], Floats]

INVERSES: Mapping[str, Inverse] = MappingProxyType(
    {
        "first-order": undistort_first_order,
        "lookup-table": undistort_table,
        "newton-3": partial(undistort_newton, steps=3),
        "newton-4": partial(undistort_newton, steps=4),
        "newton-5": partial(undistort_newton, steps=5),
        "fixed-point-5": partial(undistort_fixed_point, steps=5),
        "fixed-point-10": partial(undistort_fixed_point, steps=10),
        "fixed-point-20": partial(undistort_fixed_point, steps=20),
        "closed-form": undistort_closed_form,
        "checked-table": undistort_checked_table,
        "newton-bracketed": undistort_bracketed,
    }
)
"""The inverses by their names in the ladders `inverse-distortion` and `inverse-strong`."""
