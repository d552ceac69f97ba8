"""Soft shadows and contact shadows of spheres and boxes, without sampling the light.

Axes and units are those of `raycasting`.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_floats
from simulations.models.light.raycasting import (
    LARGEST_M,
    NEARLY_ZERO,
    Box,
    Sphere,
    Vector,
    largest_component,
    slab_crossings,
)
from simulations.models.require import require

TINY = 1e-300
"""Least width of a penumbra, so that no width is zero."""


def visibility(
    solid: Sphere | Box, points: ArrayLike, to_light: ArrayLike, light_radius_rad: float
) -> Floats:
    """Share of a distant round light that ``solid`` leaves visible from each point: a soft shadow.

    Parameters
    ----------
    points : (..., 3) metres; not on ``solid`` itself, whose own shading is by its normals
    to_light : (3,) unit vector
    light_radius_rad : half of the light's angular diameter, in (0, pi/2)

    The penumbra is as wide as the light's disc seen from the edge that casts it. For a sphere the
    share is a smooth ramp across that width; for a box it is the ramp of the chord that the shadow
    ray cuts out of it, which keeps the penumbra inside the exact shadow of a point light. Raises
    `ValueError` for an invalid light, and for points beyond `LARGEST_M`.
    """
    return smooth_ramp(penumbra(solid, points, to_light, light_radius_rad))


def penumbra(
    solid: Sphere | Box, points: ArrayLike, to_light: ArrayLike, light_radius_rad: float
) -> Floats:
    """Place (...) of each point in the penumbra, of which `visibility` is the `smooth_ramp`: from 0
    at the end of the full shadow to 1 at the end of the full light, and on beyond both.

    It is ∞ before the solid, as seen from the light. Parameters and errors as for `visibility`.
    """
    at, light = np.asarray(points, float), np.asarray(to_light, float)
    _check_light(light.tolist(), light_radius_rad)
    _check_points(at)
    spread = math.tan(light_radius_rad)
    match solid:
        case Sphere():
            to_centre = np.asarray(solid.centre) - at
            along = to_centre @ light
            square = np.einsum("...i,...i", to_centre, to_centre) - along**2
            clearance = np.sqrt(np.maximum(square, 0.0)) - solid.radius
            width = np.maximum(np.maximum(along, NEARLY_ZERO) * spread, TINY)
            with np.errstate(over="ignore"):
                place = 0.5 + 0.5 * clearance / width
            return np.where(along > 0, place, np.inf)
        case Box():
            start = (at - solid.centre) @ solid.world_to_box.T
            direction = solid.world_to_box @ light
            entries, exits = slab_crossings(start, direction, np.asarray(solid.size) / 2)
            entry = np.maximum(largest_component(entries), 0.0)
            chord = -largest_component(-exits) - entry
            width = np.maximum(2.0 * np.maximum(entry, 0.02) * spread, TINY)
            with np.errstate(over="ignore"):
                return 1.0 - chord / width


def shadow_bounds(
    solid: Sphere | Box, to_light: Vector, light_radius_rad: float
) -> tuple[Floats, Floats]:
    """Corners (3,) of a cuboid that contains the solid and its shadow above the floor z = 0.

    Raises `ValueError` unless the light is above the horizon.
    """
    _check_light(to_light, light_radius_rad)
    require("to_light", to_light, to_light[2] > 0, "z above 0")
    centre, radius = np.asarray(solid.centre), bounding_radius(solid)
    length = (centre[2] + radius) / to_light[2]
    end = centre - length * np.asarray(to_light)
    wide = radius + length * math.tan(light_radius_rad)
    return np.minimum(centre - radius, end - wide), np.maximum(centre + radius, end + wide)


def _check_light(to_light: Sequence[float], light_radius_rad: float) -> None:
    acute = 0 < light_radius_rad < math.pi / 2
    require("light_radius_rad", light_radius_rad, acute, "above 0, below pi/2")
    unit = math.isclose(math.hypot(*to_light), 1.0, rel_tol=1e-6)
    require("to_light", to_light, unit, "a unit vector")


def _check_points(points: Floats) -> None:
    farthest = np.abs(points).max(initial=0.0)
    require("points as far as", farthest, farthest <= LARGEST_M, f"to {LARGEST_M:g}")


def bounding_radius(solid: Sphere | Box) -> float:
    """Radius of the smallest ball around the solid's centre that contains it, metres."""
    return solid.radius if isinstance(solid, Sphere) else 0.5 * math.hypot(*solid.size)


def smooth_ramp(place: ArrayLike) -> Floats:
    """0 below 0, 1 above 1, a cubic with horizontal ends between."""
    clamped = np.clip(as_floats(place), 0.0, 1.0)
    return clamped * clamped * (3.0 - 2.0 * clamped)


def sphere_occlusion(
    centre: ArrayLike, radius: ArrayLike, points: ArrayLike, normals: ArrayLike
) -> Floats:
    """Share (...) of the cosine-weighted hemisphere over each point that a sphere hides, of one
    sphere or several (..., 3).

    Exact if the whole sphere is above the point's horizon: ``cos θ (radius / d)²``, the form factor
    of a sphere (Howell's catalogue, B-43). Below the horizon 0. Never more than 1. Raises
    `ValueError` unless the radius is above 0, and it and all places `LARGEST_M` at most.
    """
    radius = np.asarray(radius, float)
    legal = bool(((radius > 0) & (radius <= LARGEST_M)).all())
    require("radius", radius, legal, f"above 0, to {LARGEST_M:g}")
    to_centre = np.asarray(centre, float) - np.asarray(points, float)
    _check_points(to_centre)
    square = np.maximum(np.einsum("...i,...i", to_centre, to_centre), NEARLY_ZERO)
    cosine = np.einsum("...i,...i", to_centre, np.asarray(normals, float)) / np.sqrt(square)
    return np.clip(np.maximum(cosine, 0.0) * (radius**2 / square), 0.0, 1.0)
