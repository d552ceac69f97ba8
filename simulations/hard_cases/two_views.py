"""Points too far away, and cameras so placed, that two pictures give no depth."""

import numpy as np

from simulations.engine.hard_cases import HardCase, HardCases, invalid, refused, valid
from simulations.models.projection import pinhole, two_views

K = pinhole.intrinsics(800.0, (320.0, 240.0))

TABLE = HardCases(
    id="two-views",
    title="Two views",
    names={
        **vars(pinhole),
        **vars(two_views),
        "K": K,
    },
    cases=(
        HardCase(
            id="no-disparity",
            call="depth_from_disparity(0.0, 800.0, 0.1)",
            why="Both pictures have the point in the same place: fb/0.",
            returns="∞, and that is an answer: the stars have no disparity.",
            expected=valid(np.inf),
        ),
        HardCase(
            id="negative-disparity",
            call="depth_from_disparity(-0.5, 800.0, 0.1)",
            why="A match beyond infinity, as noise makes of far points.",
            returns="No depth; the formula puts the point 160 m behind the cameras.",
            expected=invalid,
            naive="800 * 0.1 / -0.5",
        ),
        HardCase(
            id="line-of-the-epipole",
            call="epipolar_lines(fundamental_matrix(K, K, np.eye(3), [0, 0, -1]), [320.0, 240.0])",
            why="The second camera stands straight ahead, and the pixel is its image: F x is 0.",
            returns="No line: every line through the other epipole would do.",
            expected=invalid,
            naive="np.zeros(3) / np.hypot(0.0, 0.0)",
        ),
        HardCase(
            id="depth-along-the-baseline",
            call="depth_of_match([320.0, 240.0], [320.0, 240.0], K, K, np.eye(3), [0, 0, -1])",
            why="On the line through both centres every depth has the same two images.",
            returns="No depth.",
            expected=invalid,
            naive="np.divide(0.0, 0.0)",
        ),
        HardCase(
            id="two-views-from-one-place",
            call="essential_matrix(np.eye(3), [0.0, 0.0, 0.0])",
            why="The camera has turned, but not moved: E would be 0, and any two pixels a match.",
            returns="Refused. Such pictures are related by a homography, and give no depth.",
            expected=refused("t [0.0, 0.0, 0.0]", "not zero"),
        ),
    ),
)
