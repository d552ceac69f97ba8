"""Light on the still life: one large distant lamp with soft shadows, and ambient light."""

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from simulations.models.arrays import Floats, Planes
from simulations.models.light.raycasting import Box, Sphere, Vector
from simulations.models.light.reflectance import blinn_phong, lambert
from simulations.models.light.soft_shadows import shadow_bounds, visibility
from simulations.world.surfaces import Surface, windows_between
from simulations.world.things import THINGS, Thing

LAMP_ELEVATION_RAD = math.radians(48.0)
LAMP_RADIUS_RAD = math.radians(5.0)
"""Half of the lamp's angular diameter: the sun's is 0.27°, that of a soft box several degrees."""
LAMP = np.array([0.86, 0.79, 0.68])  # linear RGB of a white surface that faces the lamp
ROOM = np.array([0.19, 0.22, 0.27])  # light from the surroundings above
BOUNCE = np.array([0.13, 0.11, 0.085])  # and from the floor below


def lamp_direction(light_angle_deg: float) -> Vector:
    """Unit vector towards the lamp: 0° is from behind the camera, positive from the right."""
    angle = math.radians(light_angle_deg)
    level = math.cos(LAMP_ELEVATION_RAD)
    return (level * math.sin(angle), -level * math.cos(angle), math.sin(LAMP_ELEVATION_RAD))


def radiance(part: Surface, lamp: Vector, bounced: float = 1.0) -> Planes:
    """(3, h, w) linear RGB: Lambert and Blinn–Phong under the lamp, plus the room's glow."""
    others = [thing for thing in THINGS if thing is not part.thing]
    direct = (lambert(part.normals, lamp) * lamp_seen(part.points, lamp, others)).astype(np.float32)
    from_above = (0.5 + 0.5 * part.normals[..., 2]) * part.openness
    around = tinted(ROOM, from_above)
    if bounced:
        around += tinted(bounced * BOUNCE, part.openness - from_above)
    shaded = part.albedo * (tinted(LAMP, direct) + around)
    if part.thing is not None and part.thing.gloss > 0:
        highlight = blinn_phong(
            part.normals,
            lamp,
            part.to_eye,
            albedo=0.0,
            specular=part.thing.gloss,
            shininess=part.thing.shininess,
        )
        shaded += tinted(LAMP, highlight)
    return shaded


def tinted(colour: Floats, strength: Floats) -> Planes:
    """Light (3, h, w) of one colour, as strong as (h, w)."""
    return colour.astype(np.float32)[:, None, None] * strength.astype(np.float32)


@lru_cache(maxsize=128)
def shadow_corners(solid: Sphere | Box, lamp: Vector) -> tuple[Floats, Floats]:
    """Corners (3,) of a cuboid that contains a thing and its shadow above the floor."""
    return shadow_bounds(solid, lamp, LAMP_RADIUS_RAD)


def lamp_seen(points: Floats, lamp: Vector, things: Sequence[Thing], stride: int = 1) -> Floats:
    """Share (H, W) of the lamp that the things do not hide from points (H, W, 3)."""
    seen = np.ones(points.shape[:2])
    solids = [thing.solid for thing in things]
    corners = [shadow_corners(solid, lamp) for solid in solids]
    for solid, near in zip(solids, windows_between(points, corners, stride), strict=True):
        if near is not None:
            seen[near] *= visibility(solid, points[near], lamp, LAMP_RADIUS_RAD)
    return seen
