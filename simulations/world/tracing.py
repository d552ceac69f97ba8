"""The first surface of the room along the ray of each pixel, and its nearness.

In nearness, the inverse of depth, a plane is linear in the pixel: the ray ``e + Z d`` of pixel
(x, y) meets ``n · p = h`` where ``1/Z = n · d / (h − n · e)``, and d is linear in x and y. So a
face costs an outer sum and a comparison. Of the planes of a box that have the eye before them, a
ray enters the box by the last, and leaves it by the first of the others: the slab test of Kay and
Kajiya (SIGGRAPH 1986). The room is a box with the eye inside.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats, Mask, Planes
from simulations.models.light.raycasting import Box, Sphere
from simulations.models.light.soft_shadows import bounding_radius
from simulations.models.projection.pinhole import invert_pose
from simulations.world.furniture import HIGH, LOW, ROOM, WALLS
from simulations.world.still_life import SceneObject

type Surfaces = NDArray[np.uint8]
type Numbers = NDArray[np.intp]
type Window = tuple[slice, slice | Numbers]
"""Rows and columns."""

LEAST_M = 1e-9
"""Least distance of the eye from a plane, so that no nearness is infinite."""
FARTHEST_M = 1e6
"""Depth of rays that meet nothing: outside the room, all directions except into it."""
SKEWED = 1e-12
"""Product of the pixel's axes, relative to their squares, from which they are not at right angles.
"""
EVERYWHERE_PX = 1e6
"""More than any picture's width."""


@dataclass(frozen=True, slots=True)
class Faces:
    """Planes n · p = h, whose normals point out of the box."""

    normals: Floats
    """(n, 3) unit."""
    offsets: Floats
    """(n,) metres."""


def _faces_of(box: Box) -> Faces:
    """Two for each axis of the box, the lower one first."""
    normals = np.stack([-box.world_to_box, box.world_to_box], axis=1).reshape(6, 3)
    half = np.repeat(np.asarray(box.size) / 2, 2)
    return Faces(normals, normals @ np.asarray(box.centre) + half)


def _numbered() -> Iterator[tuple[SceneObject, int]]:
    """The objects with the numbers of their first surfaces: six for a box, then one for a ball."""
    count = len(WALLS)
    for kind, surfaces in ((Box, 6), (Sphere, 1)):
        for item in ROOM:
            if isinstance(item.solid, kind):
                yield item, count
                count += surfaces


NUMBERED = tuple(_numbered())
"""All objects, boxes first, with the number of their first surface; the walls are before them."""
FIRST_BALL = next(first for item, first in NUMBERED if isinstance(item.solid, Sphere))
OF_ROOM = Box(tuple(((np.array(LOW) + HIGH) / 2).tolist()), tuple(np.subtract(HIGH, LOW).tolist()))
BOXES = (OF_ROOM, *(item.solid for item, _ in NUMBERED if isinstance(item.solid, Box)))
FACES = Faces(
    np.concatenate([_faces_of(box).normals for box in BOXES]),
    np.concatenate([_faces_of(box).offsets for box in BOXES]),
)
"""Of all boxes, by the number of the surface; the walls are the room's."""
PARTS = np.array(
    [
        *range(len(WALLS)),
        *(
            len(WALLS) + [other is item for other in ROOM].index(True)
            for item, _ in NUMBERED
            for _ in range(6 if isinstance(item.solid, Box) else 1)
        ),
    ],
    np.uint8,
)
"""(surfaces,) index into `NAMES` of what each surface is a part of."""
CENTRES = np.array([item.solid.centre for item, _ in NUMBERED])
CORNERS = np.array(
    [
        np.asarray(box.centre) + np.array(signs) * box.size / 2 @ box.world_to_box
        for box in BOXES[1:]
        for signs in product((-1, 1), repeat=3)
    ]
).reshape(-1, 8, 3)
"""(boxes, 8, 3) of the objects, metres."""
RADII = np.array([bounding_radius(item.solid) for item, _ in NUMBERED])


@dataclass(frozen=True, slots=True)
class Camera:
    """A pinhole camera, and how it sees the planes and the objects of the room."""

    eye: Floats
    """(3,) metres."""
    turn: Floats
    """(3, 3) from a place (x, y, 1) in pixels to the direction d of its ray, one metre deep."""
    clear: list[float]
    """For each face the distance of the eye from its plane: metres, positive inside the box."""
    faces: Planes
    """(faces, 3) the coefficients of x, y and 1 in the nearness of the plane."""
    windows: list[list[float]]
    """For each object the columns and the rows, from and to, between which it is seen."""

    def directions(self, x: Floats, y: Floats) -> Planes:
        """(3, ...) of the rays through places, one metre deep."""
        return np.stack([linear(row, x, y) for row in self.turn.astype(np.float32)])


def camera_at(K: ArrayLike, world_to_camera: ArrayLike) -> Camera:
    """A camera at a pose (4, 4)."""
    pose = np.asarray(world_to_camera, float)
    eye, turn = invert_pose(pose)[:3, 3], pose[:3, :3].T @ np.linalg.inv(np.asarray(K, float))
    clear = FACES.offsets - FACES.normals @ eye
    clear = np.where(np.abs(clear) < LEAST_M, LEAST_M, clear)
    faces = ((FACES.normals @ turn) / clear[:, None]).astype(np.float32)
    return Camera(eye, turn, clear.tolist(), faces, _windows(eye, turn))


@dataclass(frozen=True, slots=True)
class FirstHits:
    """The first surfaces that the rays through some places meet."""

    nearness: Planes
    """(H, W) 1/Z, per metre."""
    surface: Surfaces
    """(H, W) number of the surface."""


def linear(coefficients: Floats, x: Floats, y: Floats) -> Floats:
    """a x + b y + c."""
    a, b, c = coefficients
    return x * a + (y * b + c)


def pixels(width: int, height: int) -> tuple[Planes, Planes]:
    """Columns (1, W) and rows (H, 1) of the middles of all pixels."""
    x, y = np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32)
    return x[None], y[:, None]


def trace(camera: Camera, x: Floats, y: Floats) -> FirstHits:
    """The first surface that each ray meets, of a grid of columns (1, W) and rows (H, 1) or of a
    list of places, both (1, n), that goes on from row to row.

    Walls are seen from inside the room alone.
    """
    shape = np.broadcast_shapes(x.shape, y.shape)
    nearness, surface = np.full(shape, np.float32(1 / FARTHEST_M)), np.zeros(shape, np.uint8)
    for wall in range(len(WALLS)):
        if camera.clear[wall] > 0:
            level = linear(camera.faces[wall], x, y)
            _number(surface, level > nearness, wall)
            np.maximum(nearness, level, out=nearness)
    parts = _of_list if x.shape == y.shape else _of_grid
    for (item, first), (window, columns, rows) in zip(
        NUMBERED, parts(camera.windows, x, y), strict=True
    ):
        before = nearness[window]
        if before.size:
            near, face = (
                (_nearness_of_ball(camera, item.solid, columns, rows), np.uint8(0))
                if isinstance(item.solid, Sphere)
                else _nearness_of_box(camera, first, columns, rows)
            )
            surface[window] = np.where(near > before, face + np.uint8(first), surface[window])
            nearness[window] = np.maximum(near, before)
    return FirstHits(nearness, surface)


def _of_grid(
    windows: list[list[float]], x: Floats, y: Floats
) -> Iterator[tuple[Window, Floats, Floats]]:
    """The parts of a grid that are in the windows."""
    for left, right, top, bottom in windows:
        columns = slice(max(math.ceil(left), 0), max(math.floor(right) + 1, 0))
        rows = slice(max(math.ceil(top), 0), max(math.floor(bottom) + 1, 0))
        yield (rows, columns), x[:, columns], y[rows]


def _of_list(
    windows: list[list[float]], x: Floats, y: Floats
) -> Iterator[tuple[Window, Floats, Floats]]:
    """The places of a list that are in the windows."""
    *_, top, bottom = np.array(windows).T
    starts, ends = np.searchsorted(y[0], (np.floor(top) - 0.5, np.ceil(bottom) + 0.5)).tolist()
    for (left, right, *_), start, end in zip(windows, starts, ends, strict=True):
        columns = x[0, start:end]
        at = np.flatnonzero((columns >= left) & (columns <= right))
        at += start
        yield (slice(None), at), x[0, at][None], y[0, at][None]


def _number(numbers: Surfaces, where: Mask, number: int) -> None:
    """Put a number in place of smaller ones: in whole bytes, several times faster than `copyto`."""
    np.maximum(numbers, where.view(np.uint8) * np.uint8(number), out=numbers)


def _nearness_of_box(camera: Camera, first: int, x: Floats, y: Floats) -> tuple[Floats, Surfaces]:
    """Nearness (h, w), 0 where a ray misses, and the number of the face among its six."""
    a, b, c = camera.faces[first : first + 6].T[..., None, None]
    levels = a * x + (b * y + c)
    inside = [clear > 0 for clear in camera.clear[first : first + 6]]
    if all(inside):  # the face by which the ray leaves
        return levels.max(axis=0), levels.argmax(axis=0).astype(np.uint8)
    entering: list[tuple[int, Floats]] = []
    leaving: list[tuple[int, Floats]] = []
    for face, (level, leaves) in enumerate(zip(levels, inside, strict=True)):
        (leaving if leaves else entering).append((face, level))
    face, near = entering[0]
    number = np.full(near.shape, face, np.uint8)
    for face, level in entering[1:]:
        _number(number, level < near, face)
        near = np.minimum(near, level)
    last = leaving[0][1]
    for _, level in leaving[1:]:
        last = np.maximum(last, level)
    return near * (near > last), number


def _nearness_of_ball(camera: Camera, ball: Sphere, x: Floats, y: Floats) -> Floats:
    """Nearness (h, w), 0 where a ray misses: a root of |e + Z d − c|² = r², in float64, as it is
    the difference of large squares for a distant eye."""
    towards = np.asarray(ball.centre) - camera.eye
    outside = float(towards @ towards) - ball.radius**2
    x, y = x.astype(float), y.astype(float)
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = (camera.turn.T @ camera.turn).tolist()
    along = linear(towards @ camera.turn, x, y)
    square = x * (xx * x + 2 * xz) + (y * (yy * y + 2 * yz) + zz)
    if abs(xy) > SKEWED * xx:
        square += 2 * xy * x * y
    under_root = along * along
    under_root -= outside * square
    root = np.sqrt(np.maximum(under_root, 0.0))
    near = (along + root) / outside if outside > 0 else square / (along + root)
    return (near * (under_root > 0)).astype(np.float32)


def _windows(eye: Floats, turn: Floats) -> list[list[float]]:
    """For each object the columns and the rows between which it is seen; none of them if it is
    behind the camera.

    A box is seen between its corners. Column x is the plane through the eye with the normal
    k₁ − x k₃, of rows of K R. It touches a ball about c where ((k₁ − x k₃) · c)² = r² |k₁ − x k₃|².
    What reaches behind the camera may be seen anywhere.
    """
    to_pixel = np.linalg.inv(turn)
    places, products = (CENTRES - eye) @ to_pixel.T, to_pixel @ to_pixel.T
    z, ends = places[:, 2], []
    square = np.maximum(z * z - RADII**2 * products[2, 2], LEAST_M)
    for axis in (0, 1):
        middle = (places[:, axis] * z - RADII**2 * products[axis, 2]) / square
        last = (places[:, axis] ** 2 - RADII**2 * products[axis, axis]) / square
        half = np.sqrt(np.maximum(middle * middle - last, 0.0))
        ends += [middle - half, middle + half]
    bounds = np.stack(ends, -1)
    corners = (CORNERS - eye) @ to_pixel.T
    pixels = corners[..., :2] / np.maximum(corners[..., 2:], LEAST_M)
    boxes = slice(len(CORNERS))
    bounds[boxes, ::2], bounds[boxes, 1::2] = pixels.min(axis=1), pixels.max(axis=1)
    nearest, farthest = z - RADII, z + RADII
    nearest[boxes], farthest[boxes] = corners[..., 2].min(axis=1), corners[..., 2].max(axis=1)
    bounds[nearest <= 0] = (-EVERYWHERE_PX, EVERYWHERE_PX) * 2
    bounds[farthest <= 0] = EVERYWHERE_PX
    return np.clip(bounds, -EVERYWHERE_PX, EVERYWHERE_PX).tolist()
