"""The depth that a single ray of the still life meets, for focusing."""

import math

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.light.raycasting import intersect, intersect_plane
from simulations.world.surfaces import FLOOR_PLANE, WALL_PLANE
from simulations.world.things import THINGS, depth_along_axis, thing_depth, view


def ray_depth(ray_camera: ArrayLike, back: float = 0.0) -> float:
    """Depth along the optical axis in metres; for a thing, that of its centre.

    ``ray_camera`` (3,) is in the camera frame, z = 1. Rays above the wall meet it too, as it is
    drawn infinitely high.
    """
    seen = view(np.asarray(ray_camera, float).reshape(1, 1, 3), back=back)
    for thing in sorted(THINGS, key=thing_depth):
        if intersect(thing.solid, seen.eye, seen.directions).valid.all():
            return thing_depth(thing) + back
    direction = seen.directions[0, 0]
    met = (intersect_plane(*plane, seen.eye, direction) for plane in (FLOOR_PLANE, WALL_PLANE))
    distance = min((float(far) for far, meets in met if meets), default=math.inf)
    return float(depth_along_axis(np.asarray(seen.eye) + direction * distance)) + back
