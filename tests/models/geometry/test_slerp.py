"""Orientations between two others: slerp and nlerp against SciPy's, and what both must keep."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from support.quaternions import same_up_to_sign

from simulations.models.arrays import Floats
from simulations.models.geometry import quaternions, rotations


def test_slerp_turns_at_constant_speed_and_nlerp_does_not() -> None:
    start, end = quaternions.from_rotation_vector([(0, 0, 0), (0, 0, math.radians(170))])
    quarter_deg = [
        math.degrees(np.linalg.norm(quaternions.to_rotation_vector(blend(start, end, 0.25))))
        for blend in (rotations.slerp, rotations.nlerp)
    ]
    # nlerp walks the chord: tan of the angle from its middle shrinks in proportion to the share.
    on_the_chord = 85 - 2 * math.degrees(math.atan(0.5 * math.tan(math.radians(42.5))))
    assert quarter_deg == pytest.approx([42.5, on_the_chord])


@pytest.mark.parametrize("blend", [rotations.slerp, rotations.nlerp])
def test_blending_takes_the_shorter_way_and_meets_both_ends(blend: Callable[..., Floats]) -> None:
    start, end = quaternions.from_rotation_vector([(0, 0, 0.1), (0, 0, 0.3)])
    for sign in (1, -1):
        assert quaternions.to_rotation_vector(blend(start, sign * end, 0.5))[2] == pytest.approx(
            0.2
        )
        assert same_up_to_sign(blend(start, sign * end, 1.0), end) < 1e-15
        assert same_up_to_sign(blend(start, sign * end, 0.0), start) < 1e-15


@pytest.mark.parametrize("sign", [1, -1])
def test_of_two_ways_of_equal_length_the_signs_of_the_quaternions_decide(sign: int) -> None:
    middle = rotations.slerp([1.0, 0, 0, 0], [0, sign * 1.0, 0, 0], 0.5)
    assert middle == pytest.approx(np.array([1, sign, 0, 0]) / math.sqrt(2))


def test_slerp_goes_on_past_its_ends_at_the_same_speed() -> None:
    start, end = quaternions.from_rotation_vector([(0, 0, 0.1), (0, 0, 0.4)])
    shares = np.array([-1.0, -0.5, 1.5, 3.0])
    angles = quaternions.to_rotation_vector(rotations.slerp(start, end, shares))[:, 2]
    assert angles == pytest.approx(0.1 + 0.3 * shares)
