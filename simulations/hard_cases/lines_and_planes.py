"""Lines through one point, lines that never meet, and what lies at infinity."""

import numpy as np

from simulations.engine.hard_cases import (
    HardCase,
    HardCases,
    exactly,
    invalid,
    near,
    valid,
)
from simulations.models.geometry import lines_and_planes

TABLE = HardCases(
    id="lines-and-planes",
    title="Lines and planes",
    names={**vars(lines_and_planes), "inf": np.inf, "nan": np.nan},
    cases=(
        HardCase(
            id="one-point-twice",
            call="line_through([1.0, 2.0], [1.0, 2.0])",
            why="All lines through the point would do; the cross product is (0, 0, 0).",
            returns="No line.",
            expected=invalid,
            naive="np.cross([1.0, 2.0, 1.0], [1.0, 2.0, 1.0])",
        ),
        HardCase(
            id="neighbours-far-off",
            call="line_through([1e9, 1e9], [1e9 + 3, 1e9 + 4])[0][:2]",
            why="Far from the origin the products of the cross product are 1e18 each.",
            returns="The exact direction: points are subtracted before anything is multiplied.",
            expected=near([-0.8, 0.6], 1e-15),
        ),
        HardCase(
            id="tiny-line",
            call="line_through([0.0, 0.0], [3e-200, 4e-200])[0]",
            why="The squares in the length of the normal vanish.",
            returns="The line: the largest component is divided out first.",
            expected=near([-0.8, 0.6, 0.0]),
            naive="np.array([-4e-200, 3e-200]) / np.sqrt(np.square(4e-200) + np.square(3e-200))",
        ),
        HardCase(
            id="line-to-infinity",
            call="line_through([0.0, 0.0], [inf, 0.0])",
            why="The second point is nowhere.",
            returns="No line. For a direction, take a second point anywhere along it.",
            expected=invalid,
            naive="np.array([0.0, np.inf]) / np.inf",
        ),
        HardCase(
            id="parallels",
            call="intersection([0.0, 1.0, 0.0], [0.0, 2.0, -6.0])",
            why="They meet at infinity: the last coordinate is 0.",
            returns="No point.",
            expected=invalid,
            naive="np.array([-6.0, 0.0]) / 0.0",
        ),
        HardCase(
            id="nearly-parallel",
            call="intersection([0.0, 1.0, 0.0], [1e-12, 1.0, -1.0])",
            why="At an angle of 1e−12 the crossing is real, and a long way off.",
            returns="The crossing, to the digits that the angle has.",
            expected=valid([1e12, 0.0], 1e-3),
        ),
        HardCase(
            id="parallel-but-for-rounding",
            call="intersection([0.1, 0.3, 1.0], [0.1 * 3, 0.3 * 3, 1.0])",
            why="0.1 · 3 and 0.3 · 3 are both rounded: the lines are parallel, their numbers not.",
            returns="No point: an angle of a few roundings is none.",
            expected=invalid,
            naive="np.cross([0.1, 0.3, 1.0], [0.1 * 3, 0.3 * 3, 1.0])[0] "
            "/ np.cross([0.1, 0.3, 1.0], [0.1 * 3, 0.3 * 3, 1.0])[2]",
        ),
        HardCase(
            id="line-at-infinity",
            call="intersection([3.0, 4.0, 5.0], [0.0, 0.0, 1.0])",
            why="(0, 0, 1) is a line of projective geometry, but of no picture.",
            returns="No point: it meets all others at infinity.",
            expected=invalid,
            naive="np.array([4.0, -3.0]) / 0.0",
        ),
        HardCase(
            id="any-scale",
            call="signed_distance([10.0, 0.0], [1e300, 0.0, 0.0])",
            why="A line may be written at any scale; a² overflows here.",
            returns="10.",
            expected=exactly(10.0),
            naive="np.float64(1e300) * 10 / np.sqrt(np.square(1e300))",
        ),
        HardCase(
            id="collinear-points",
            call="plane_through([0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0])",
            why="A sheaf of planes passes through three points of one line.",
            returns="No plane.",
            expected=invalid,
            naive="np.cross([1.0, 1.0, 1.0], [3.0, 3.0, 3.0]) / 0.0",
        ),
        HardCase(
            id="thin-triangle",
            call="plane_through([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1e9, 1e-3, 0.0])",
            why="Three points that are almost on one line: an angle of 1e−12.",
            returns="Their plane, Z = 0.",
            expected=valid([0.0, 0.0, 1.0, 0.0]),
        ),
    ),
)
