"""Rays against spheres, boxes and planes, solved exactly; antialiased edges without supersampling.

World axes are x right, y away from the camera, z up, in metres. A ray is ``origin + t direction``
with a unit direction, so that ``t`` is a distance in metres.

Source: Szeliski, 2nd ed., section 2.1 (geometric primitives); slab test after Kay and Kajiya,
"Ray tracing complex scenes", SIGGRAPH 1986.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.floats import as_vectors

type Floats = NDArray[np.floating]
type Vector = tuple[float, float, float]

NEARLY_ZERO = 1e-12
"""Direction components smaller than this are taken as this: the slab test divides by them."""


LARGEST_M = 1e100
"""Of any coordinate and length: so that the squares of distances are numbers."""


def _check_place(name: str, numbers: Sequence[float]) -> None:
    if len(numbers) != 3 or not all(abs(number) <= LARGEST_M for number in numbers):
        raise ValueError(f"{name} {numbers!r}; legal: three, finite, at most {LARGEST_M:g} in size")


@dataclass(frozen=True, slots=True)
class Sphere:
    """A ball."""

    centre: Vector
    """Metres, world frame."""
    radius: float
    """Metres, positive."""

    def __post_init__(self) -> None:
        if not 0 < self.radius <= LARGEST_M:
            raise ValueError(f"Sphere: radius {self.radius!r}; legal: above 0, to {LARGEST_M:g}")
        _check_place("Sphere: centre", self.centre)


@dataclass(frozen=True, slots=True)
class Box:
    """A cuboid, turned about the vertical axis."""

    centre: Vector
    """Metres, world frame."""
    size: Vector
    """Full edge lengths along the box's own axes, metres."""
    angle_rad: float = 0.0
    """Turn about world z, anticlockwise seen from above."""

    def __post_init__(self) -> None:
        _check_place("Box: size", self.size)
        if not min(self.size) > 0:
            raise ValueError(f"Box: size {self.size!r}; legal: three positive lengths")
        _check_place("Box: centre", self.centre)
        if not math.isfinite(self.angle_rad):
            raise ValueError(f"Box: angle_rad {self.angle_rad!r}; legal: finite")

    @property
    def world_to_box(self) -> Floats:
        """(3, 3) rotation whose rows are the box's axes in the world."""
        cos, sin = math.cos(self.angle_rad), math.sin(self.angle_rad)
        return np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])


@dataclass(frozen=True, slots=True)
class Hit:
    """Where rays meet a solid. Every entry is finite, also where they miss."""

    distance: Floats
    """(...) metres along the ray to the first point in front of the origin; on a miss, to the
    closest approach, so that a partly covered edge pixel has something to shade."""
    points: Floats
    """(..., 3) metres, world frame."""
    normals: Floats
    """(..., 3) unit, pointing out of the solid."""
    margin: Floats
    """(...) positive inside the silhouette, negative outside, continuous across it."""

    @property
    def valid(self) -> NDArray[np.bool_]:
        """(...) true where the ray meets the solid."""
        return np.asarray(self.margin > 0)


def intersect(solid: Sphere | Box, origin: ArrayLike, directions: ArrayLike) -> Hit:
    """The first meeting of each ray with ``solid``.

    Parameters
    ----------
    solid : Sphere or Box
    origin : (3,) metres
    directions : (..., 3) unit vectors

    A solid wholly behind the origin is missed; from inside, the ray meets the far side.
    Raises `ValueError` for an origin that is not finite or beyond `LARGEST_M`.
    """
    start, towards = np.asarray(origin, float), as_vectors("directions", directions, 3)
    _check_place("intersect: origin", start.tolist())
    match solid:
        case Sphere():
            return _intersect_sphere(solid, start, towards)
        case Box():
            return _intersect_box(solid, start, towards)


def _intersect_sphere(sphere: Sphere, origin: Floats, directions: Floats) -> Hit:
    to_centre = np.asarray(sphere.centre) - origin
    outside = to_centre @ to_centre > sphere.radius**2
    along = directions @ to_centre
    passing = directions * along[..., None] - to_centre  # from the centre to the closest approach
    margin = sphere.radius**2 - np.einsum("...i,...i", passing, passing)
    if outside:  # behind the origin, the closest approach is the origin itself
        margin = np.where(along > 0, margin, sphere.radius**2 - to_centre @ to_centre)
    half_chord = np.sqrt(np.maximum(margin, 0.0))
    distance = along - half_chord if outside else along + half_chord
    points = origin + directions * distance[..., None]
    outwards = points - sphere.centre
    length = np.sqrt(np.einsum("...i,...i", outwards, outwards))[..., None]
    return Hit(distance, points, outwards / np.maximum(length, NEARLY_ZERO), margin)


def _intersect_box(box: Box, origin: Floats, directions: Floats) -> Hit:
    half = np.asarray(box.size) / 2
    start = box.world_to_box @ (origin - box.centre)
    towards = directions @ box.world_to_box.T
    entries, exits = _slabs(start, towards, half)
    entry, leave = _largest(entries), -_largest(-exits)
    outside = bool((np.abs(start) > half).any())
    distance = np.maximum(entry if outside else leave, 0.0)
    # Which face: the slab entered last, or, from inside, the one left first.
    axis = entries.argmax(-1) if outside else exits.argmin(-1)
    facing = -np.sign(towards) if outside else np.sign(towards)
    normals = facing * (np.arange(3) == axis[..., None])
    points = np.clip(start + towards * distance[..., None], -half, half)
    margin = _silhouette_margin(start, towards, half) if outside else np.ones(distance.shape)
    return Hit(distance, points @ box.world_to_box + box.centre, normals @ box.world_to_box, margin)


def _silhouette_margin(eye: Floats, directions: Floats, half: Floats) -> Floats:
    """Sine of the angle to the nearest plane through the eye and a silhouette edge of the box.

    An edge belongs to the silhouette where one of its faces is turned to the eye and the other
    away. Everything in the box's frame.
    """
    margin = np.ones(directions.shape[:-1])
    for axis, sign_a, sign_b in product(range(3), (-1, 1), (-1, 1)):
        a, b = (axis + 1) % 3, (axis + 2) % 3
        if (sign_a * eye[a] > half[a]) == (sign_b * eye[b] > half[b]):
            continue
        corner, along = np.zeros(3), np.zeros(3)
        corner[a], corner[b], along[axis] = sign_a * half[a], sign_b * half[b], 1.0
        normal = np.cross(corner - eye, along)
        inwards = math.copysign(1.0, normal @ -eye) / np.linalg.norm(normal)
        margin = np.minimum(margin, directions @ (normal * inwards))
    return margin


def _slabs(start: Floats, directions: Floats, half: Floats) -> tuple[Floats, Floats]:
    """Distances at which rays enter and leave each of the three slabs, (..., 3) each."""
    small = np.abs(directions) < NEARLY_ZERO
    inverse = 1.0 / np.where(small, NEARLY_ZERO, directions)
    middle, reach = -start * inverse, np.abs(half * inverse)
    return middle - reach, middle + reach


def _largest(vectors: Floats) -> Floats:
    """Largest component (...); several times faster than a reduction over so short an axis."""
    result: Floats = np.maximum(np.maximum(vectors[..., 0], vectors[..., 1]), vectors[..., 2])
    return result


def intersect_plane(
    point: ArrayLike, normal: ArrayLike, origin: ArrayLike, directions: ArrayLike
) -> tuple[Floats, NDArray[np.bool_]]:
    """Distance along each ray to a plane.

    Returns
    -------
    distance : (...) metres, 0 where not valid
    valid : (...) false where the ray runs along the plane or away from it, and where the
        distance is no finite number.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        facing = np.asarray(directions, float) @ np.asarray(normal, float)
        height = (np.asarray(point, float) - np.asarray(origin, float)) @ np.asarray(normal, float)
        crossing = np.abs(facing) > NEARLY_ZERO
        distance = height / np.where(crossing, facing, 1.0)
    valid = crossing & (distance > 0) & np.isfinite(distance)
    return np.where(valid, distance, 0.0), valid


def edge_coverage(margin: ArrayLike) -> Floats:
    """Share of each pixel that a silhouette covers, from its signed margin on the pixel grid.

    ``margin`` (H, W) divided by the length of its own gradient is, to first order, the distance
    to the silhouette in pixels; a straight edge at that distance covers ``distance + 1/2`` of the
    pixel. Right for edges that are straight over a pixel; solids under about two pixels wide
    come out too faint. Needs at least two pixels each way.
    """
    signed = np.asarray(margin, float)
    if signed.ndim != 2 or min(signed.shape) < 2:
        raise ValueError(f"edge_coverage: margin {signed.shape}; legal: (H, W), both at least 2")
    with np.errstate(over="ignore", invalid="ignore"):
        down, across = np.gradient(signed)
        slope = np.maximum(np.hypot(down, across), NEARLY_ZERO)
        coverage: Floats = np.clip(0.5 + signed / slope, 0.0, 1.0)
    return coverage


def visibility(
    solid: Sphere | Box, points: ArrayLike, to_light: ArrayLike, light_radius_rad: float
) -> Floats:
    """Share of a distant round light that ``solid`` leaves visible from each point: a soft shadow.

    Parameters
    ----------
    points : (..., 3) metres; not on ``solid`` itself, which shades itself by its normals
    to_light : (3,) unit vector
    light_radius_rad : half of the light's angular diameter, in (0, pi/2)

    The penumbra is as wide as the light's disc seen from the edge that casts it. For a sphere the
    share is a smooth ramp across that width; for a box it is the ramp of the chord that the
    shadow ray cuts out of it, which keeps the penumbra inside the exact shadow of a point light.
    """
    if not 0 < light_radius_rad < math.pi / 2:
        raise ValueError(f"visibility: light_radius_rad {light_radius_rad!r}; legal: 0 to pi/2")
    at, light = np.asarray(points, float), np.asarray(to_light, float)
    spread = math.tan(light_radius_rad)
    match solid:
        case Sphere():
            to_centre = np.asarray(solid.centre) - at
            along = to_centre @ light
            square = np.einsum("...i,...i", to_centre, to_centre) - along**2
            clearance = np.sqrt(np.maximum(square, 0.0)) - solid.radius
            width = np.maximum(along, NEARLY_ZERO) * spread
            lit = _smooth(0.5 + 0.5 * clearance / width)
            return np.where(along > 0, lit, 1.0)
        case Box():
            start = (at - solid.centre) @ solid.world_to_box.T
            direction = solid.world_to_box @ light
            entries, exits = _slabs(start, direction, np.asarray(solid.size) / 2)
            entry = np.maximum(_largest(entries), 0.0)
            chord = -_largest(-exits) - entry
            width = 2.0 * np.maximum(entry, 0.02) * spread
            return 1.0 - _smooth(chord / width)


def shadow_bounds(
    solid: Sphere | Box, to_light: Vector, light_radius_rad: float
) -> tuple[Floats, Floats]:
    """Corners (3,) of a cuboid that holds the solid and all of its shadow above the floor z = 0.

    Raises `ValueError` where the light is not above the horizon: the shadow has no end.
    """
    if not to_light[2] > 0:
        raise ValueError(f"shadow_bounds: to_light {to_light!r}; legal: z above 0")
    centre, radius = np.asarray(solid.centre), bounding_radius(solid)
    length = (centre[2] + radius) / to_light[2]
    end = centre - length * np.asarray(to_light)
    wide = radius + length * math.tan(light_radius_rad)
    return np.minimum(centre - radius, end - wide), np.maximum(centre + radius, end + wide)


def bounding_radius(solid: Sphere | Box) -> float:
    """Of the ball around the solid's centre that just holds it, metres."""
    return solid.radius if isinstance(solid, Sphere) else 0.5 * math.hypot(*solid.size)


def _smooth(ramp: Floats) -> Floats:
    """0 below 0, 1 above 1, a cubic with level ends between."""
    held = np.clip(ramp, 0.0, 1.0)
    return held * held * (3.0 - 2.0 * held)


def sphere_occlusion(
    centre: ArrayLike, radius: float, points: ArrayLike, normals: ArrayLike
) -> Floats:
    """Share of the cosine-weighted hemisphere over each point that a sphere hides.

    Exact where the whole sphere stands above the point's horizon: ``cos θ (radius / d)²``, the
    form factor of a sphere (Howell's catalogue, B-43). Below the horizon 0. Never more than 1.
    Raises `ValueError` unless the radius is above 0, and `LARGEST_M` at most.
    """
    if not 0 < radius <= LARGEST_M:
        raise ValueError(f"sphere_occlusion: radius {radius!r}; legal: above 0, to {LARGEST_M:g}")
    to_centre = np.asarray(centre, float) - np.asarray(points, float)
    square = np.maximum(np.einsum("...i,...i", to_centre, to_centre), NEARLY_ZERO)
    cosine = np.einsum("...i,...i", to_centre, np.asarray(normals, float)) / np.sqrt(square)
    hidden: Floats = np.clip(np.maximum(cosine, 0.0) * (radius**2 / square), 0.0, 1.0)
    return hidden
