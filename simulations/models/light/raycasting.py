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
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_array, as_vectors, slopes
from simulations.models.light.edge_coverage import ramp_coverage, straight_edge_coverage
from simulations.models.require import require

type Vector = tuple[float, float, float]

NEARLY_ZERO = 1e-12
"""Lower bound of direction components, which the slab test divides by."""


HALF_DIAGONAL = math.sqrt(0.5)
"""Pixels from the centre of a pixel to its corner: edges farther away do not cross it."""

LARGEST_M = 1e100
"""Largest coordinate and length, so that the squares of distances are finite."""


def _check_place(name: str, numbers: Sequence[float]) -> None:
    legal = len(numbers) == 3 and all(abs(number) <= LARGEST_M for number in numbers)
    require(name, numbers, legal, f"three, finite, at most {LARGEST_M:g} in size")


@dataclass(frozen=True, slots=True)
class Sphere:
    """A ball."""

    centre: Vector
    """Metres, world frame."""
    radius: float
    """Metres, positive."""

    def __post_init__(self) -> None:
        require("radius", self.radius, 0 < self.radius <= LARGEST_M, f"above 0, to {LARGEST_M:g}")
        _check_place("centre", self.centre)


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
        _check_place("size", self.size)
        require("size", self.size, min(self.size) > 0, "three positive lengths")
        _check_place("centre", self.centre)
        require("angle_rad", self.angle_rad, math.isfinite(self.angle_rad), "finite")

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
    closest approach, for shading partly covered edge pixels."""
    points: Floats
    """(..., 3) metres, world frame."""
    normals: Floats
    """(..., 3) unit, pointing out of the solid."""
    margin: Floats
    """(...) positive inside the silhouette, negative outside, continuous across it."""

    @property
    def valid(self) -> Mask:
        """(...) true where the ray meets the solid."""
        return np.asarray(self.margin > 0)


def intersect(solid: Sphere | Box, origin: ArrayLike, directions: ArrayLike) -> Hit:
    """The first intersection of each ray with ``solid``.

    Parameters
    ----------
    solid : Sphere or Box
    origin : (3,) metres
    directions : (..., 3) unit vectors

    A solid wholly behind the origin is missed; from inside, the ray meets the far side. Raises
    `ValueError` for an origin that is not finite or beyond `LARGEST_M`.
    """
    start, towards = np.asarray(origin, float), as_vectors("directions", directions, 3)
    _check_place("origin", start.tolist())
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
    entries, exits = slab_crossings(start, towards, half)
    entry, leave = largest_component(entries), -largest_component(-exits)
    outside = bool((np.abs(start) > half).any())
    distance = np.maximum(entry if outside else leave, 0.0)
    # Which face: the slab entered last, or, from inside, the one left first.
    axis = entries.argmax(-1) if outside else exits.argmin(-1)
    facing = -np.sign(towards) if outside else np.sign(towards)
    normals = facing * (np.arange(3) == axis[..., None])
    points = np.clip(start + towards * distance[..., None], -half, half)
    margin = _silhouette_margin(start, towards, half) if outside else np.ones(distance.shape)
    return Hit(distance, points @ box.world_to_box + box.centre, normals @ box.world_to_box, margin)


def face_margins(box: Box, origin: ArrayLike, directions: ArrayLike) -> Floats:
    """For each axis of the box (3, ...), how much later a ray enters that slab than the others,
    metres: positive on the axis's visible face, and continuous across the edges between faces.

    ``origin`` (3,) is outside the box, ``directions`` (..., 3) are unit vectors.
    """
    start = box.world_to_box @ (np.asarray(origin, float) - box.centre)
    towards = np.asarray(directions, float) @ box.world_to_box.T
    entries, _ = slab_crossings(start, towards, np.asarray(box.size) / 2)
    x, y, z = (entries[..., axis] for axis in range(3))
    return np.stack([x - np.maximum(y, z), y - np.maximum(x, z), z - np.maximum(x, y)])


def _silhouette_margin(eye: Floats, directions: Floats, half: Floats) -> Floats:
    """Sine of the angle to the nearest plane through the eye and a silhouette edge of the box.

    An edge belongs to the silhouette if one of its faces is turned to the eye and the other away.
    All in the box's frame.
    """
    margin = np.ones(directions.shape[:-1])
    for axis, sign_a, sign_b in product(range(3), (-1, 1), (-1, 1)):
        a, b = (axis + 1) % 3, (axis + 2) % 3
        if (sign_a * eye[a] > half[a]) == (sign_b * eye[b] > half[b]):
            continue
        normal = np.zeros(3)  # (corner − eye) × the edge's direction
        normal[a], normal[b] = sign_b * half[b] - eye[b], eye[a] - sign_a * half[a]
        inwards = math.copysign(1.0, normal @ -eye) / math.hypot(normal[a], normal[b])
        margin = np.minimum(margin, directions @ (normal * inwards))
    return margin


def slab_crossings(start: Floats, directions: Floats, half: Floats) -> tuple[Floats, Floats]:
    """Distances at which rays enter and leave each of the three slabs, (..., 3) each."""
    small = np.abs(directions) < NEARLY_ZERO
    inverse = 1.0 / np.where(small, NEARLY_ZERO, directions)
    middle, reach = -start * inverse, np.abs(half * inverse)
    return middle - reach, middle + reach


def largest_component(vectors: Floats) -> Floats:
    """Largest component (...); several times faster than a reduction over so short an axis."""
    return np.maximum(np.maximum(vectors[..., 0], vectors[..., 1]), vectors[..., 2])


def intersect_plane(
    point: ArrayLike, normal: ArrayLike, origin: ArrayLike, directions: ArrayLike
) -> tuple[Floats, Mask]:
    """Distance along each ray to a plane.

    Returns
    -------
    distance : (...) metres, NaN where not valid
    valid : (...) false if the ray runs along the plane or away from it, or the distance is not
        finite
    """
    at, eye, upright = (
        as_array(name, vector, 3)
        for name, vector in (("point", point), ("origin", origin), ("normal", normal))
    )
    with np.errstate(over="ignore", invalid="ignore"):
        facing = as_vectors("directions", directions, 3) @ upright
        height = (at - eye) @ upright
        crossing = np.abs(facing) > NEARLY_ZERO
        distance = height / np.where(crossing, facing, 1.0)
    valid = crossing & (distance > 0) & np.isfinite(distance)
    return np.where(valid, distance, np.nan), valid


def edge_coverage(margin: ArrayLike) -> Floats:
    """Share of each pixel that a silhouette covers, from its signed margin on the pixel grid.

    ``margin`` (H, W) divided by the length of its own gradient is, to first order, the distance to
    the silhouette in pixels, and the gradient points along its normal: together they determine the
    area behind a straight edge. This is right for edges that are straight over a pixel; solids less
    than about two pixels wide are too faint. Needs at least two pixels each way.
    """
    signed = np.asarray(margin, float)
    if signed.ndim != 2 or min(signed.shape) < 2:
        raise ValueError(f"margin of shape {signed.shape}; legal: (H, W), both at least 2")
    with np.errstate(over="ignore", invalid="ignore"):
        down, across = slopes(signed)
        slope = np.maximum(np.hypot(down, across), NEARLY_ZERO)
        distance = signed / slope
    coverage = ramp_coverage(distance)  # 0 or 1, except for pixels that the edge crosses
    edge = np.flatnonzero(np.abs(distance) < HALF_DIAGONAL)
    edge = edge[np.isfinite(slope.flat[edge])]
    normal = np.stack((across.flat[edge], down.flat[edge]), axis=-1) / slope.flat[edge][:, None]
    coverage.flat[edge] = straight_edge_coverage(distance.flat[edge], normal)
    return coverage
