"""Distortion by the position of the stop, which selects the rays that form the image.

The chief ray of each bundle passes through the centre of the stop. It is traced by Snell's law from
there, forwards and backwards, without a search. Lengths in millimetres, light from the left; the
object is infinitely far.

Kingslake and Johnson, Lens Design Fundamentals, 2nd ed., 2010.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.lens.singlet import (
    Singlet,
    focal_mm,
    meet,
    paraxial_image_mm,
    power_per_mm,
    refract,
)
from simulations.models.require import require


@dataclass(frozen=True, slots=True)
class ChiefRays:
    """The chief rays of bundles."""

    tan_field: Floats
    """(n,) tangent of their angle of incidence to the axis: the pinhole's radius r."""
    image: Floats
    """(n,) distance from the axis where they meet the plane of the sharp image, in focal lengths:
    the distorted radius r_d."""
    places: Floats
    """(n, 2 for each piece of glass, 2) where they enter and leave it: along the axis, and height.
    NaN if a ray misses it or does not come out."""
    image_mm: float
    """Position of the plane of the sharp image."""
    focal_mm: float


@np.errstate(over="ignore", invalid="ignore")
def chief_rays(lens: Singlet, stop_mm: float, slopes: ArrayLike) -> ChiefRays:
    """Rays through the centre of a stop; the origin is the middle of the lens.

    Parameters
    ----------
    lens : Singlet
        Converging.
    stop_mm : float
        Where the stop is, from the middle of the lens: negative in front. Not inside the glass.
    slopes : (n,) floats
        Of the rays where they pass the stop, upwards.
    """
    half, focal = lens.thickness_mm / 2.0, focal_mm(power_per_mm(lens))
    require("stop_mm", stop_mm, abs(stop_mm) >= half, f"outside the glass: {half:g} mm or more")
    require("lens", lens, 0.0 < focal < np.inf, "converging")
    slope = np.atleast_1d(np.asarray(slopes, float))
    image_mm = paraxial_image_mm(lens, np.inf)
    if stop_mm < 0.0:
        front, back, leaves = _through(lens, stop_mm, slope)
        height = back[:, 1] + (image_mm - back[:, 0]) * leaves
        places = np.stack([front, back], axis=1)
        return ChiefRays(slope, height / focal, places, image_mm, focal)
    # Backwards, through the mirrored lens, where rays that go up come from below.
    back, front, came = _through(_mirrored(lens), -stop_mm, -slope)
    places = np.stack([front, back], axis=1) * np.array([-1.0, 1.0])
    return ChiefRays(-came, (image_mm - stop_mm) * slope / focal, places, image_mm, focal)


def chief_rays_of_pair(lens: Singlet, apart_mm: float, slopes: ArrayLike) -> ChiefRays:
    """Through a stop at the origin, with ``lens`` behind it and its mirror image before it.

    Parameters
    ----------
    apart_mm : float
        From the stop to the middle of either lens.
    slopes : (n,) floats
        Of the rays where they pass the stop, upwards.
    """
    slope = np.atleast_1d(np.asarray(slopes, float))
    front, back, leaves = _through(lens, -apart_mm, slope)
    alone = focal_mm(power_per_mm(lens))
    near, far = (paraxial_image_mm(each, np.inf) - alone for each in (_mirrored(lens), lens))
    to_plane = apart_mm - near  # from the stop to the principal plane that faces it
    focal = alone * alone / (2.0 * (alone - to_plane))
    pupil = far + to_plane * alone / (to_plane - alone)  # the image of the stop seen from behind
    height = back[:, 1] + (pupil + focal - back[:, 0]) * leaves
    behind = np.stack([front, back], axis=1) + np.array([apart_mm, 0.0])
    before = -behind[:, ::-1]  # the same, rotated by half a turn about the centre of the stop
    places = np.concatenate([before, behind], axis=1)
    return ChiefRays(leaves, height / focal, places, pupil + focal, focal)


def _mirrored(lens: Singlet) -> Singlet:
    return Singlet(-lens.back_per_mm, -lens.front_per_mm, lens.thickness_mm, lens.index)


def _through(lens: Singlet, stop_mm: float, slope: Floats) -> tuple[Floats, Floats, Floats]:
    """Where rays from the centre of a stop before the lens enter and leave it, and their slopes."""
    half = lens.thickness_mm / 2.0
    start = np.stack([np.full_like(slope, stop_mm), np.zeros_like(slope)], -1)
    along = np.stack([np.ones_like(slope), slope], -1)
    along /= np.hypot(1.0, slope)[:, None]
    front, normal, hits = meet(start, along, -half, lens.front_per_mm)
    inside, _ = refract(along, normal, 1.0 / lens.index)
    back, normal, hits_back = meet(front, inside, half, lens.back_per_mm)
    out, passed = refract(inside, normal, lens.index)
    through = hits & hits_back & passed
    leaves = np.where(through, out[:, 1] / out[:, 0], np.nan)
    front, back = (np.where(through[:, None], each, np.nan) for each in (front, back))
    return front, back, leaves
