"""No turn, half a turn, a million turns; quaternions of no length; angles that lock."""

import numpy as np

from simulations.engine.hard_cases import (
    HardCase,
    HardCases,
    LibraryAnswer,
    exactly,
    near,
    refused,
)
from simulations.models.geometry import euler, quaternions, rotations

TABLE = HardCases(
    id="rotations",
    title="Rotations and quaternions",
    names={
        **vars(rotations),
        "quaternions": quaternions,
        "euler": euler,
        "inf": np.inf,
        "nan": np.nan,
    },
    cases=(
        HardCase(
            id="no-turn",
            call="exponential([0.0, 0.0, 0.0])",
            why="sin θ/θ at θ = 0.",
            returns="The identity, exactly: where nothing turns, no axis is needed.",
            expected=exactly(np.eye(3)),
            naive="np.sin(0.0) / np.float64(0.0)",
            library=LibraryAnswer(
                "Rotation.from_rotvec([0, 0, 0]).as_matrix()", "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]"
            ),
        ),
        HardCase(
            id="tiny-turn",
            call="logarithm(exponential([1e-10, 0.0, 0.0]))",
            why="The trace differs from 3 by 1e−20, which is nothing beside 3.",
            returns="1e−10 to all digits: through the sine, not the cosine.",
            expected=near([1e-10, 0.0, 0.0], 1e-24),
            naive="np.arccos((np.trace([[1, 0, 0], [0, 1, -1e-10], [0, 1e-10, 1]]) - 1) / 2)",
            library=LibraryAnswer(
                "Rotation.from_matrix([[1, 0, 0], [0, 1, -1e-10], [0, 1e-10, 1]]).as_rotvec()",
                "[1e-10, 0, 0]",
            ),
        ),
        HardCase(
            id="half-turn",
            call="logarithm(np.diag([-1.0, -1.0, 1.0]))",
            why="At π the antisymmetric part, which usually gives the axis, vanishes.",
            returns="Half a turn about z. Of the two right signs the positive one is taken.",
            expected=near([0.0, 0.0, np.pi]),
            naive="np.pi / (2 * np.sin(np.pi)) * np.array([0.0, 0.0, 0.0])",
            library=LibraryAnswer(
                "cv2.Rodrigues(np.diag([-1.0, -1.0, 1.0]))[0][:, 0]", "[0, 0, 3.1416]"
            ),
        ),
        HardCase(
            id="nearly-half-a-turn",
            call="np.pi - logarithm(exponential([0.0, 0.0, np.pi - 1e-8]))[2]",
            why="Near π the cosine is flat: acos would lose half of all digits.",
            returns="The missing 1e−8, to eight digits.",
            expected=near(1e-8, 1e-15),
            naive="np.pi - np.arccos(np.cos(np.pi - 1e-8))",
        ),
        HardCase(
            id="many-turns",
            call="exponential([0.0, 0.0, 2e6 * np.pi])",
            why="A million turns are none, but 2π itself is rounded.",
            returns="The identity to nine digits; only the rounding of the angle is left.",
            expected=near(np.eye(3), 1e-8),
        ),
        HardCase(
            id="absurdly-many-turns",
            call="np.linalg.norm(exponential([1e200, 0.0, 0.0])[1])",
            why="In (1 − cos θ)/θ² [v]ₓ² one factor overflows and the other underflows.",
            returns="1: a rotation still, as axis and angle are parted first.",
            expected=near(1.0, 1e-14),
            naive="0.5 * np.sinc(1e200 / (2 * np.pi)) ** 2 * np.float64(1e200) ** 2",
        ),
        HardCase(
            id="infinite-turn",
            call="exponential([0.0, 0.0, inf])",
            why="An infinite angle points nowhere.",
            returns="Refused.",
            expected=refused("rotation_vector", "inf"),
            naive="np.cos(np.inf)",
            library=LibraryAnswer(
                "Rotation.from_rotvec([0, 0, inf]).as_matrix()",
                "[[nan, nan, nan], [nan, nan, nan], [nan, nan, nan]]",
            ),
        ),
        HardCase(
            id="no-axis",
            call="from_axis_angle([0.0, 0.0, 0.0], 0.5)",
            why="An axis of no length has no direction.",
            returns="Refused, even though a turn by 0 would not need one.",
            expected=refused("axis", "not zero"),
            naive="np.zeros(3) / np.linalg.norm(np.zeros(3))",
        ),
        HardCase(
            id="tiny-axis",
            call="from_axis_angle([0.0, 0.0, 1e-200], np.pi / 2) @ [1.0, 0.0, 0.0]",
            why="Squared, the axis underflows to 0 and its length with it.",
            returns="A quarter turn about z: the largest component is divided out first.",
            expected=near([0.0, 1.0, 0.0]),
            naive="np.array([0, 0, 1e-200]) / np.sqrt(np.float64(1e-200) ** 2)",
        ),
        HardCase(
            id="huge-axis",
            call="from_axis_angle([0.0, 0.0, 1e200], np.pi / 2) @ [1.0, 0.0, 0.0]",
            why="Squared, the axis overflows.",
            returns="A quarter turn about z.",
            expected=near([0.0, 1.0, 0.0]),
            naive="np.array([0, 0, 1e200]) / np.sqrt(np.float64(1e200) ** 2)",
        ),
        HardCase(
            id="zero-quaternion",
            call="quaternions.to_matrix([0.0, 0.0, 0.0, 0.0])",
            why="No orientation has norm 0: the average of q and −q is one way to meet it.",
            returns="Refused.",
            expected=refused("quaternion", "zero"),
            naive="np.zeros(4) / np.linalg.norm(np.zeros(4))",
            library=LibraryAnswer("Rotation.from_quat([0, 0, 0, 0]).as_matrix()", "ValueError"),
        ),
        HardCase(
            id="tiny-quaternion",
            call="quaternions.normalise([1e-200, 0.0, 0.0, 1e-200])",
            why="The norm underflows although the direction is plain to see.",
            returns="Unit norm: the largest component is divided out before squaring.",
            expected=near([np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)]),
            naive="np.array([1e-200, 0, 0, 1e-200]) / np.sqrt(2 * np.float64(1e-200) ** 2)",
            library=LibraryAnswer(
                "Rotation.from_quat([0, 0, 1e-200, 1e-200]).as_quat()", "ValueError"
            ),
        ),
        HardCase(
            id="huge-quaternion",
            call="quaternions.normalise([1e200, 0.0, 0.0, 1e200])",
            why="The norm overflows.",
            returns="Unit norm.",
            expected=near([np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)]),
            naive="np.array([1e200, 0, 0, 1e200]) / np.sqrt(2 * np.float64(1e200) ** 2)",
            library=LibraryAnswer(
                "Rotation.from_quat([0, 0, 1e200, 1e200]).as_quat()", "[0, 0, 0, 0]"
            ),
        ),
        HardCase(
            id="nan-quaternion",
            call="quaternions.normalise([1.0, nan, 0.0, 0.0])",
            why="One lost component makes the orientation unknown.",
            returns="Refused.",
            expected=refused("quaternion", "nan"),
        ),
        HardCase(
            id="two-names-of-one-turn",
            call="quaternions.canonical([-0.5, 0.5, 0.5, -0.5])",
            why="q and −q are the same rotation, and averaging the two gives nonsense.",
            returns="The one with w > 0.",
            expected=exactly([0.5, -0.5, -0.5, 0.5]),
        ),
        HardCase(
            id="shorter-way",
            call="slerp([1, 0, 0, 0], [-1, 0, 0, 0], 0.5)",
            why="Start and end are the same orientation, written with opposite signs.",
            returns="Stays where it is. Without a look at the signs it would turn once around.",
            expected=near([1.0, 0.0, 0.0, 0.0]),
            naive="np.array([0.5, 0, 0, 0]) + np.array([-0.5, 0, 0, 0])",
            library=LibraryAnswer(
                "Slerp([0, 1], Rotation.from_quat([[0, 0, 0, 1], [0, 0, 0, -1]]))(0.5).as_quat()",
                "[0, 0, 0, 1]",
            ),
        ),
        HardCase(
            id="slerp-of-equals",
            call="slerp([1, 0, 0, 0], [1, 0, 0, 0], 0.3)",
            why="sin(0.3 Ω)/sin Ω at Ω = 0.",
            returns="That orientation: sinc again, and no threshold.",
            expected=near([1.0, 0.0, 0.0, 0.0]),
            naive="np.sin(0.0) / np.sin(np.float64(0.0))",
        ),
        HardCase(
            id="slerp-a-hair-apart",
            call="slerp([1, 0, 0, 0], [1, 1e-12, 0, 0], 0.5)[1]",
            why="acos of a dot product that rounds to 1 says that nothing moved.",
            returns="Half of the way, 5e−13: the angle comes from atan2.",
            expected=near(5e-13, 1e-24),
            naive="np.arccos(1.0 / np.sqrt(1 + 1e-12**2))",
        ),
        HardCase(
            id="half-a-turn-apart",
            call="np.linalg.norm(slerp([1, 0, 0, 0], [0, 0, 0, 1], 0.5))",
            why="Two ways round, equally long.",
            returns="A unit quaternion on the way that the signs as given choose.",
            expected=near(1.0),
        ),
        HardCase(
            id="gimbal-lock",
            call="euler.from_matrix(euler.to_matrix('ZYX', (0.3, np.pi / 2, 0.1)), 'ZYX')",
            why="Pitch 90°: yaw and roll turn about the same line, only their difference is known.",
            returns="Roll 0, yaw with the whole difference, and a flag that says it is locked.",
            expected=lambda got: got[1] and np.allclose(got[0], (0.2, np.pi / 2, 0.0)),
            naive="np.arctan2(0.0, 0.0), np.arctan2(0.0, 0.0)",
            library=LibraryAnswer(
                "Rotation.from_euler('ZYX', [0.3, math.pi / 2, 0.1]).as_euler('ZYX')",
                "[0.2, 1.5708, 0]",
            ),
        ),
        HardCase(
            id="a-hair-from-the-lock",
            call="euler.from_matrix(euler.to_matrix('ZYX', (0.3, np.pi / 2 - 1e-8, 0.1)), 'ZYX')",
            why="Pitch 10⁻⁸ short of 90°: yaw and roll each keep about eight digits.",
            returns="All three, so that the matrix comes back to rounding, and True: locked.",
            expected=lambda got: (
                got[1] and np.allclose(got[0], (0.3, np.pi / 2 - 1e-8, 0.1), rtol=0, atol=1e-7)
            ),
            library=LibraryAnswer(
                "Rotation.from_euler('ZYX', [0.3, math.pi / 2 - 1e-8, 0.1]).as_euler('ZYX')",
                "[0.2, 1.5708, 0]",
            ),
        ),
        HardCase(
            id="proper-lock",
            call="euler.from_matrix(np.eye(3), 'ZXZ')[1]",
            why="In z-x-z angles the identity itself is locked.",
            returns="True: for this sequence the trouble lies at 0, not at 90°.",
            expected=exactly(True),
        ),
        HardCase(
            id="reflection",
            call="logarithm(np.diag([1.0, 1.0, -1.0]))",
            why="Orthogonal, but a mirror: no axis and angle turn a left hand into a right one.",
            returns="Refused, naming the determinant.",
            expected=refused("determinant"),
            library=LibraryAnswer("Rotation.from_matrix(np.diag([1.0, 1.0, -1.0]))", "ValueError"),
        ),
        HardCase(
            id="drifted-matrix",
            call="check_rotation(1.001 * np.eye(3))",
            why="After many float32 products a matrix stretches a little.",
            returns="Refused, with the drift: repair it on purpose, by nearest_rotation.",
            expected=refused("differs from I"),
        ),
        HardCase(
            id="repair-a-reflection",
            call="nearest_rotation(np.diag([1.0, 1.0, -0.1]))",
            why="U Vᵀ of the singular values would be a reflection.",
            returns="The identity: the sign of the smallest singular direction is turned.",
            expected=near(np.eye(3)),
            naive="np.diag(np.sign([1.0, 1.0, -0.1]))",
        ),
        HardCase(
            id="beyond-repair",
            call="nearest_rotation(-np.eye(3))",
            why="−I is equally far from all half turns.",
            returns="Refused: several rotations are nearest.",
            expected=refused("singular values"),
            naive="-np.eye(3)",
        ),
        HardCase(
            id="unknown-sequence",
            call="euler.to_matrix('xyY', (0.1, 0.2, 0.3))",
            why="Lower and upper case mean fixed and moving axes; mixed, they mean nothing.",
            returns="Refused, listing what is legal.",
            expected=refused("xyY", "upper case"),
        ),
        HardCase(
            id="no-rotations-at-all",
            call="logarithm(np.empty((0, 3, 3))).shape",
            why="The largest of no numbers is undefined.",
            returns="No rotation vectors.",
            expected=lambda got: got == (0, 3),
        ),
    ),
)
