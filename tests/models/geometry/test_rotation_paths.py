"""Paths between orientations: against finite differences, SciPy and the chapter's numbers."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from simulations.models.geometry import euler, quaternions, rotation_paths, rotations

ANGLES = st.tuples(*[st.floats(-3.0, 3.0)] * 3)


@pytest.mark.parametrize("sequence", ["ZYX", "XYZ", "ZXZ", "YXZ"])
@given(ANGLES, st.tuples(*[st.floats(-1.0, 1.0)] * 3))
@settings(max_examples=20)
def test_the_jacobian_gives_the_angular_velocity(
    sequence: str, angles: tuple[float, float, float], rates: tuple[float, float, float]
) -> None:
    step = 1e-6
    before, after = (
        Rotation.from_euler(sequence, np.add(angles, np.multiply(sign * step, rates)))
        for sign in (-1, 1)
    )
    measured = (after * before.inv()).as_rotvec() / (2 * step)
    omega = rotation_paths.rate_axes(sequence, angles) @ rates
    np.testing.assert_allclose(omega, measured, atol=1e-8)


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


@pytest.mark.parametrize("sequence", ["ZYX", "xyz"])
def test_blended_angles_give_the_matrix_of_those_angles(sequence: str) -> None:
    start, end, shares = (0.1, -0.4, 2.0), (1.3, 0.8, -1.0), np.linspace(0, 1, 5)
    found = rotation_paths.euler_blend(sequence, start, end, shares)
    angles = np.array(start) + shares[:, None] * np.subtract(end, start)
    np.testing.assert_allclose(found, Rotation.from_euler(sequence, angles).as_matrix(), atol=1e-14)


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
