"""A lens whose elements are off centre, so that distortion depends on more than the radius.

With p = (p₂, p₁), x a point of the plane and g the radial factor of r² = x·x, Brown's map is ``x ↦
g(r²) x + 2 (p·x) x + r² p``. It is a gradient, so its Jacobian is symmetric. D. C. Brown,
*Decentering distortion of lenses*, 1966.
"""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.models.distortion.decentred_sheet import on_sheet_of_axis, sheet_of
from simulations.models.distortion.plane_newton import Linearisation, newton_step, solve_in_plane
from simulations.models.distortion.radial_inverse import FURTHEST
from simulations.models.distortion.radial_profile import RadialProfile, scale_and_slope

CAREFUL_STEPS = 40
"""Bound on the steps for points that whole steps lose: halved steps along a fold are many."""

MOST_HALVINGS = 12
"""Halvings of a step before it is given up."""


@dataclass(frozen=True, slots=True)
class DecentredLens:
    """The radial part and the tangential coefficients."""

    radial: RadialProfile
    p1: float
    """Coefficient of lens elements decentred along y."""
    p2: float
    """Coefficient of lens elements decentred along x."""

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

    def on_sheet(self, ideal: Floats) -> Mask:
        """Whether the map preserves orientation all the way from the axis to points (N, 2)."""
        return on_sheet_of_axis(ideal, self.radial, self.p1, self.p2)

    @property
    def sure_radius(self) -> float:
        """Radius up to which the map preserves orientation in every direction."""
        return sheet_of(self.radial, self.p1, self.p2).sure


def undo_decentred(seen: Floats, start: Floats, lens: DecentredLens) -> tuple[Floats, Mask]:
    """Ideal points (..., 2) of seen ones, by Newton's method in the plane; and validity.

    ``start`` is the inverse by the radial part alone; invalid points stay there. Points are valid
    within `FURTHEST` if the lens maps them to the seen point and the map preserves orientation on
    the straight line from the axis to them. Points behind a fold are invalid even beyond the fold's
    end, as some of them share their image with a valid point.

    Whole Newton steps find nearly all points. The others are searched again by steps that never
    leave the sheet of the axis.
    """
    wanted, begin = seen.reshape(-1, 2), start.reshape(-1, 2)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        ideal = solve_in_plane(lens.linearised, wanted, begin)
        valid = _solved(ideal, wanted, lens)
        lost = np.flatnonzero(~valid & np.isfinite(wanted).all(axis=1))
        if lost.size:
            ideal[lost] = _newton_on_sheet(wanted[lost], begin[lost], lens)
            valid[lost] = _solved(ideal[lost], wanted[lost], lens)
    ideal = np.where(valid[:, None], ideal, begin)
    return ideal.reshape(seen.shape), np.asarray(valid.reshape(seen.shape[:-1]))


def _solved(ideal: Floats, wanted: Floats, lens: DecentredLens) -> Mask:
    """Which of the points (N, 2) have the wanted image and are on the sheet of the axis."""
    size = np.abs(wanted).max(axis=1, initial=0.0)
    solved = _residual(ideal, wanted, lens) <= 1e-11 * (1.0 + size)  # false for NaN
    solved &= np.hypot(ideal[:, 0], ideal[:, 1]) < FURTHEST
    solved[solved] = lens.on_sheet(ideal[solved])
    return np.asarray(solved)


def _residual(ideal: Floats, wanted: Floats, lens: DecentredLens) -> Floats:
    """Distance of the images of points (N, 2) from the wanted ones: the larger coordinate."""
    x, y, *_ = lens.linearised(ideal[:, 0], ideal[:, 1])
    return np.maximum(np.abs(x - wanted[:, 0]), np.abs(y - wanted[:, 1]))


def _newton_on_sheet(wanted: Floats, start: Floats, lens: DecentredLens) -> Floats:
    """Newton's method from well within the sheet, each step halved until it stays there and helps.

    Whole steps can jump over a fold and converge behind it. A point that no step helps stays
    unsolved.
    """
    radius = np.hypot(start[:, 0], start[:, 1])
    points = start * np.minimum(1.0, 0.9 * lens.sure_radius / np.maximum(radius, 1e-300))[:, None]
    off = _residual(points, wanted, lens)
    moving = np.arange(len(points))
    for _ in range(CAREFUL_STEPS):
        places = (*points[moving].T, *wanted[moving].T)
        step = np.stack(newton_step(lens.linearised, *places), axis=-1)
        stuck = np.ones(len(moving), bool)
        for halvings in range(MOST_HALVINGS):
            tried = points[moving[stuck]] - step[stuck] / 2.0**halvings
            nearer = _residual(tried, wanted[moving[stuck]], lens)
            helps = nearer < off[moving[stuck]]
            helps[helps] = lens.on_sheet(tried[helps])
            taken = np.flatnonzero(stuck)[helps]
            points[moving[taken]], off[moving[taken]] = tried[helps], nearer[helps]
            stuck[taken] = False
            if not stuck.any():
                break
        moving = moving[~stuck]
        if not moving.size:
            break
    return points
