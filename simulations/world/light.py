"""Light on the still life: one large distant lamp with soft shadows, and ambient light."""

import math
from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np

from simulations.models.arrays import Floats, Planes
from simulations.models.light.raycasting import Box, Sphere, Vector
from simulations.models.light.reflectance import blinn_phong, lambert
from simulations.models.light.soft_shadows import penumbra, shadow_bounds, smooth_ramp
from simulations.world.still_life import OBJECTS, SceneObject
from simulations.world.surfaces import FEW, Surface, Window, windows_between

LAMP_ELEVATION_RAD = math.radians(48.0)
LAMP_RADIUS_RAD = math.radians(5.0)
"""Half of the lamp's angular diameter: 0.27° for the sun, several degrees for a soft box."""
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
    others = [item for item in OBJECTS if item is not part.item]
    direct = (lambert(part.normals, lamp) * lamp_visibility(part.points, lamp, others)).astype(
        np.float32
    )
    from_above = (0.5 + 0.5 * part.normals[..., 2]) * part.openness
    around = tinted(ROOM, from_above)
    if bounced:
        around += tinted(bounced * BOUNCE, part.openness - from_above)
    shaded = part.albedo * (tinted(LAMP, direct) + around)
    if part.item is not None and part.item.gloss > 0:
        highlight = blinn_phong(
            part.normals,
            lamp,
            part.to_eye,
            albedo=0.0,
            specular=part.item.gloss,
            shininess=part.item.shininess,
        )
        shaded += tinted(LAMP, highlight)
    return shaded


def tinted(colour: Floats, strength: Floats) -> Planes:
    """Light (3, h, w) of one colour, as strong as (h, w)."""
    return colour.astype(np.float32)[:, None, None] * strength.astype(np.float32)


@lru_cache(maxsize=128)
def shadow_corners(solid: Sphere | Box, lamp: Vector) -> tuple[Floats, Floats]:
    """Corners (3,) of a cuboid that contains an object and its shadow above the floor."""
    return shadow_bounds(solid, lamp, LAMP_RADIUS_RAD)


def lamp_visibility(points: Floats, lamp: Vector, items: Sequence[SceneObject]) -> Floats:
    """Share (H, W) of the lamp that the objects do not hide from points (H, W, 3)."""
    share = np.ones(points.shape[:2])
    for window, place in _penumbras(points, lamp, items, FEW):
        share[window] *= smooth_ramp(place)
    return share


def lamp_penumbra(
    points: Floats, lamp: Vector, items: Sequence[SceneObject], beyond: float
) -> Floats:
    """Place (H, W) of points in the penumbra of all objects, from -``beyond`` to 1 + ``beyond``, of
    which the share of the lamp is the `smooth_ramp`.

    In the penumbra of one object it is the place in that one. It changes evenly where the light
    does not, so that a map of it keeps the edges of shadows between its nodes.
    """
    share, least = np.ones(points.shape[:2]), np.full(points.shape[:2], 1 + beyond)
    for window, place in _penumbras(points, lamp, items):
        share[window] *= smooth_ramp(place)
        least[window] = np.minimum(least[window], place)
    between = (least > 0) & (least < 1)
    least[between] = 0.5 - np.sin(np.arcsin(1 - 2 * share[between]) / 3)  # smooth_ramp's inverse
    return np.maximum(least, -beyond)


def _penumbras(
    points: Floats, lamp: Vector, items: Sequence[SceneObject], few: int = 0
) -> Iterator[tuple[Window, Floats]]:
    """The places in the penumbra of each object, in the window that its shadow may reach, or at all
    of a ``few`` points."""
    solids = [item.solid for item in items]
    corners = [shadow_corners(solid, lamp) for solid in solids]
    for solid, near in zip(solids, windows_between(points, corners, few), strict=True):
        if near is not None:
            yield near, penumbra(solid, points[near], lamp, LAMP_RADIUS_RAD)
