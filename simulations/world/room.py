"""The room that most figures look at: still life, furniture, door and window, seen from anywhere.

World axes: x right, y from the entrance to the wall with the chart, z up, metres. A scene moves a
camera through it::

    seen = look(intrinsics(focal_px, centre), look_at(eye, target, (0, 0, 1)), width, height)
    light = shade(seen, light_angle=40.0)                          # (3, H, W) linear RGB

One ray goes through the centre of each pixel: 320 × 240 take some 18 ms, 200 × 150 some 11. For
smooth edges look at twice the size, with `finer`, and take means with `halve`.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.engine.accuracy import columns
from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats, Planes
from simulations.models.color.srgb import encode_srgb_table
from simulations.models.light.raycasting import Box, Sphere, Vector, intersect
from simulations.models.light.reflectance import blinn_phong, lambert
from simulations.models.light.soft_shadows import bounding_radius
from simulations.models.projection.pinhole import intrinsics, invert_pose, pixel_rays
from simulations.pictures.patterns import band, pixel_width, stripes
from simulations.world import light, surfaces
from simulations.world.things import THINGS, WALL_DISTANCE, Thing, resting

type Identity = NDArray[np.uint8]

COLUMNS = 800
"""Rays across the finest `photograph`."""
LEVELS = columns(160, 400, COLUMNS)

LOW, HIGH = (-4.5, -5.0, 0.0), (4.5, WALL_DISTANCE, 3.4)
"""Corners of the room, metres."""
PERSON_M = 1.75
"""Height of the wooden figure that stands for a person."""
TABLE_M = 0.72

WOOD, OAK, STEEL = (0.34, 0.19, 0.09), (0.52, 0.34, 0.18), (0.10, 0.11, 0.13)
PLASTER, LIME = np.array([0.62, 0.58, 0.51]), np.array([0.84, 0.82, 0.78])
BEAM, BEAMS_M = np.array([0.30, 0.20, 0.12]), 1.3
DOOR, FRAME = np.array([0.20, 0.30, 0.24]), np.array([0.66, 0.63, 0.57])
DOORWAY = (5.2, 6.1, 2.05)
"""The door in the right wall: from y to y, and its height; metres."""
WINDOW = (2.2, 4.6, 0.9, 2.5)
"""The window in the left wall: y from, to, z from, to; metres."""
SLATE = (2.2, 3.8, 0.9, 2.1)
"""The slate on the near wall: x from, to, z from, to; metres."""
PICTURES = (
    ((-4.3, -2.7, 1.1, 2.2), (0.55, 0.42, 0.22), (0.16, 0.24, 0.13)),
    ((-1.6, 0.0, 1.15, 2.25), (0.50, 0.31, 0.12), (0.62, 0.55, 0.42)),
    ((0.6, 1.5, 1.25, 2.15), (0.07, 0.20, 0.21), (0.60, 0.53, 0.41)),
    ((2.4, 4.2, 1.3, 2.3), (0.42, 0.11, 0.06), (0.56, 0.50, 0.40)),
)
"""On the walls: y from, to (on the near wall x), z from, to in metres, and the colours of sky and
land. The last hangs on the right wall alone, where the left one has its window."""
SKY, BOUNCE = np.array([0.62, 0.80, 1.05]), 2.2 * light.BOUNCE
"""Light of the window, and from the floor of the whole room; linear RGB."""


def _table(x: float, y: float, wide: float, deep: float) -> tuple[Thing, ...]:
    top = Box((x, y, TABLE_M - 0.02), (wide, deep, 0.04))
    ends = [
        (x + a * (wide / 2 - 0.05), y + b * (deep / 2 - 0.05)) for a in (-1, 1) for b in (-1, 1)
    ]
    half = (TABLE_M - 0.04) / 2
    legs = (Thing("table", Box((u, v, half), (0.05, 0.05, 2 * half)), WOOD) for u, v in ends)
    return (Thing("table", top, OAK, gloss=0.08), *legs)


FURNITURE = (
    *_table(2.75, 3.5, 0.8, 1.5),
    Thing("vase", Sphere((2.75, 3.85, TABLE_M + 0.13), 0.13), (0.07, 0.28, 0.30), gloss=0.4),
    Thing("card", Box((2.62, 3.25, TABLE_M + 0.09), (0.13, 0.004, 0.18), 0.35), (0.8, 0.79, 0.76)),
    Thing("figure", Box((-2.7, 3.9, 0.42), (0.30, 0.18, 0.84), 0.4), (0.48, 0.30, 0.16)),
    Thing("figure", Box((-2.7, 3.9, 1.15), (0.44, 0.22, 0.62), 0.4), (0.56, 0.37, 0.20)),
    Thing("figure", Sphere((-2.7, 3.9, PERSON_M - 0.14), 0.14), (0.62, 0.42, 0.24), gloss=0.1),
    Thing("football", resting(-3.3, 5.4, 0.11), (0.75, 0.74, 0.70), gloss=0.2),
)
ROOM = (*THINGS, *FURNITURE)
WALLS = ("left wall", "right wall", "front wall", "back wall", "floor", "ceiling")
NAMES = (*WALLS, *(thing.name for thing in ROOM))


@dataclass(frozen=True, slots=True)
class View:
    """What each pixel of a camera sees of the room, in single precision."""

    depth: Floats
    """(H, W) metres along the optical axis."""
    points: Floats
    """(H, W, 3) metres, world frame."""
    normals: Floats
    """(H, W, 3) unit, towards the camera's side."""
    to_eye: Floats
    """(H, W, 3) unit."""
    albedo: Planes
    """(3, H, W) linear RGB."""
    identity: Identity
    """(H, W) index into `NAMES`."""


def finer(K: ArrayLike, factor: int = 2) -> Floats:
    """The calibration matrix (3, 3) of the same camera with ``factor`` times as many pixels."""
    larger = np.asarray(K, float) * np.array([[factor], [factor], [1.0]])
    larger[:2, 2] += (factor - 1) / 2
    return larger


def halve(planes: Planes) -> Planes:
    """Means of 2 × 2 pixels of (3, 2H, 2W)."""
    pairs = planes[:, ::2] + planes[:, 1::2]
    return np.float32(0.25) * (pairs[..., ::2] + pairs[..., 1::2])


def look(K: ArrayLike, world_to_camera: ArrayLike, width: int, height: int) -> View:
    """The room through a pinhole camera at a pose (4, 4) inside the room."""
    pose, K = np.asarray(world_to_camera, float), np.asarray(K, float)
    eye = invert_pose(pose)[:3, 3]
    rays = pixel_rays(K, width, height)
    length = np.sqrt(np.einsum("...i,...i", rays, rays))
    directions = ((rays / length[..., None]) @ pose[:3, :3]).astype(np.float32)
    distance, points, normals, identity = _walls(eye, directions)
    albedo = _wall_colours(points, identity)
    for index, thing in enumerate(ROOM, len(WALLS)):
        window = _pixels(thing, pose, K, width, height)
        if window is None:
            continue
        towards = directions[window]
        hit = intersect(thing.solid, eye, towards)
        nearer = hit.valid & (hit.distance < distance[window])
        if nearer.any():
            distance[window][nearer] = hit.distance[nearer]
            points[window][nearer], normals[window][nearer] = (
                hit.points[nearer],
                hit.normals[nearer],
            )
            identity[window][nearer] = index
            colours = surfaces.thing_albedo(thing, hit.normals, area=min(nearer.shape) > 1)
            albedo[:, *window][:, nearer] = colours[:, nearer]
    return View(distance / length, points, normals, -directions, albedo, identity)


def photograph(focal: float, world_to_camera: ArrayLike, columns: int) -> Raster:
    """A picture, 4 : 3, with the principal point in its middle, and with so many rays across; one
    of `COLUMNS` is smooth, from means of four. ``focal`` is in rays."""
    rows = columns * 3 // 4
    K = intrinsics(focal, ((columns - 1) / 2, (rows - 1) / 2))
    light = shade(look(K, world_to_camera, columns, rows))
    smooth = halve(light) if columns == COLUMNS else light
    return to_rgba8(encode_srgb_table(smooth.transpose(1, 2, 0)))


def _walls(eye: Floats, directions: Floats) -> tuple[Floats, Floats, Floats, Identity]:
    """Distance, point, normal and index of the wall that each ray meets, from inside the room."""
    away, sides = [], []
    for axis in range(3):
        way = directions[..., axis]
        ahead = way > 0
        low, high = np.float32(LOW[axis] - eye[axis]), np.float32(HIGH[axis] - eye[axis])
        steep = np.where(np.abs(way) < 1e-9, np.float32(1e-9), way)
        away.append(np.where(ahead, high, low) / steep)
        sides.append(ahead + np.uint8(2 * axis))
    distance = np.minimum(np.minimum(away[0], away[1]), away[2])
    identity = np.where(away[1] == distance, sides[1], sides[2])
    identity = np.where(away[0] == distance, sides[0], identity)
    inwards = np.repeat(np.eye(3, dtype=np.float32), 2, axis=0)
    inwards[1::2] *= -1
    points = directions * distance[..., None]
    points += np.float32(eye)
    return distance, points, inwards.take(identity, axis=0), identity


def _wall_colours(points: Floats, identity: Identity) -> Planes:
    """(3, H, W) reflectances of the six walls."""
    albedo = np.empty((3, *identity.shape), np.float32)
    painters = (
        _window_wall,
        _door_wall,
        _near_wall,
        surfaces.wall_albedo,
        surfaces.floor_albedo,
        _ceiling,
    )
    for wall, paint in enumerate(painters):
        where = identity == wall
        window = surfaces.window_of(where)
        if window is not None:
            np.copyto(albedo[:, *window], paint(points[window], True), where=where[window])
    return albedo


def _near_wall(points: Floats, area: bool) -> Planes:
    """Behind the first camera: a slate, and pictures as on the side walls."""
    side = _side(points, area, across=0)
    return surfaces.laid_over(_framed(side, SLATE, 3), 0.5 * DOOR, side.opening(SLATE))


def _ceiling(points: Floats, area: bool) -> Planes:
    """White between beams."""
    away = points[..., 1]
    beams = stripes(away, BEAMS_M, 0.2, pixel_width(away, area))
    return surfaces.mixed(LIME, BEAM, beams)


@dataclass(frozen=True, slots=True)
class _Side:
    """Places on a wall: y (on the near wall x) and z of each pixel, and how far it reaches."""

    y: Floats
    z: Floats
    wide: Floats
    high: Floats

    def opening(self, bounds: tuple[float, float, float, float]) -> Floats:
        """Share (H, W) of each pixel inside a rectangle: y from, to, z from, to."""
        left, right, bottom, top = bounds
        return band(self.y, left, right, self.wide) * band(self.z, bottom, top, self.high)


def _side(points: Floats, area: bool, across: int = 1) -> _Side:
    y, z = points[..., across], points[..., 2]
    return _Side(y, z, pixel_width(y, area), pixel_width(z, area))


def _framed(side: _Side, bounds: tuple[float, float, float, float], pictures: int) -> Planes:
    """A plastered wall with skirting, the first ``pictures``, and the frame of an opening."""
    skirting = band(side.z, -0.15, 0.15, side.high)
    wall = surfaces.mixed(PLASTER, surfaces.SKIRTING, skirting)
    for edges, sky, land in PICTURES[:pictures]:
        left, right, bottom, top = edges
        low = (left, right, bottom, bottom + 0.4 * (top - bottom))
        for colour, part in ((WOOD, _wider(edges, 0.07)), (sky, edges), (land, low)):
            wall = surfaces.laid_over(wall, np.array(colour), side.opening(part))
    return surfaces.laid_over(wall, FRAME, side.opening(_wider(bounds, 0.09)))


def _wider(
    bounds: tuple[float, float, float, float], by: float
) -> tuple[float, float, float, float]:
    left, right, bottom, top = bounds
    return left - by, right + by, bottom - by, top + by


def _door_wall(points: Floats, area: bool) -> Planes:
    left, right, top = DOORWAY
    side, bounds = _side(points, area), (left, right, 0.0, top)
    door = surfaces.laid_over(_framed(side, bounds, 4), DOOR, side.opening(bounds))
    for low, high in ((0.2, 0.9), (1.05, 1.85)):
        panel = (left + 0.14, right - 0.14, low, high)
        door = surfaces.laid_over(door, 0.7 * DOOR, side.opening(panel))
    return door


def _panes(side: _Side) -> Floats:
    """Share (H, W) of each pixel of the left wall through which the sky is seen."""
    left, right, bottom, top = WINDOW
    middle, sill = (left + right) / 2, 0.6 * top + 0.4 * bottom
    bars = band(side.y, middle - 0.03, middle + 0.03, side.wide)
    across = band(side.z, sill - 0.03, sill + 0.03, side.high)
    return side.opening(WINDOW) * (1 - np.maximum(bars, across))


def _window_wall(points: Floats, area: bool) -> Planes:
    side = _side(points, area)
    return surfaces.laid_over(_framed(side, WINDOW, 3), np.zeros(3), _panes(side))


def _pixels(
    thing: Thing, pose: Floats, K: Floats, width: int, height: int
) -> tuple[slice, slice] | None:
    """Rows and columns that hold the ball around a thing; None where all of it is out of view."""
    x, y, z = pose[:3, :3] @ np.asarray(thing.solid.centre) + pose[:3, 3]
    radius = bounding_radius(thing.solid)
    if z <= -radius:
        return None
    sides = []
    for across, focal, middle, count in (
        (y, K[1, 1], K[1, 2], height),
        (x, K[0, 0], K[0, 2], width),
    ):
        away, angle = math.hypot(across, z), math.atan2(across, z)
        half = math.asin(radius / away) if away > radius else math.pi
        ends = (max(angle - half, -1.57), min(angle + half, 1.57))
        low, high = (middle + focal * math.tan(end) for end in ends)
        start, stop = max(math.floor(low) - 1, 0), min(math.ceil(high) + 2, count)
        if stop - start < 1:
            return None
        sides.append(slice(start, stop))
    return sides[0], sides[1]


def shade(view: View, light_angle: float = 40.0, lamp: float = 1.0, around: float = 1.0) -> Planes:
    """(3, H, W) linear RGB under the lamp at ``light_angle`` degrees, which is ``lamp`` times as
    bright as in the still life, and surroundings and window ``around`` times: dusk is 0.1."""
    towards = light.lamp_direction(light_angle)
    openness = surfaces.sky_seen(view.points, view.normals, ROOM, reach=3.0, stride=4)
    above = (0.5 + 0.5 * view.normals[..., 2]) * openness
    seen = light.lamp_seen(view.points, towards, ROOM, stride=4)
    direct = lambert(view.normals, towards) * seen
    picture = light.tinted(lamp * light.LAMP, direct)
    picture += light.tinted(around * light.ROOM, above)
    picture += light.tinted(around * BOUNCE, openness - above)
    picture *= view.albedo
    for window, shining in _shining(view, towards, seen):
        picture[:, *window] += light.tinted(lamp * light.LAMP, shining)
    where = view.identity == WALLS.index("left wall")
    if (part := surfaces.window_of(where)) is not None:
        picture[:, *part] += light.tinted(
            around * SKY, _panes(_side(view.points[part], True)) * where[part]
        )
    return picture


def _shining(
    view: View, towards: Vector, seen: Floats
) -> Iterator[tuple[tuple[slice, slice], Floats]]:
    """Highlights (h, w) of the glossy things, each in its window."""
    for index, thing in enumerate(ROOM, len(WALLS)):
        if thing.gloss:
            where = view.identity == index
            window = surfaces.window_of(where)
            if window is not None:
                strength = blinn_phong(
                    view.normals[window],
                    towards,
                    view.to_eye[window],
                    albedo=0.0,
                    specular=thing.gloss,
                    shininess=thing.shininess,
                )
                yield window, strength * seen[window] * where[window]
