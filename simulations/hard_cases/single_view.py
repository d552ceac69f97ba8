"""Lines and lengths in one picture from which no camera, or no length, can be had."""

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine.hard_cases import HardCase, HardCases, exactly, refused
from simulations.models.arrays import Floats
from simulations.models.projection import (
    level_ground,
    pinhole,
    single_view,
    single_view_lengths,
    vanishing_lines,
)

SIZE = (800.0, 600.0)
K = pinhole.intrinsics(560.0, (399.5, 299.5))
ACROSS = ((-1, 4, 0), (1, 4, 0)), ((-1.5, 6, 0), (1.5, 6, 0))
AWAY = ((-1, 3.5, 0), (-1, 6, 0)), ((1, 3.5, 0), (1, 6, 0))
UPRIGHT = ((-1, 5, 0), (-1, 5, 1.5)), ((1, 5, 0), (1, 5, 1.5))


def _seen(lines: ArrayLike, pose: ArrayLike) -> Floats:
    return pinhole.project(pinhole.world_to_camera(np.array(lines, float), pose), K)[0]


LEVEL, TURNED = (
    level_ground.pose_above_ground(1.5, yaw, pitch) for yaw, pitch in ((0, 0), (0.6, 0.3))
)
ROOM, STRAIGHT_ON = (_seen((*ACROSS, *AWAY, *UPRIGHT), pose) for pose in (TURNED, LEVEL))
AXES = (0, 0, 1, 1, 2, 2)

TABLE = HardCases(
    id="single-view",
    title="Distances from one picture",
    names={
        **vars(vanishing_lines),
        **vars(single_view),
        **vars(single_view_lengths),
        "ROOM": ROOM,
        "STRAIGHT_ON": STRAIGHT_ON,
        "AXES": AXES,
        "SIZE": SIZE,
        "VIEW": single_view.fit_view(ROOM, AXES, SIZE),
    },
    cases=(
        HardCase(
            id="vanishing-at-infinity",
            call="pixel_of(*fit_vanishing_point([((0, 0), (90, 0)), ((0, 80), (90, 80))]))",
            why="Lines that are parallel in the picture.",
            returns="A point at infinity. It has a direction, but no pixel.",
            expected=lambda got: np.isnan(got[0]).all() and not got[2],
            naive="np.cross((0, -90, 0), (0, -90, 7200)) / 0",
        ),
        HardCase(
            id="lines-that-coincide",
            call="fit_vanishing_point([((0, 0), (1, 1)), ((2, 2), (3, 3))])",
            why="Two lines drawn along the same edge meet everywhere.",
            returns="Refused.",
            expected=refused("coincide"),
            naive="np.cross(np.cross((0, 0, 1), (1, 1, 1)), np.cross((2, 2, 1), (3, 3, 1)))",
        ),
        HardCase(
            id="both-on-one-side",
            call="focal_from_pair((250, 150, 1), (800, 150, 1), (200, 150))",
            why="Both vanishing points on one side of the principal point: f² is below 0.",
            returns="No focal length: no camera sees a right angle between such directions.",
            expected=exactly(np.nan),
            naive="np.sqrt(abs((250 - 200) * (800 - 200)))",
        ),
        HardCase(
            id="one-of-two-at-infinity",
            call="focal_from_pair((50, 150, 1), (1, 0, 0), (200, 150))",
            why="Of two vanishing points one is infinitely far off, the other not in the middle.",
            returns="Only a camera of infinite focal length sees a right angle there.",
            expected=exactly(np.inf),
        ),
        HardCase(
            id="one-point-perspective",
            call="fit_view(STRAIGHT_ON, AXES, SIZE).spread(lambda v: np.log(v.focal_px)) > 0.5",
            why="A room seen straight on: of three vanishing points only one is finite.",
            returns="True: a standard error of more than half, so the focal length stays unknown.",
            expected=exactly(True),
        ),
        HardCase(
            id="two-axes-in-one-point",
            call="fit_view(ROOM[[0, 1, 0, 1]], (0, 0, 1, 1), SIZE)",
            why="The same lines, given as running along two axes.",
            returns="Refused: two directions at right angles never vanish in one point.",
            expected=refused("apart"),
        ),
        HardCase(
            id="beyond-the-horizon",
            call="lengths(VIEW, [((400, 10), (500, 20)), ((400, 500), (500, 20))], ['within'] * 2)",
            why="A length on the floor whose second end is above the horizon.",
            returns="None. The first lies in the sky with both ends: a length on a ceiling.",
            expected=lambda got: np.isfinite(got[0]) and np.isnan(got[1]),
        ),
    ),
)
