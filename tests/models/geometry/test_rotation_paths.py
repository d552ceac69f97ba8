"""Paths between orientations: against finite differences, SciPy and the chapter's numbers."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from simulations.models.geometry import euler, quaternions, rotation_paths, rotations

ANGLES = st.tuples(*[st.floats(-3.0, 3.0)] * 3)


@given(ANGLES, st.tuples(*[st.floats(-1.0, 1.0)] * 3))
def test_the_jacobian_gives_the_angular_velocity(
    angles: tuple[float, float, float], rates: tuple[float, float, float]
) -> None:
    step = 1e-6
    before, after = (
        Rotation.from_euler("ZYX", np.add(angles, np.multiply(sign * step, rates)))
        for sign in (-1, 1)
    )
    measured = (after * before.inv()).as_rotvec() / (2 * step)
    omega = rotation_paths.rate_axes("ZYX", angles) @ rates
    np.testing.assert_allclose(omega, measured, atol=1e-8)


@pytest.mark.parametrize("sequence", ["XYZ", "ZXZ", "YXZ"])
def test_the_jacobian_knows_every_sequence(sequence: str) -> None:
    angles, rates, step = [0.4, 0.9, -1.3], np.array([0.3, -0.7, 0.5]), 1e-6
    before, after = (
        Rotation.from_euler(sequence, angles + sign * step * rates) for sign in (-1, 1)
    )
    measured = (after * before.inv()).as_rotvec() / (2 * step)
    np.testing.assert_allclose(
        rotation_paths.rate_axes(sequence, angles) @ rates, measured, atol=1e-8
    )


def test_rates_are_about_axes_that_turn_along() -> None:
    with pytest.raises(ValueError, match="sequence 'xyz'; legal: of moving axes"):
        rotation_paths.rate_axes("xyz", (0, 0, 0))


@given(st.floats(-3, 3), st.floats(-1.57, 1.57), st.floats(-3, 3))
def test_steering_fades_as_the_pitch_nears_a_right_angle(
    yaw: float, pitch: float, roll: float
) -> None:
    sizes = np.linalg.svd(rotation_paths.rate_axes("ZYX", (yaw, pitch, roll)))[1]
    sine = abs(np.sin(pitch))
    np.testing.assert_allclose(sizes, np.sqrt([1 + sine, 1, 1 - sine]), atol=1e-8)


def test_the_average_of_two_matrices_shrinks() -> None:
    quarter = rotations.from_axis_angle([0, 0, 1], np.pi / 2)
    half = rotation_paths.matrix_blend(np.eye(3), quarter, 0.5)
    assert np.linalg.det(half) == pytest.approx(0.5)
    np.testing.assert_allclose(np.linalg.norm(half, axis=0), [0.5**0.5, 0.5**0.5, 1.0])


@pytest.mark.parametrize("share", [0.0, 0.3, 1.0, 1.4])
def test_slerp_stays_on_the_great_circle(share: float) -> None:
    start, end = quaternions.normalise([1, 2, -1, 0.5]), quaternions.normalise([0, 1, 1, 3])
    between = rotations.slerp(start, end, share)
    assert rotation_paths.off_great_circle(between, start, end) == pytest.approx(0, abs=1e-12)


@given(ANGLES)
def test_the_distance_is_that_of_the_nearest_point_of_the_circle(
    angles: tuple[float, float, float],
) -> None:
    start, end = np.array([1.0, 0, 0, 0]), quaternions.normalise([1, 1, 1, 1])
    q = quaternions.from_matrix(euler.to_matrix("ZYX", angles))
    turns = np.linspace(0, 2 * np.pi, 4001)[:, None]
    across = quaternions.normalise(end - (start @ end) * start)
    circle = np.cos(turns) * start + np.sin(turns) * across
    nearest = 2 * np.arccos(np.clip((circle @ q).max(), -1, 1))
    assert rotation_paths.off_great_circle(q, start, end) == pytest.approx(nearest, abs=2e-3)


def test_without_a_circle_the_distance_is_from_the_point() -> None:
    here, turned = np.array([1.0, 0, 0, 0]), quaternions.from_rotation_vector([0, 0.3, 0])
    assert rotation_paths.off_great_circle(turned, here, here) == pytest.approx(0.3)


def test_blended_angles_give_the_matrix_of_those_angles() -> None:
    start, end, shares = (0.1, -0.4, 2.0), (1.3, 0.8, -1.0), np.linspace(0, 1, 5)
    found = rotation_paths.euler_blend("ZYX", start, end, shares)
    angles = np.array(start) + shares[:, None] * np.subtract(end, start)
    np.testing.assert_allclose(found, Rotation.from_euler("ZYX", angles).as_matrix(), atol=1e-14)


def test_angles_about_axes_that_stay_are_blended_as_well() -> None:
    start, end = (0.1, -0.4, 2.0), (1.3, 0.8, -1.0)
    half = rotation_paths.euler_blend("xyz", start, end, 0.5)
    expected = Rotation.from_euler("xyz", np.add(start, end) / 2).as_matrix()
    np.testing.assert_allclose(half, expected, atol=1e-15)


@pytest.mark.parametrize("sequence", ["ZY", "ZYXZ", "ZYA", "ZZX", "zYX", ""])
def test_only_three_axes_with_different_neighbours_make_a_sequence(sequence: str) -> None:
    calls: tuple[Callable[[], object], ...] = (
        lambda: rotation_paths.rate_axes(sequence, (0, 0, 0)),
        lambda: rotation_paths.euler_blend(sequence, (0, 0, 0), (1, 1, 1), 0.5),
    )
    for call in calls:
        with pytest.raises(ValueError, match="sequence"):
            call()


@pytest.mark.parametrize("angles", [(0.0, 0.0), (0.0, np.inf, 0.0), (np.nan,) * 3, 1.0])
def test_angles_are_three_and_finite(angles: Any) -> None:
    good = (0.1, 0.2, 0.3)
    calls: dict[str, Callable[[], object]] = {
        "start_rad": lambda: rotation_paths.euler_blend("ZYX", angles, good, [0.0, 0.5]),
        "end_rad": lambda: rotation_paths.euler_blend("ZYX", good, angles, [0.0, 0.5]),
        "angles_rad": lambda: rotation_paths.rate_axes("ZYX", angles),
    }
    for name, call in calls.items():
        with pytest.raises(ValueError, match=rf"^{name}.+; legal: "):
            call()


def test_what_is_no_single_matrix_or_quaternion_is_refused_by_name() -> None:
    with pytest.raises(ValueError, match=r"^end of shape \(2, 2\); legal: \(3, 3\)"):
        rotation_paths.matrix_blend(np.eye(3), np.eye(2), 0.5)
    with pytest.raises(ValueError, match=r"^start of shape \(3, 4\); legal: \(4,\)"):
        rotation_paths.off_great_circle(np.eye(4)[0], np.eye(3, 4), np.eye(4)[1])


def test_matrices_are_blended_entry_by_entry_for_each_share() -> None:
    start, end = np.arange(9.0).reshape(3, 3), np.ones((3, 3))
    shares = np.array([[0.0, 0.25], [1.0, 2.0]])
    found = rotation_paths.matrix_blend(start, end, shares)
    assert found.shape == (2, 2, 3, 3)
    np.testing.assert_allclose(found[0, 1], 0.75 * start + 0.25)
    np.testing.assert_allclose(found[1, 1], 2 - start)


@pytest.mark.parametrize("apart", [1e-9, 1e-3, 1.0])
def test_off_a_short_arc_only_what_lies_across_counts(apart: float) -> None:
    """From no turn to a turn about x: turns about y are off it by their whole angle."""
    start, end = quaternions.from_rotation_vector([(0, 0, 0), (apart, 0, 0)])
    along, across = quaternions.from_rotation_vector([(0.7, 0, 0), (0, 0.3, 0)])
    assert rotation_paths.off_great_circle(along, start, end) == pytest.approx(0, abs=1e-6)
    assert rotation_paths.off_great_circle(across, start, end) == pytest.approx(0.3)


@pytest.mark.parametrize("share", [np.nan, np.inf, [0.5, 2e6]])
def test_a_share_that_is_none_leads_nowhere(share: float | list[float]) -> None:
    with pytest.raises(ValueError, match=r"^share .+; legal: at most 1e\+06 in size"):
        rotation_paths.euler_blend("ZYX", (0.0, 0.1, 0.2), (1.0, 0.5, 0.3), share)
    with pytest.raises(ValueError, match=r"^share .+; legal: at most 1e\+06 in size"):
        rotation_paths.matrix_blend(np.eye(3), np.eye(3), share)
