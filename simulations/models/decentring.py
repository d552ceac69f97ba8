"""A lens whose elements are off centre: no longer a matter of the radius alone.

With p = (p₂, p₁), x a point of the plane and g the radial factor of r² = x·x, Brown's map is
``x ↦ g(r²) x + 2 (p·x) x + r² p``. It is a gradient, so its Jacobian is symmetric.
D. C. Brown, *Decentering distortion of lenses*, 1966.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.models.plane_newton import Linearisation, solve_in_plane
from simulations.models.radial_inverse import FURTHEST
from simulations.models.radial_profile import RadialProfile, scale_and_slope

type Floats = NDArray[np.floating]
type Mask = NDArray[np.bool_]

SHEET_SAMPLES = 16
"""Points between the axis and a solution at which the map must still keep its orientation."""

SURE_SAMPLES = 257
"""Radii at which it is asked how far out it keeps it in every direction."""


@dataclass(frozen=True, slots=True)
class DecentredLens:
    """The radial part and the tangential coefficients."""

    radial: RadialProfile
    p1: float
    """Of lens elements decentred along y."""
    p2: float
    """Of lens elements decentred along x."""

    def linearised(self, x: Floats, y: Floats) -> Linearisation:
        """Images of points, and the derivatives there."""
        r2 = x * x + y * y
        g, g_slope = scale_and_slope(self.radial, r2)
        along = g + 2.0 * (self.p1 * y + self.p2 * x)
        steepening = 2.0 * x * g_slope
        x_by_x = along + x * (steepening + 4.0 * self.p2)
        y_by_y = along + y * (2.0 * y * g_slope + 4.0 * self.p1)
        mixed = y * (steepening + 2.0 * self.p2) + 2.0 * self.p1 * x
        return x * along + self.p2 * r2, y * along + self.p1 * r2, x_by_x, mixed, y_by_y


def undo_decentred(seen: Floats, start: Floats, lens: DecentredLens) -> tuple[Floats, Mask]:
    """Ideal points (..., 2) of seen ones, by Newton's method in the plane; and validity.

    ``start`` is what the radial part alone makes of them, and what invalid points are left at.
    Valid are points within `FURTHEST` that the lens sends where they were seen, on the sheet of
    the axis: between it and them the map nowhere turns over.
    """
    wanted = seen.reshape(-1, 2)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        ideal = solve_in_plane(lens.linearised, wanted, start.reshape(-1, 2))
        x, y, *_ = lens.linearised(ideal[:, 0], ideal[:, 1])
        off = np.maximum(np.abs(x - wanted[:, 0]), np.abs(y - wanted[:, 1]))
        size = np.maximum(np.abs(wanted[:, 0]), np.abs(wanted[:, 1]))
        valid = off <= 1e-11 * (1.0 + size)  # false for NaN
        valid &= np.hypot(ideal[:, 0], ideal[:, 1]) < FURTHEST
        valid[valid] = _same_sheet(ideal[valid], lens)
    ideal = np.where(valid[:, None], ideal, start.reshape(-1, 2))
    return ideal.reshape(seen.shape), np.asarray(valid.reshape(seen.shape[:-1]))


def _same_sheet(ideal: Floats, lens: DecentredLens) -> Mask:
    """Whether the map keeps its orientation all the way from the axis to each point (N, 2)."""
    radius = np.hypot(ideal[:, 0], ideal[:, 1])
    keeps = radius <= _sure_radius(float(radius.max(initial=0.0)), lens)
    doubtful = ideal[~keeps]
    kept = np.ones(len(doubtful), bool)
    for fraction in np.linspace(0.0, 1.0, SHEET_SAMPLES + 1)[1:]:
        _, _, x_by_x, mixed, y_by_y = lens.linearised(
            fraction * doubtful[:, 0], fraction * doubtful[:, 1]
        )
        kept &= x_by_x * y_by_y > mixed * mixed
    keeps[~keeps] = kept
    return keeps


def _sure_radius(furthest: float, lens: DecentredLens) -> float:
    """The radius, ``furthest`` at most, within which the map turns over in no direction.

    The radial part stretches by g across the radius and by f' along it; the tangential part
    adds ``2 (p·x I + p xᵀ + x pᵀ)``, whose norm is 6 |p| r at most.
    """
    radius = np.linspace(0.0, furthest, SURE_SAMPLES)
    g, g_slope = scale_and_slope(lens.radial, radius * radius)
    least = np.minimum(g, g + 2.0 * radius * radius * g_slope)
    sure = least > 6.0 * np.hypot(lens.p1, lens.p2) * radius
    return furthest if sure.all() else float(radius[np.argmin(sure) - 1])
