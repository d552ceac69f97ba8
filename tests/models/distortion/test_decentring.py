"""Newton's method in the plane, and lenses whose elements are off centre."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from support.decentred_lenses import least_determinant

from simulations.models.arrays import Floats
from simulations.models.distortion import decentring
from simulations.models.distortion.decentring import DecentredLens, undo_decentred
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    undistort,
    undistort_clamped,
)
from simulations.models.distortion.plane_newton import MOST_STEPS, Linearisation, solve_in_plane
from simulations.models.distortion.radial_profile import RadialProfile

PLANE = np.random.default_rng(3).uniform(-0.6, 0.6, (300, 2))


def shear_and_square(x: Floats, y: Floats) -> Linearisation:
    """The gradient of x²+ xy/2 + y³/3 + y²: (2x + y/2, x/2 + y² + 2y)."""
    return 2 * x + y / 2, x / 2 + y * y + 2 * y, 2 + 0 * x, 0.5 + 0 * x, 2 * y + 2


def test_points_are_found_that_a_map_sends_to_where_they_are_wanted() -> None:
    wanted = np.stack(shear_and_square(*PLANE.T)[:2], axis=-1)
    assert_allclose(solve_in_plane(shear_and_square, wanted, PLANE + 0.1), PLANE, atol=1e-14)


def test_a_linear_map_is_solved_in_one_step_and_confirmed_in_another() -> None:
    sizes = []

    def linear(x: Floats, y: Floats) -> Linearisation:
        sizes.append(x.size)
        return 3 * x + y, x + 2 * y, 3 + 0 * x, 1 + 0 * x, 2 + 0 * x

    wanted = PLANE @ [[3.0, 1.0], [1.0, 2.0]]
    assert_allclose(solve_in_plane(linear, wanted, np.zeros_like(wanted)), PLANE, atol=1e-15)
    assert sizes == [300, 300]


def test_points_that_have_settled_are_not_asked_for_again() -> None:
    sizes = []

    def counted(x: Floats, y: Floats) -> Linearisation:
        sizes.append(x.size)
        return shear_and_square(x, y)

    wanted = np.stack(shear_and_square(*PLANE.T)[:2], axis=-1)
    start = PLANE.copy()
    start[:40] += 0.2  # the others are where they belong
    solve_in_plane(counted, wanted, start)
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


def test_a_point_that_runs_off_to_nan_is_left_there() -> None:
    with np.errstate(all="ignore"):
        found = solve_in_plane(
            lambda x, y: (x * x, y, 2 * x, 0 * x, 1 + 0 * x),
            np.array([[1.0, 2.0]]),
            np.zeros((1, 2)),
        )
    assert not np.isfinite(found[0, 0])


def squares(x: Floats, y: Floats) -> Linearisation:
    return x * x, y * y, 2 * x, 0 * x, 2 * y


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("offset", [-0.2, 0.2])
def test_a_step_in_either_sense_of_either_axis_calls_for_another(axis: int, offset: float) -> None:
    root = np.array([[0.7, 0.9]])
    start = root + offset * np.eye(2)[axis]
    assert_allclose(solve_in_plane(squares, root**2, start), root, atol=1e-15)


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("place", [-1e6, 1e6])
def test_far_out_a_step_is_judged_against_the_distance(place: float, axis: int) -> None:
    """One of 0.0003 at a million is worth no further one; at 0.1 it would be."""
    calls = []

    def counted(x: Floats, y: Floats) -> Linearisation:
        calls.append(x.size)
        return squares(x, y)

    root = np.ones((1, 2))
    root[0, axis] = place
    start = root.copy()
    start[0, axis] += 3e-4
    assert_allclose(solve_in_plane(counted, root**2, start), root, rtol=1e-15)
    assert len(calls) == 1
    start[0, axis] += 0.1
    assert_allclose(solve_in_plane(counted, root**2, start), root, rtol=1e-15)
    assert len(calls) == 3


@pytest.mark.parametrize("p", [(0.02, 0.0), (0.0, 0.02), (-0.01, 0.015)])
@pytest.mark.parametrize("k1", [-0.2, 0.5])
def test_a_large_field_of_decentred_points_comes_back(k1: float, p: tuple[float, float]) -> None:
    lens = Distortion(k1=k1, p1=p[0], p2=p[1])
    ideal = np.random.default_rng(4).uniform(-0.5, 0.5, (60, 50, 2))
    back, valid = undistort(distort(ideal, lens), lens)
    assert valid.shape == (60, 50)
    assert valid.all()
    assert_allclose(back, ideal, atol=1e-14)


def test_the_derivatives_are_those_of_differences() -> None:
    lens, step = DecentredLens(RadialProfile((0.1, -0.02), (0.05,)), 0.02, -0.03), 1e-6
    x, y = PLANE.T
    _, _, by_x, mixed, by_y = lens.linearised(x, y)
    right, left = lens.linearised(x + step, y), lens.linearised(x - step, y)
    down, up = lens.linearised(x, y + step), lens.linearised(x, y - step)
    assert_allclose(by_x, (right[0] - left[0]) / (2 * step), atol=1e-9)
    assert_allclose(mixed, (right[1] - left[1]) / (2 * step), atol=1e-9)
    assert_allclose(mixed, (down[0] - up[0]) / (2 * step), atol=1e-9)
    assert_allclose(by_y, (down[1] - up[1]) / (2 * step), atol=1e-9)


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


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(("off", "valid"), [(1.25e-11, True), (1.35e-11, False)])
def test_a_solution_is_valid_if_the_lens_sends_it_where_it_was_seen(
    monkeypatch: pytest.MonkeyPatch, axis: int, sign: int, off: float, valid: bool
) -> None:
    """To 1e-11 of 1 and of its larger coordinate, which is 0.3 here."""
    lens, ideal = DecentredLens(RadialProfile((1e-9,)), 1e-9, 1e-9), np.array([[0.3, -0.2]])
    seen = np.stack(lens.linearised(*ideal.T)[:2], axis=-1)
    found = ideal.copy()
    found[0, axis] += sign * off
    monkeypatch.setattr(decentring, "solve_in_plane", lambda *_: found)
    monkeypatch.setattr(decentring, "_kept_on_sheet", lambda *_: found)
    assert undo_decentred(seen, np.zeros_like(seen), lens)[1].tolist() == [valid]


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize(("far", "valid"), [(7.1e44, True), (7.2e44, False)])
def test_a_solution_lies_no_further_out_than_lenses_are_defined(
    monkeypatch: pytest.MonkeyPatch, axis: int, far: float, valid: bool
) -> None:
    """As far as the radial part is solved for: to 2¹⁴⁹, which is 7.14e44."""
    lens, found = DecentredLens(RadialProfile((1e-99,)), 1e-60, 1e-60), np.zeros((1, 2))
    found[0, axis] = far
    seen = np.stack(lens.linearised(*found.T)[:2], axis=-1)
    monkeypatch.setattr(decentring, "solve_in_plane", lambda *_: found)
    assert undo_decentred(seen, np.zeros_like(seen), lens)[1].tolist() == [valid]


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


def test_newton_s_whole_steps_alone_would_lose_some_of_them() -> None:
    """Else the careful steps were for nothing."""
    lens, point = HARD[2][0], np.array([[-1.68, -1.11]])
    decentred = DecentredLens(lens.radial, lens.p1, lens.p2)
    start, _ = undistort_clamped(distort(point, lens), Distortion(lens.k1, lens.k2, lens.k3))
    whole = solve_in_plane(decentred.linearised, distort(point, lens), start)
    assert np.abs(whole - point).max() > 0.1
    back, valid = undistort(distort(point, lens), lens)
    assert valid.all()
    assert_allclose(back, point, atol=1e-12)
