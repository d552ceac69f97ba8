"""Stand-ins for slerp, against SciPy's and against what the theory says they get wrong."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from simulations.models.arrays import Floats
from simulations.models.geometry import quaternions
from simulations.models.geometry.quaternion_blends import (
    BLENDS,
    STRAIGHT,
    bisected_arc,
    paced_nlerp,
    threshold_slerp,
    turn_between_rad,
)

SHARES = np.linspace(0.0, 1.0, 41)
AXIS = np.array([2.0, -1.0, 2.0]) / 3.0


def pair(
    angle_deg: float, first: tuple[float, float, float] = (0.3, -0.5, 0.2)
) -> tuple[Floats, Floats]:
    """Two unit quaternions that far apart, on one hemisphere."""
    start = quaternions.from_rotation_vector(first)
    turn = quaternions.from_rotation_vector(np.radians(angle_deg) * AXIS)
    return start, quaternions.multiply(turn, start)


def scipy_path(start: Floats, end: Floats, shares: Floats = SHARES) -> Rotation:
    ends = Rotation.from_quat(np.stack([start, end]), scalar_first=True)
    return Slerp([0.0, 1.0], ends)(shares)


def off_deg(blended: Floats, path: Rotation) -> Floats:
    ours = Rotation.from_quat(np.asarray(blended, float), scalar_first=True)
    return np.degrees((path.inv() * ours).magnitude())


@pytest.mark.parametrize("angle_deg", [0, 1e-6, 3, 90, 179])
def test_bisection_finds_scipys_slerp(angle_deg: float) -> None:
    start, end = pair(angle_deg)
    assert off_deg(bisected_arc(start, end, SHARES), scipy_path(start, end)).max() < 1e-12


def test_bisection_carries_more_digits_than_a_double_where_the_machine_has_them() -> None:
    start, end = pair(100)
    arc = bisected_arc(start, end, SHARES)
    assert arc.dtype == np.longdouble
    assert np.abs((arc**2).sum(axis=-1) - 1).max() < 4 * np.finfo(np.longdouble).eps


@pytest.mark.parametrize("kind", BLENDS)
@pytest.mark.parametrize("angle_deg", [0, 1, 60, 179])
def test_every_blend_begins_and_ends_at_the_two_orientations(kind: str, angle_deg: float) -> None:
    start, end = pair(angle_deg)
    ends = BLENDS[kind](start, end, [0.0, 0.5, 1.0])
    middle = quaternions.normalise(start + end)
    np.testing.assert_allclose(ends, [start, middle, end], atol=1e-12)


@pytest.mark.parametrize("kind", ["paced-nlerp", "slerp-threshold", "slerp"])
def test_blends_follow_the_great_circle_as_closely_as_they_promise(kind: str) -> None:
    allowed_deg = {"paced-nlerp": 0.05, "slerp-threshold": 1e-4, "slerp": 1e-12}[kind]
    for angle_deg in range(0, 180, 3):
        start, end = pair(angle_deg)
        off = off_deg(BLENDS[kind](start, end, SHARES), scipy_path(start, end))
        assert off.max() < allowed_deg


@pytest.mark.parametrize(("dot", "share"), [(0.05, 0.2), (0.3, 0.35), (0.7, 0.8), (0.95, 0.1)])
def test_pacing_bends_the_share_by_kapoulkines_polynomials(dot: float, share: float) -> None:
    """The fit written out as in its source, with t for the share and d for the dot product."""
    start, end = np.array([1.0, 0, 0, 0]), np.array([dot, 0, np.sqrt(1 - dot**2), 0])
    d, t = dot, share
    a = 1.0904 + d * (-3.2452 + d * (3.55645 - d * 1.43519))
    b = 0.848013 + d * (-1.06021 + d * 0.215638)
    k = a * (t - 0.5) * (t - 0.5) + b
    bent = t + t * (t - 0.5) * (t - 1) * k
    expected = (1 - bent) * start + bent * end
    blended = paced_nlerp(start, end, share)
    np.testing.assert_allclose(blended, expected / np.linalg.norm(expected), atol=1e-15)


def test_below_the_threshold_a_straight_line_is_taken_and_above_it_an_arc() -> None:
    """At dot products just on either side: the line's known error, and none."""
    for dot, straight in ((STRAIGHT + 1e-5, True), (STRAIGHT - 1e-5, False)):
        arc = np.arccos(dot)
        start, end = np.array([1.0, 0, 0, 0]), np.array([dot, 0, 0, np.sin(arc)])
        seen = np.arctan2(0.2 * np.sin(arc), 0.8 + 0.2 * dot)
        w, _, _, z = threshold_slerp(start, end, 0.2)
        expected = seen if straight else 0.2 * arc
        assert np.arctan2(z, w) == pytest.approx(expected, abs=1e-9 * arc)


@pytest.mark.parametrize("angle_rad", [0.0, 1e-12, 1e-6, 0.3, 1.5, 3.1])
def test_the_turn_between_two_orientations_is_its_angle(angle_rad: float) -> None:
    start, end = pair(np.degrees(angle_rad))
    for other in (end, -end):
        assert turn_between_rad(start, other) == pytest.approx(angle_rad, abs=1e-15, rel=1e-4)


@pytest.mark.parametrize("sign", [1, -1])
def test_half_a_turn_apart_the_signs_of_the_quaternions_decide_the_way(sign: int) -> None:
    middle = threshold_slerp([1.0, 0, 0, 0], [0, sign * 1.0, 0, 0], 0.5)
    assert middle == pytest.approx(np.array([1, sign, 0, 0]) / np.sqrt(2))
