"""Newton's method in the plane, and lenses whose elements are off centre."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from support.decentred_lenses import least_determinant

from simulations.models.arrays import Floats
from simulations.models.distortion.decentring import DecentredLens, undo_decentred
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    undistort,
)
from simulations.models.distortion.plane_newton import MOST_STEPS, Linearisation, solve_in_plane
from simulations.models.distortion.radial_profile import RadialProfile

PLANE = np.random.default_rng(3).uniform(-0.6, 0.6, (300, 2))


def shear_and_square(x: Floats, y: Floats) -> Linearisation:
    """The gradient of x²+ xy/2 + y³/3 + y²: (2x + y/2, x/2 + y² + 2y)."""
    return 2 * x + y / 2, x / 2 + y * y + 2 * y, 2 + 0 * x, 0.5 + 0 * x, 2 * y + 2


def test_points_are_solved_for_until_they_have_settled_and_no_longer() -> None:
    sizes = []

    def counted(x: Floats, y: Floats) -> Linearisation:
        sizes.append(x.size)
        return shear_and_square(x, y)

    wanted = np.stack(shear_and_square(*PLANE.T)[:2], axis=-1)
    start = PLANE.copy()
    start[:10] += 0.2  # the others are where they belong
    start[10:20] -= 0.2
    start[20:30, 0] += 0.2
    start[30:40, 1] -= 0.2
    assert_allclose(solve_in_plane(counted, wanted, start), PLANE, atol=1e-14)
    assert sizes[0] == 300
    assert 0 < sizes[1] <= 40


def test_a_point_without_a_solution_is_given_up_and_spoils_no_other() -> None:
    """y² + 2 y is never below −1."""
    wanted = np.array([[0.0, -3.0], [2.5, 3.5]])
    calls = []

    def counted(x: Floats, y: Floats) -> Linearisation:
        calls.append(x.size)
        return shear_and_square(x, y)

    found = solve_in_plane(counted, wanted, wanted)
    assert len(calls) == MOST_STEPS
    assert_allclose(found[1], [1, 1], atol=1e-14)


def test_a_solution_on_another_sheet_is_left_for_that_on_the_axis_s() -> None:
    """y + 0.3 y² turns at y = −1.67: −3 is sent where −1/3 is."""
    lens = DecentredLens(RadialProfile(), 0.1, 0.0)
    behind = np.array([[0.0, -3.0]])
    seen = np.stack(lens.linearised(*behind.T)[:2], axis=-1)
    assert_allclose(solve_in_plane(lens.linearised, seen, behind), behind)
    ideal, valid = undo_decentred(seen, behind, lens)
    assert valid.all()
    assert_allclose(ideal, [[0.0, -1 / 3]], atol=1e-15)


@pytest.mark.parametrize("direction", [(1, 0), (-1, 0), (0, 1), (0, -1)])
def test_far_out_a_solution_may_miss_by_the_rounding_of_its_place(
    direction: tuple[int, int],
) -> None:
    lens = DecentredLens(RadialProfile(), 1e-9, 1e-9)
    distances = 1e6 * np.linspace(1.0, 1.1, 400)[:, None]
    seen = distances * np.asarray(direction, float)
    ideal, valid = undo_decentred(seen, seen, lens)
    assert valid.all()
    assert_allclose(np.stack(lens.linearised(*ideal.T)[:2], -1), seen, rtol=1e-14, atol=1e-8)


def test_what_cannot_be_undone_stays_at_its_start() -> None:
    lens = DecentredLens(RadialProfile(), 0.1, 0.0)
    seen, start = np.array([[0.0, -5.0], [0.0, 0.13]]), np.array([[0.2, -4.0], [0.0, 0.13]])
    ideal, valid = undo_decentred(seen, start, lens)
    assert valid.tolist() == [False, True]
    assert ideal[0].tolist() == [0.2, -4.0]
    assert_allclose(ideal[1] + [0.0, 0.3 * ideal[1, 1] ** 2], seen[1], atol=1e-15)
    single, ok = undo_decentred(seen[1], start[1], lens)
    assert ok
    assert_allclose(single, ideal[1])


HARD = (
    (Distortion(k1=-0.3, k2=0.0404, p1=1e-4), 2.5),
    (Distortion(k1=-0.3, k2=0.1, p1=0.1), 3.0),
    (Distortion(k1=0.0631, k2=0.1018, k3=-0.0177, p1=0.0709, p2=-0.0661), 2.5),
    (Distortion(k1=0.3539, k2=0.1161, k3=-0.037, p1=0.0082, p2=0.0216), 2.5),
    (Distortion(k1=0.2635, k2=-0.0677, p1=0.0033, p2=-0.0006, k4=-0.1428), 2.3),
)
"""Narrow folds, folds that end at their side, and strong decentring, with radii to ask up to."""


@pytest.mark.parametrize(("lens", "furthest"), HARD)
def test_every_point_of_the_sheet_comes_back_and_none_from_elsewhere(
    lens: Distortion, furthest: float
) -> None:
    rng = np.random.default_rng(6)
    turn, radius = rng.uniform(0, 2 * np.pi, 3000), rng.uniform(0, furthest, 3000)
    points = np.stack((radius * np.cos(turn), radius * np.sin(turn)), axis=-1)
    least = least_determinant(points, lens)
    clear = np.abs(least) > 1e-4  # nearer to a fold than that, 2000 steps are too few
    back, valid = undistort(distort(points, lens), lens)
    returned = valid & (np.hypot(*(back - points).T) < 1e-6)
    assert clear.mean() > 0.2
    np.testing.assert_array_equal(returned[clear], least[clear] > 0)
