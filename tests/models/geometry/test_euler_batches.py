"""Euler angles of many rotations at once are those of each alone, locked ones included."""

import numpy as np
import pytest
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from simulations.models.geometry import euler

SEQUENCES = ("ZYX", "xyz", "ZXZ", "yzy")
RANDOM = Rotation.random(24, rng=np.random.default_rng(5)).as_matrix().reshape(4, 6, 3, 3)


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_a_field_of_rotations_has_the_angles_of_each(sequence: str) -> None:
    angles, locked = euler.from_matrix(RANDOM, sequence)
    assert (angles.shape, locked.shape) == ((4, 6, 3), (4, 6))
    for place in np.ndindex(4, 6):
        alone, alone_locked = euler.from_matrix(RANDOM[place], sequence)
        np.testing.assert_array_equal(angles[place], alone)
        assert locked[place] == alone_locked


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_a_field_of_angles_makes_the_matrices_of_each(sequence: str) -> None:
    angles = np.random.default_rng(6).uniform(-3, 3, (4, 6, 3))
    theirs = Rotation.from_euler(sequence, angles.reshape(-1, 3)).as_matrix().reshape(4, 6, 3, 3)
    np.testing.assert_allclose(euler.to_matrix(sequence, angles), theirs, atol=1e-15)


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_only_those_that_are_locked_are_told_so(sequence: str) -> None:
    proper = len({*sequence}) == 2
    free, lock = (1.0, 0.0) if proper else (0.3, np.pi / 2)
    R = euler.to_matrix(sequence, [[0.4, free, 0.2], [0.4, lock, 0.2], [0.4, -free, 0.2]])
    angles, locked = euler.from_matrix(R, sequence)
    assert locked.tolist() == [False, True, False]
    assert angles[1, 2] == 0.0
    np.testing.assert_allclose(euler.to_matrix(sequence, angles), R, atol=1e-14)


@pytest.mark.parametrize("angles", [0.3, [0.1, 0.2], np.zeros((3, 2))])
def test_angles_that_are_not_three_are_refused(angles: ArrayLike) -> None:
    with pytest.raises(ValueError, match=r"legal: \(\.\.\., 3\)"):
        euler.to_matrix("ZYX", angles)


def test_a_half_turn_is_plus_a_half_turn() -> None:
    angles, _ = euler.from_matrix(np.diag([-1.0, -1.0, 1.0]), "ZYX")
    assert angles.tolist() == [np.pi, 0.0, 0.0]
