"""Lines that meet in no pixel, planes without a horizon, heights that it does not give."""

import numpy as np

from simulations.engine.hard_cases import HardCase, HardCases, invalid, near, refused, valid
from simulations.models.projection import level_ground, pinhole, vanishing

K = pinhole.intrinsics(800.0, (320.0, 240.0))

TABLE = HardCases(
    id="vanishing",
    title="Vanishing points and the horizon",
    names={
        **vars(level_ground),
        **vars(pinhole),
        **vars(vanishing),
        "K": K,
    },
    cases=(
        HardCase(
            id="lines-parallel-to-the-image",
            call="vanishing_point([1.0, 0.0, 0.0], K)",
            why="Lines parallel to the image stay parallel in it.",
            returns="No vanishing point.",
            expected=invalid,
            naive="np.array([800.0, 0.0]) / 0.0",
        ),
        HardCase(
            id="horizon-of-a-wall",
            call="horizon([0.0, 0.0, 1.0], K)",
            why="A wall that faces the camera squarely: its horizon is the line at infinity.",
            returns="No line; a line at infinity has no pixels.",
            expected=invalid,
        ),
        HardCase(
            id="angle-to-infinity",
            call="angle_between([1.0, 0.0, 0.0], [320.0, 240.0, 1.0], K)",
            why="Lines across the camera vanish at infinity, where there are no pixels.",
            returns="π/2: the point is given as a direction, with a 0.",
            expected=near(np.pi / 2),
        ),
        HardCase(
            id="height-on-the-horizon",
            call="height_by_horizon([50, 240], [50, 210], [0, 1, -240], [0, 1, 0])",
            why="The foot is infinitely far away: the ruler has no length there.",
            returns="No height.",
            expected=invalid,
            naive="np.divide(240.0 - 210.0, 240.0 - 240.0)",
        ),
        HardCase(
            id="height-of-a-level-camera",
            call="height_by_horizon([50, 330], [50, 210], [0, 1, -240], [0, 1, 0])",
            why="The uprights are parallel: the cross-ratio divides ∞ by ∞.",
            returns="The ratio of the two lengths that are left, 120/90.",
            expected=valid(4 / 3),
            naive="(330 - 210) * (np.inf - 240) / ((330 - 240) * (np.inf - 210))",
        ),
        HardCase(
            id="looking-straight-down",
            call="pose_above_ground(1.6, 0.3, np.pi / 2)",
            why="A turn to the side and a roll are one and the same here.",
            returns="Refused: the two angles would no longer say two things.",
            expected=refused("pitch 1.57", "at most 1.5"),
        ),
    ),
)
