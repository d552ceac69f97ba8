"""Radiance of the surface at each pixel: its albedo times the light that arrives there."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Protocol

import numpy as np

from simulations.models.arrays import Floats, Mask, Planes, gathered
from simulations.models.light.raycasting import Sphere
from simulations.models.light.reflectance import blinn_phong
from simulations.pictures.patterns import NARROWEST, stripes
from simulations.world import light
from simulations.world.furniture import BOUNCE, HIGH, LOW, SKY, WALLS
from simulations.world.still_life import SceneObject
from simulations.world.surfaces import STRIPES_AXIS
from simulations.world.tracing import (
    FACES,
    FIRST_BALL,
    NUMBERED,
    Camera,
    Numbers,
    Surfaces,
    linear,
)
from simulations.world.walls import ALONG, albedo

LEAST_COSINE = np.float32(1e-3)
"""Least cosine between a surface's normal and a ray: bounds the width of a pixel's footprint."""


@dataclass(frozen=True)
class Lighting:
    """The light in the room."""

    angle: float = 40.0
    """Angle of the lamp, degrees."""
    lamp: float = 1.0
    """Brightness of the lamp, relative to the still life's."""
    around: float = 1.0
    """Brightness of surroundings and window: 0.1 at dusk."""

    @cached_property
    def towards(self) -> Planes:
        """(3,) unit vector to the lamp."""
        return np.array(light.lamp_direction(self.angle), np.float32)

    @cached_property
    def colours(self) -> Planes:
        """(4, 3) linear RGB: the lamp, the surroundings on an upright surface, the gain of a level
        surface that faces up, and the sky in the window."""
        upright, gain = 0.5 * (light.ROOM + BOUNCE), 0.5 * (light.ROOM - BOUNCE)
        around = self.around * np.stack([upright, gain, SKY])
        return np.stack([self.lamp * light.LAMP, *around]).astype(np.float32)


DAY = Lighting()
NOTHING = 255
"""Number of the surface of samples that stay black."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Finish:
    """Reflectance and geometry of the surfaces, by their number."""

    albedo: Planes
    """(3, surfaces) linear RGB."""
    gloss: Planes
    shininess: Planes
    normals: Planes
    """(3, surfaces) unit, away from the inside; of balls, 0."""
    centres: Planes
    """(3, surfaces) metres."""
    radii: Planes
    """Metres; of boxes, 1."""


@cache
def surface_finish() -> Finish:
    rows: list[Planes] = [np.zeros(9, np.float32)] * len(WALLS)
    for item, _ in NUMBERED:
        radius, faces = (item.solid.radius, 1) if isinstance(item.solid, Sphere) else (1.0, 6)
        row = (*item.albedo, item.gloss, item.shininess, *item.solid.centre, radius)
        rows += [np.array(row, np.float32)] * faces
    table = np.ascontiguousarray(np.stack(rows, axis=1))
    normals = np.zeros((3, table.shape[1]), np.float32)
    normals[:, :FIRST_BALL] = FACES.normals.T
    normals[:, : len(WALLS)] *= -1
    return Finish(
        albedo=table[:3],
        gloss=table[3],
        shininess=table[4],
        normals=normals,
        centres=table[5:8],
        radii=table[8],
    )


def normals_of(surface: Surfaces, points: Floats) -> Planes:
    """(3, H, W) unit normals of surfaces (H, W) at points (H, W, 3) in metres."""
    looks = surface_finish()
    normals = gathered(looks.normals, surface)
    ball = surface >= FIRST_BALL
    balls = surface[ball]
    centres = gathered(looks.centres, balls)
    normals[:, ball] = (points[ball].T - centres) / looks.radii[balls]
    return normals


@dataclass(frozen=True, slots=True, kw_only=True)
class Samples:
    """Rays through places of a picture, and the surfaces that they meet."""

    camera: Camera
    x: Floats
    """(n,) columns."""
    y: Floats
    """(n,) rows."""
    depth: Floats
    """(n,) metres."""
    width: Floats
    """(n,) of the square of which a sample is the middle: metres, at its depth, for each metre of
    the focal length."""
    surface: Surfaces
    """(n,) number of the surface."""

    def at(self, numbers: Numbers) -> "Samples":
        return Samples(
            camera=self.camera,
            x=self.x[numbers],
            y=self.y[numbers],
            depth=self.depth[numbers],
            width=self.width[numbers],
            surface=self.surface[numbers],
        )


class ArrivingLight(Protocol):
    """The light that the objects leave visible."""

    @property
    def bounds(self) -> Floats:
        """(walls, 2, 2) from and to, along u and v: the part of each wall that is not in full
        light."""

    def on_flat(self, surface: Numbers, points: Floats, normals: Floats, /) -> Floats:
        """Shares (2, n) of the lamp and of the surroundings at points (3, n) of flat surfaces (n,)
        or (1,), with normals (3, n) or (3, 1)."""

    def on_ball(self, surface: Numbers, points: Floats, normals: Floats, /) -> Floats:
        """The same at points of balls."""


def radiance(samples: Samples, arriving: ArrivingLight, lighting: Lighting) -> Planes:
    """(3, n) linear RGB."""
    light_there = np.zeros((3, samples.surface.size), np.float32)

    def fill(where: Mask, colours: Callable[..., Planes], *wall: int) -> None:
        if (at := np.flatnonzero(where)).size:
            found = colours(samples.at(at), *wall, arriving, lighting)
            for plane, values in zip(light_there, found, strict=True):
                plane[at] = values

    for wall in range(len(WALLS)):
        fill(samples.surface == wall, _radiance_of_wall, wall)
    fill((samples.surface >= len(WALLS)) & (samples.surface != NOTHING), _radiance_of_things)
    return light_there


def _radiance_of_wall(
    samples: Samples, wall: int, arriving: ArrivingLight, lighting: Lighting
) -> Planes:
    """(3, n) light from a wall."""
    u, v = ALONG[wall]
    (across, wide), (along, high) = (_on_wall(samples, axis, wall) for axis in (u, v))
    means = albedo(wall, across, along, wide, high)
    normal = surface_finish().normals[:, wall]
    lamp, upright, gain, sky = lighting.colours
    direct = lamp * np.maximum(normal @ lighting.towards, 0)
    around = upright + gain * normal[2]
    colours = means[:3] * (direct + around)[:, None]
    (left, right), (bottom, top) = arriving.bounds[wall].tolist()
    near = (across > left) & (across < right) & (along > bottom) & (along < top)
    if (at := np.flatnonzero(near)).size:
        points = np.empty((3, at.size), np.float32)
        points[wall // 2] = (LOW, HIGH)[wall % 2][wall // 2]
        points[u] = across[at]
        points[v] = along[at]
        lamp_share, sky_share = arriving.on_flat(np.array([wall]), points, normal[:, None])
        for channel, plane in enumerate(colours):
            arriving_light = direct[channel] * lamp_share + around[channel] * sky_share
            plane[at] = means[channel][at] * arriving_light
    if len(means) > 3:
        colours += sky[:, None] * means[3]
    return colours


def _on_wall(samples: Samples, axis: int, wall: int) -> tuple[Floats, Floats]:
    """A coordinate (n,) of the points on a wall, and its change over a pixel; metres.

    The change is the width of a box with the variance of the pixel's square along the coordinate.
    """
    camera = samples.camera
    face = camera.faces[wall]
    row = (camera.turn[axis] + camera.eye[axis] * face).astype(np.float32)
    place = linear(row, samples.x, samples.y)
    place *= samples.depth
    (a, b, _), (p, q, _) = row, face
    right, down = a - p * place, b - q * place
    right *= right
    down *= down
    right += down
    wide = np.sqrt(right, out=right)
    wide *= samples.width
    return place, wide


def _radiance_of_things(samples: Samples, arriving: ArrivingLight, lighting: Lighting) -> Planes:
    """(3, n) light from boxes and balls."""
    looks, surface = surface_finish(), samples.surface.astype(np.intp)
    directions = samples.camera.directions(samples.x, samples.y)
    points = directions * samples.depth
    points += samples.camera.eye.astype(np.float32)[:, None]
    normals, colours = gathered(looks.normals, surface), gathered(looks.albedo, surface)
    shares, ball = np.empty((2, surface.size), np.float32), surface >= FIRST_BALL
    if (boxes := np.flatnonzero(~ball)).size:
        hits, facing = gathered(points, boxes), gathered(normals, boxes)
        shares[:, boxes] = arriving.on_flat(surface[boxes], hits, facing)
    if (balls := np.flatnonzero(ball)).size:
        numbers, hits = surface[balls], gathered(points, balls)
        outwards = (hits - gathered(looks.centres, numbers)) / looks.radii[numbers]
        normals[:, balls] = outwards
        shares[:, balls] = arriving.on_ball(numbers, hits, outwards)
    for item, first in NUMBERED:
        if item.second_albedo and (at := np.flatnonzero(surface == first)).size:
            vectors = (gathered(part, at) for part in (directions, normals))
            colours[:, at] = _striped(item, samples.at(at), *vectors)
    return _shaded(surface, directions, normals, colours, shares, lighting)


def _shaded(
    surface: Numbers,
    directions: Floats,
    normals: Floats,
    colours: Planes,
    shares: Floats,
    lighting: Lighting,
) -> Planes:
    """(3, n) light from objects of these colours (3, n), with highlights where they are glossy."""
    lamp, upright, gain, _ = lighting.colours[:, :, None]
    direct = lamp * (np.maximum(lighting.towards @ normals, 0) * shares[0])
    direct += upright * shares[1]
    direct += gain * (normals[2] * shares[1])
    direct *= colours
    gloss = surface_finish().gloss[surface]
    if (at := np.flatnonzero(gloss)).size:
        to_eye = -gathered(directions, at)
        to_eye /= np.sqrt(np.einsum("in,in->n", to_eye, to_eye))
        highlight = blinn_phong(
            gathered(normals, at).T,
            lighting.towards,
            to_eye.T,
            albedo=0.0,
            specular=gloss[at],
            shininess=surface_finish().shininess[surface[at]],
        )
        highlight *= shares[0][at]
        for plane, colour in zip(direct, lamp, strict=True):
            plane[at] += colour * highlight
    return direct


def _striped(item: SceneObject, samples: Samples, directions: Floats, normals: Floats) -> Planes:
    """(3, n) colours of a striped ball. A pixel's footprint is computed on the tangent plane."""
    assert isinstance(item.solid, Sphere)
    assert item.second_albedo is not None
    axis = STRIPES_AXIS.astype(np.float32)
    sine = np.clip(axis @ normals, -1.0, 1.0)
    facing = np.minimum(np.einsum("in,in->n", normals, directions), -LEAST_COSINE)
    along = axis @ directions / facing
    squares = np.zeros_like(sine)
    for step in samples.camera.turn.T[:2].astype(np.float32):
        squares += np.square(axis @ step - along * (step @ normals))
    slope = np.sqrt(squares / np.maximum(1.0 - sine * sine, LEAST_COSINE**2))
    per_rad = item.stripe_count / math.pi
    pixel = samples.width * np.float32(per_rad / item.solid.radius) * slope
    share = stripes(np.arcsin(sine) * np.float32(per_rad), 2.0, 1.0, np.maximum(pixel, NARROWEST))
    first, second = (np.array(each, np.float32) for each in (item.albedo, item.second_albedo))
    return first[:, None] + np.multiply.outer(second - first, share.astype(np.float32))
