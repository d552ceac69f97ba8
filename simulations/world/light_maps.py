"""The light on everything that does not move, computed once: maps of the shares of lamp and
surroundings.

A map has nodes on a grid over each surface of the room, and at each node two shares: of the lamp
and of the surroundings that the other objects leave visible. Between the nodes they are bilinear.
Colours and cosines are no part of it and stay exact. The finer the grid, the smaller the error,
which is largest in a shadow near the object that casts it, where it is sharpest.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from simulations.models.arrays import Floats, Planes, gathered
from simulations.models.light.raycasting import Box, Sphere, Vector
from simulations.models.light.soft_shadows import bounding_radius, smooth_ramp
from simulations.world.furniture import HIGH, LOW, ROOM, WALLS
from simulations.world.light import lamp_direction, lamp_penumbra, shadow_corners
from simulations.world.still_life import SceneObject
from simulations.world.surfaces import sky_visibility, windows_between
from simulations.world.tracing import FACES, NUMBERED, Numbers
from simulations.world.walls import ALONG

FINE_M = 0.02
"""Spacing of the nodes on walls and floor."""
IN_SHADOW, IN_LIGHT = 0.5, 4.0
"""Spacings on the faces of objects, relative to `FINE_M`: where the shadow of another object may
fall, which is sharp so near to it, and where none does."""
BEYOND = 4.0
"""How far beyond both ends of a penumbra the map goes on, in widths of it."""
REACH = 3.0
"""Radii beyond which a ball's shadow in the light of the surroundings is ignored."""
LEAST_NODES = 16
"""Cells of the map of a ball, however small, along each side of the square."""
INSIDE_M = 1e-4
"""How far from a surface another object covers it."""


@dataclass(frozen=True, slots=True)
class Patch:
    """The nodes of one surface."""

    points: Floats
    """(a, b, 3) metres."""
    normals: Floats
    """(a, b, 3) unit."""
    to_place: Floats
    """(2, 4) from a point (x, y, z, 1) of a flat surface to its place in the map, in nodes; of a
    ball, the number of cells."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LightMap:
    """The maps of all surfaces, one after the other."""

    shares: Planes
    """(2, nodes) of the lamp and of the surroundings."""
    first: Planes
    """(surfaces,) number of the first node."""
    across: Planes
    """(surfaces,) nodes along b."""
    last: Planes
    """(2, surfaces) the last place along a and b."""
    to_place: Planes
    """(2, 4, surfaces) see `Patch`."""
    bounds: Floats
    """(walls, 2, 2) from and to, along u and v: the part of each wall that the maps cover."""

    def on_flat(self, surface: Numbers, points: Floats, _normals: Floats) -> Floats:
        """Shares (2, n) at points (3, n) of flat surfaces (n,)."""
        x, y, z = points
        a, b = (
            row[0][surface] * x + row[1][surface] * y + row[2][surface] * z + row[3][surface]
            for row in self.to_place
        )
        return self._between_nodes(surface, a, b)

    def on_ball(self, surface: Numbers, _points: Floats, normals: Floats) -> Floats:
        """Shares (2, n) at points of balls (n,) that have normals (3, n)."""
        a, b = octahedral(normals) * self.to_place[0, 0][surface]
        return self._between_nodes(surface, a, b)

    def _between_nodes(self, surface: Numbers, a: Floats, b: Floats) -> Floats:
        last_a, last_b = gathered(self.last, surface)
        a, b = np.clip(a, 0, last_a), np.clip(b, 0, last_b)
        row, column, across = np.floor(a), np.floor(b), self.across[surface]
        a -= row
        b -= column
        row *= across  # whole numbers, exact in float32 up to 16 million
        row += column
        row += self.first[surface]
        node = row.astype(np.intp)
        low = _between(gathered(self.shares, node), gathered(self.shares, node + 1), b)
        node += across.astype(np.intp)
        high = _between(gathered(self.shares, node), gathered(self.shares, node + 1), b)
        shares = _between(low, high, a)
        shares[0] = smooth_ramp(shares[0])
        return shares


def _between(first: Floats, second: Floats, share: Floats) -> Floats:
    second -= first
    second *= share
    second += first
    return second


def octahedral(normals: Floats) -> Floats:
    """Places (2, n) in the unit square of unit vectors (3, n), by unfolding an octahedron."""
    x, y, z = normals / np.abs(normals).sum(axis=0)
    below = np.maximum(-z, 0)  # what is below the middle folds out over the edges
    half = np.float32(0.5)
    a, b = x + np.copysign(below, x), y + np.copysign(below, y)
    return np.stack([half + half * a, half + half * b])


def from_octahedral(a: Floats, b: Floats) -> Floats:
    """Unit vectors (..., 3) of places (...) in the unit square."""
    x, y = 2 * a - 1, 2 * b - 1
    z = 1 - np.abs(x) - np.abs(y)
    below = np.maximum(-z, 0)
    vectors = np.stack([x - np.copysign(below, x), y - np.copysign(below, y), z], axis=-1)
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def _bounds(lamp: Vector) -> Floats:
    return np.array([shadowed_bounds(wall, lamp) for wall in range(len(WALLS))]).swapaxes(1, 2)


@lru_cache(maxsize=4)
def light_map(light_angle: float, spacing: float = FINE_M) -> LightMap:
    """The maps in the light of a lamp at an angle in degrees, with nodes ``spacing`` metres apart:
    some 190 000 at `FINE_M`."""
    lamp = lamp_direction(light_angle)
    bounds = _bounds(lamp)
    parts = [
        ([_flat(wall, np.eye(3)[[*ALONG[wall]]], low, high, spacing)], ROOM)
        for wall, (low, high) in enumerate(bounds.swapaxes(1, 2))
    ]
    for item, first in NUMBERED:
        patches = _patches_of(item, first, spacing, lamp)
        parts.append((patches, tuple(other for other in ROOM if other is not item)))
    shares = np.concatenate([_shares(patches, others, lamp) for patches, others in parts], axis=1)
    every = [patch for patches, _ in parts for patch in patches]
    sizes = np.array([patch.points.shape[:2] for patch in every], np.intp)
    ends = np.cumsum(sizes.prod(axis=1))
    return LightMap(
        shares=shares,
        first=(ends - sizes.prod(axis=1)).astype(np.float32),
        across=sizes[:, 1].astype(np.float32),
        last=np.ascontiguousarray(np.nextafter(sizes - 1, 0, dtype=np.float32).T),
        to_place=np.ascontiguousarray(
            np.stack([patch.to_place for patch in every], -1), np.float32
        ),
        bounds=bounds,
    )


def _shares(patches: Sequence[Patch], others: Sequence[SceneObject], lamp: Vector) -> Planes:
    """Shares (2, nodes) of all nodes of some patches, which the same objects may hide."""
    if len(patches) == 1:
        points, normals = patches[0].points, patches[0].normals
    else:
        points, normals = (
            np.concatenate([array.reshape(-1, 3) for array in arrays])[None]
            for arrays in zip(*((patch.points, patch.normals) for patch in patches), strict=True)
        )
    points = _moved_to_sides(points, normals, others)
    penumbra = lamp_penumbra(points, lamp, others, BEYOND)
    openness = sky_visibility(points, normals, others, REACH)
    return np.stack([penumbra.ravel(), openness.ravel()]).astype(np.float32)


def _moved_to_sides(points: Floats, normals: Floats, others: Sequence[SceneObject]) -> Floats:
    """Points, with those under a box moved to its sides: they are hidden, but the light between
    them and their neighbours is visible."""
    boxes = [item.solid for item in others if isinstance(item.solid, Box)]
    reach = [bounding_radius(box) * np.ones(3) for box in boxes]
    corners = [
        (box.centre - size, box.centre + size) for box, size in zip(boxes, reach, strict=True)
    ]
    moved = points.copy()
    for box, window in zip(boxes, windows_between(points, corners), strict=True):
        if window is None:
            continue
        half, axes = np.asarray(box.size) / 2, box.world_to_box
        in_box = (points[window] + INSIDE_M * normals[window] - box.centre) @ axes.T
        inside = (np.abs(in_box) < half).all(axis=-1)
        in_box, count = in_box[inside], np.arange(int(inside.sum()))
        side = (half - np.abs(in_box))[:, :2].argmin(axis=-1)
        in_box[count, side] = np.copysign(half[side] + INSIDE_M, in_box[count, side])
        moved[window][inside] = in_box @ axes + box.centre
    return moved


def shadowed_bounds(wall: int, lamp: Vector) -> tuple[Floats, Floats]:
    """Bounds (2,), along u and v, of the part of a wall on which an object may cast a shadow; the
    rest is as light as the edge of that part."""
    along, across, place = list(ALONG[wall]), wall // 2, (LOW, HIGH)[wall % 2][wall // 2]
    reached = []
    for solid in (item.solid for item in ROOM):
        size = solid.radius if isinstance(solid, Sphere) else 0.6 * min(solid.size)
        around = np.asarray(solid.centre)
        for low, high in (
            shadow_corners(solid, lamp),
            (around - REACH * size, around + REACH * size),
        ):
            if low[across] < place < high[across]:
                reached.append((low[along], high[along]))
    least, most = np.array(LOW)[along], np.array(HIGH)[along]
    if not reached:
        return least, least + LEAST_NODES * INSIDE_M
    low, high = np.min([ends[0] for ends in reached], 0), np.max([ends[1] for ends in reached], 0)
    return np.maximum(low, least), np.minimum(high, most)


def _patches_of(item: SceneObject, first: int, spacing: float, lamp: Vector) -> list[Patch]:
    solid = item.solid
    if isinstance(solid, Sphere):
        return [_round(solid, spacing)]
    axes, patches = solid.world_to_box, []
    places, reach = axes @ np.asarray(solid.centre), np.asarray(solid.size) / 2
    for face in range(6):
        along = [(face // 2 + 1) % 3, (face // 2 + 2) % 3]
        bounds = places[along] - reach[along], places[along] + reach[along]
        coarse = _flat(first + face, axes[along], *bounds, IN_LIGHT * spacing)
        shaded = _in_shadow(coarse, lamp, [other for other in ROOM if other is not item])
        patches.append(
            _flat(first + face, axes[along], *bounds, IN_SHADOW * spacing) if shaded else coarse
        )
    return patches


def _in_shadow(patch: Patch, lamp: Vector, others: Sequence[SceneObject]) -> bool:
    """Whether a face is turned to the lamp, and the shadow of another object may fall on it."""
    if patch.normals[0, 0] @ lamp <= 0:
        return False
    first, last = patch.points.min(axis=(0, 1)), patch.points.max(axis=(0, 1))
    corners = (shadow_corners(other.solid, lamp) for other in others)
    return any(bool((low < last).all() and (first < high).all()) for low, high in corners)


def _flat(surface: int, axes: Floats, low: Floats, high: Floats, spacing: float) -> Patch:
    """The nodes between bounds (2,) along two axes (2, 3) of a flat surface."""
    cells = np.maximum(np.ceil((high - low) / spacing - INSIDE_M), 1).astype(int)
    a, b = (low[k] + np.linspace(0.0, high[k] - low[k], cells[k] + 1) for k in (0, 1))
    normal, offset = FACES.normals[surface], FACES.offsets[surface]
    points = offset * normal + a[:, None, None] * axes[0] + b[:, None] * axes[1]
    facing = -normal if surface < len(WALLS) else normal
    per_metre = (cells / (high - low))[:, None]
    to_place = np.append(per_metre * axes, -per_metre * low[:, None], axis=1)
    return Patch(points, np.broadcast_to(facing, points.shape), to_place)


def _round(ball: Sphere, spacing: float) -> Patch:
    """The nodes of a ball, on an unfolded octahedron, twice as long as a quarter of the girth."""
    cells = max(math.ceil(math.pi * ball.radius / spacing), LEAST_NODES)
    ticks = np.linspace(0.0, 1.0, cells + 1)
    normals = from_octahedral(*np.meshgrid(ticks, ticks, indexing="ij"))
    points = np.asarray(ball.centre) + ball.radius * normals
    return Patch(points, normals, np.full((2, 4), float(cells)))
