"""The depth of the still life along a single ray, for focusing."""

import math

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.light.raycasting import intersect, intersect_plane
from simulations.world.still_life import OBJECTS, depth_along_axis, object_depth, view
from simulations.world.surfaces import FLOOR_PLANE, WALL_PLANE


def ray_depth(ray_camera: ArrayLike, back: float = 0.0) -> float:
    """Depth along the optical axis in metres; for an object, the depth of its centre.

    ``ray_camera`` (3,) is in the camera frame, z = 1. The wall is taken as infinitely
    high, as it is drawn.
    """
    rays = view(np.asarray(ray_camera, float).reshape(1, 1, 3), back=back)
    for item in sorted(OBJECTS, key=object_depth):
        if intersect(item.solid, rays.eye, rays.directions).valid.all():
            return object_depth(item) + back
    direction = rays.directions[0, 0]
    hits = (intersect_plane(*plane, rays.eye, direction) for plane in (FLOOR_PLANE, WALL_PLANE))
    distance = min((float(far) for far, valid in hits if valid), default=math.inf)
    return float(depth_along_axis(np.asarray(rays.eye) + direction * distance)) + back
