"""The book's two pictures of a room: the cameras, and what is drawn over them."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.geometry.rotations import exponential
from simulations.models.projection.pinhole import intrinsics, project
from simulations.pictures.checker_room import HIGH, LOW, TRIM_M, WINDOW

SIZE = (800, 600)
"""Width and height in pixels."""
FOCAL_PX = 480.0
EYE_M = HIGH[1]
"""Height of the camera above the floor, in metres."""
AXES = np.array([(1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)])
"""Across, along and upwards, in the room's coordinates: x right, y down, z away from the eye."""

type End = tuple[float, float, float]
type Line = tuple[End, End]


@dataclass(frozen=True, slots=True)
class Room:
    """A picture of the room, and lines and lengths in it, in metres from the eye."""

    turn: Floats
    """(3, 3) from the room's axes to the camera's."""
    lines: tuple[tuple[Line, ...], ...]
    """In the order of `settings.LISTS`; the first length is the known one."""

    @property
    def drawn(self) -> tuple[Floats, ...]:
        """The ends (N, 2, 2) of the lines of each list in the picture, without noise, in pixels."""
        K = intrinsics(FOCAL_PX, ((SIZE[0] - 1) / 2, (SIZE[1] - 1) / 2))
        return tuple(
            project(np.array(each, float).reshape(-1, 2, 3) @ self.turn.T, K)[0]
            for each in self.lines
        )

    @property
    def R(self) -> Floats:  # noqa: N802, as in the formulae
        """(3, 3) the axes in the camera frame, in columns."""
        return np.asarray(self.turn @ AXES.T)

    def metres(self, number: int) -> tuple[float, ...]:
        """The true lengths of a list."""
        return tuple(math.dist(*line) for line in self.lines[number])


def _turned(yaw_deg: float, pitch_deg: float, roll_deg: float) -> Floats:
    """To the right, then downwards, then leaning to the right."""
    yaw, pitch, roll = map(math.radians, (yaw_deg, pitch_deg, roll_deg))
    return np.asarray(
        exponential((0.0, 0.0, -roll))
        @ exponential((pitch, 0.0, 0.0))
        @ exponential((0.0, -yaw, 0.0))
    )


LEFT = LOW[0]
RIGHT, FLOOR, BACK = HIGH
SKIRTING = FLOOR - TRIM_M
"""Upper edge of the moulding along the floor."""
RAIL = 0.56
"""Upper edge of the rail above the panels."""
FRAME_TOP = -0.95
"""Of the pictures on the right wall."""

CORNER = Room(
    _turned(33.0, 21.0, 2.0),
    (
        (
            ((-0.1, RAIL, BACK), (2.6, RAIL, BACK)),
            ((-0.4, SKIRTING, BACK), (2.0, SKIRTING, BACK)),
            ((0.0, FLOOR, 3.75), (2.5, FLOOR, 3.75)),
            ((0.5, FLOOR, 1.75), (2.5, FLOOR, 1.75)),
        ),
        (
            ((RIGHT, RAIL, 1.9), (RIGHT, RAIL, 5.0)),
            ((RIGHT, SKIRTING, 1.7), (RIGHT, SKIRTING, 4.1)),
            ((1.5, FLOOR, 1.25), (1.5, FLOOR, 4.25)),
            ((0.0, FLOOR, 2.25), (0.0, FLOOR, 4.75)),
        ),
        (
            ((RIGHT, -0.75, 3.3), (RIGHT, 0.15, 3.3)),
            ((RIGHT, -0.5, 2.15), (RIGHT, 0.15, 2.15)),
            ((2.2, -0.8, BACK), (2.2, 0.2, BACK)),
            ((WINDOW[1], -0.9, BACK), (WINDOW[1], 0.38, BACK)),
        ),
        (
            ((0.5, FLOOR, 2.25), (2.5, FLOOR, 2.25)),
            ((0.5, FLOOR, 4.75), (2.0, FLOOR, 2.75)),
        ),
        (((RIGHT, FLOOR, 4.45), (RIGHT, FRAME_TOP, 4.45)),),
    ),
)
"""It shows three vanishing points."""
FRONT = Room(
    _turned(0.0, 0.0, 0.0),
    (
        (
            ((-2.0, RAIL, BACK), (2.4, RAIL, BACK)),
            ((-2.0, SKIRTING, BACK), (2.4, SKIRTING, BACK)),
            ((-0.9, WINDOW[2], BACK), (0.6, WINDOW[2], BACK)),
            ((-1.75, FLOOR, 3.25), (1.75, FLOOR, 3.25)),
        ),
        (
            ((LEFT, RAIL, 3.2), (LEFT, RAIL, 5.0)),
            ((RIGHT, RAIL, 3.8), (RIGHT, RAIL, 5.0)),
            ((-0.5, FLOOR, 2.75), (-0.5, FLOOR, 4.75)),
            ((1.5, FLOOR, 2.75), (1.5, FLOOR, 4.75)),
        ),
        (
            ((WINDOW[0], -1.1, BACK), (WINDOW[0], 0.3, BACK)),
            ((WINDOW[1], -1.1, BACK), (WINDOW[1], 0.3, BACK)),
            ((2.2, -0.8, BACK), (2.2, 0.2, BACK)),
            ((RIGHT, -0.9, 3.75), (RIGHT, 0.1, 3.75)),
        ),
        (
            ((-1.5, FLOOR, 3.75), (0.5, FLOOR, 3.75)),
            ((1.5, FLOOR, 3.25), (1.5, FLOOR, 4.75)),
            ((-0.5, FLOOR, 2.75), (1.0, FLOOR, 2.75)),
        ),
        (((RIGHT, FLOOR, 4.45), (RIGHT, FRAME_TOP, 4.45)),),
    ),
)
"""Of its three vanishing points, one is in the middle and two are at infinity."""
ROOMS = {"corner": CORNER, "front": FRONT}
