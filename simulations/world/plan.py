"""The room from above: what a plan of it draws."""

import math

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.light.raycasting import Sphere
from simulations.world.room import DOORWAY, HIGH, LOW
from simulations.world.things import Thing

WALLS = np.array([LOW[:2], (HIGH[0], LOW[1]), HIGH[:2], (LOW[0], HIGH[1])])
"""Corners (4, 2) of the floor, metres: x and y."""
DOOR = np.array([(HIGH[0], DOORWAY[0]), (HIGH[0], DOORWAY[1])])


def footprint(thing: Thing) -> Floats:
    """Corners (n, 2) of a thing from above, metres: x and y."""
    centre = np.asarray(thing.solid.centre[:2])
    if isinstance(thing.solid, Sphere):
        turns = np.arange(24) * (math.tau / 24)
        return centre + thing.solid.radius * np.stack([np.cos(turns), np.sin(turns)], -1)
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * np.asarray(thing.solid.size[:2]) / 2
    return centre + corners @ thing.solid.world_to_box[:2, :2]
