"""Contents of the room that most figures show: walls, still life, furniture, and colours.

World axes: x right, y from the entrance to the wall with the chart, z up, metres.
"""

import numpy as np

from simulations.models.light.raycasting import Box, Sphere
from simulations.world import light
from simulations.world.still_life import OBJECTS, WALL_DISTANCE, SceneObject, resting

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


def _table(x: float, y: float, wide: float, deep: float) -> tuple[SceneObject, ...]:
    top = Box((x, y, TABLE_M - 0.02), (wide, deep, 0.04))
    ends = [
        (x + a * (wide / 2 - 0.05), y + b * (deep / 2 - 0.05)) for a in (-1, 1) for b in (-1, 1)
    ]
    half = (TABLE_M - 0.04) / 2
    legs = (SceneObject("table", Box((u, v, half), (0.05, 0.05, 2 * half)), WOOD) for u, v in ends)
    return (SceneObject("table", top, OAK, gloss=0.08), *legs)


FURNITURE = (
    *_table(2.75, 3.5, 0.8, 1.5),
    SceneObject("vase", Sphere((2.75, 3.85, TABLE_M + 0.13), 0.13), (0.07, 0.28, 0.30), gloss=0.4),
    SceneObject(
        "card", Box((2.62, 3.25, TABLE_M + 0.09), (0.13, 0.004, 0.18), 0.35), (0.8, 0.79, 0.76)
    ),
    SceneObject("figure", Box((-2.7, 3.9, 0.42), (0.30, 0.18, 0.84), 0.4), (0.48, 0.30, 0.16)),
    SceneObject("figure", Box((-2.7, 3.9, 1.15), (0.44, 0.22, 0.62), 0.4), (0.56, 0.37, 0.20)),
    SceneObject(
        "figure", Sphere((-2.7, 3.9, PERSON_M - 0.14), 0.14), (0.62, 0.42, 0.24), gloss=0.1
    ),
    SceneObject("football", resting(-3.3, 5.4, 0.11), (0.75, 0.74, 0.70), gloss=0.2),
)
ROOM = (*OBJECTS, *FURNITURE)
WALLS = ("left wall", "right wall", "front wall", "back wall", "floor", "ceiling")
NAMES = (*WALLS, *(item.name for item in ROOM))
