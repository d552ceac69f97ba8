"""Decentred lenses: their inverse, and where it exists."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from numpy.testing import assert_allclose
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask
from simulations.models.distortion.decentring import (
    DecentredLens,
    on_sheet_of_axis,
    solve_in_plane,
    stay_positive,
    undo_decentred,
)
from simulations.models.distortion.lens_model import Distortion, distort, undistort
from simulations.models.distortion.radial_profile import RadialProfile


def test_solution_on_the_sheet_of_the_axis_is_preferred() -> None:
    """y + 0.3 y² folds at y = −1.67, so that −3 and −1/3 have the same image."""
    lens = DecentredLens(RadialProfile(), 0.1, 0.0)
    behind = np.array([[0.0, -3.0]])
    seen = np.stack(lens.linearised(*behind.T)[:2], axis=-1)
    assert_allclose(solve_in_plane(lens.linearised, seen, behind), behind)
    ideal, valid = undo_decentred(seen, behind, lens)
    assert valid.all()
    assert_allclose(ideal, [[0.0, -1 / 3]], atol=1e-15)


def test_point_without_an_inverse_stays_at_its_start() -> None:
    lens = DecentredLens(RadialProfile(), 0.1, 0.0)
    seen, start = np.array([[0.0, -5.0], [0.0, 0.13]]), np.array([[0.2, -4.0], [0.0, 0.13]])
    ideal, valid = undo_decentred(seen, start, lens)
    assert valid.tolist() == [False, True]
    assert ideal[0].tolist() == [0.2, -4.0]
    assert_allclose(ideal[1] + [0.0, 0.3 * ideal[1, 1] ** 2], seen[1], atol=1e-15)
    single, ok = undo_decentred(seen[1], start[1], lens)
    assert ok
    assert_allclose(single, ideal[1])


def test_derivatives_agree_with_differences() -> None:
    points, step = np.random.default_rng(1).uniform(-0.7, 0.7, (200, 2)), 1e-6
    d = Distortion(k1=0.1, k2=0.02, k3=0.01, p1=0.001, p2=0.002, k4=0.3, k5=0.05, k6=0.01)
    xx, mixed, yy = DecentredLens(d.radial, d.p1, d.p2).linearised(*points.T)[2:]
    for axis, slopes in enumerate(((xx, mixed), (mixed, yy))):
        shift = step * np.eye(2)[axis]
        expected = (distort(points + shift, d) - distort(points - shift, d)) / (2 * step)
        assert_allclose(np.stack(slopes, axis=-1), expected, atol=1e-8)


def least_determinant(points: Floats, d: Distortion) -> Floats:
    """The least determinant (N,) on the straight line from the axis to each point (N, 2)."""
    lens, least = DecentredLens(d.radial, d.p1, d.p2), np.full(len(points), np.inf)
    for share in np.linspace(0, 1, 2001)[1:]:
        xx, mixed, yy = lens.linearised(*(share * points).T)[2:]
        least = np.minimum(least, xx * yy - mixed * mixed)
    return least


HARD = (
    (Distortion(k1=-0.3, k2=0.0404, p1=1e-4), 2.5),
    (Distortion(k1=-0.3, k2=0.1, p1=0.1), 3.0),
    (Distortion(k1=0.0631, k2=0.1018, k3=-0.0177, p1=0.0709, p2=-0.0661), 2.5),
    (Distortion(k1=0.3539, k2=0.1161, k3=-0.037, p1=0.0082, p2=0.0216), 2.5),
    (Distortion(k1=0.2635, k2=-0.0677, p1=0.0033, p2=-0.0006, k4=-0.1428), 2.3),
)
"""Narrow folds, folds that end sideways, and strong decentring, with the largest radius to try."""


@pytest.mark.parametrize(("lens", "furthest"), HARD)
def test_exactly_the_points_on_the_sheet_of_the_axis_round_trip(
    lens: Distortion, furthest: float
) -> None:
    rng = np.random.default_rng(6)
    turn, radius = rng.uniform(0, 2 * np.pi, 3000), rng.uniform(0, furthest, 3000)
    points = np.stack((radius * np.cos(turn), radius * np.sin(turn)), axis=-1)
    least = least_determinant(points, lens)
    clear = np.abs(least) > 1e-4  # nearer to a fold, 2000 steps are too few
    back, valid = undistort(distort(points, lens), lens)
    returned = valid & (np.hypot(*(back - points).T) < 1e-6)
    assert clear.mean() > 0.2
    np.testing.assert_array_equal(returned[clear], least[clear] > 0)


def on_sheet(points: ArrayLike, lens: Distortion) -> Mask:
    return on_sheet_of_axis(np.asarray(points, float), lens.radial, lens.p1, lens.p2)


def test_narrow_fold_is_detected() -> None:
    """1 − 0.9 s + 5 k₂ s² falls below zero over a few parts in a million of the radius."""
    lens = Distortion(k1=-0.3, k2=0.0405 * (1 - 1e-11), p1=1e-30)
    fold = np.sqrt(0.9 / (10 * lens.k2))
    assert on_sheet([[0.999 * fold, 0], [1.001 * fold, 0], [0, 2 * fold]], lens).tolist() == [
        True,
        False,
        False,
    ]
    open_lens = Distortion(k1=-0.3, k2=0.0405 * (1 + 1e-6), p1=1e-30)
    assert on_sheet([[1.001 * fold, 0], [0, 2 * fold]], open_lens).all()


def positive(*polynomials: Polynomial) -> list[bool]:
    size = max(polynomial.coef.size for polynomial in polynomials)
    rows = [np.pad(polynomial.coef, (0, size - polynomial.coef.size)) for polynomial in polynomials]
    return stay_positive(np.array(rows)).tolist()


@pytest.mark.parametrize("place", [0.03, 0.4, 2 / 3, 0.97])
@pytest.mark.parametrize("depth", [1e-4, 1e-9, 1e-12])
def test_narrow_dip_below_zero_is_detected(place: float, depth: float) -> None:
    """(t − c)² − δ is negative only between its roots, which no sampling would hit."""
    dip = Polynomial((-place, 1.0)) ** 2
    assert positive(dip - depth, dip + depth) == [False, True]


def test_positivity_of_random_polynomials_agrees_with_their_roots() -> None:
    rng = np.random.default_rng(1)
    rows = rng.uniform(-1, 1, (3000, 9)) * 3.0 ** np.arange(9)
    rows[:, 0] = 1.0
    expected = []
    for row in rows:
        roots = np.roots(row[::-1])
        real = roots.real[np.abs(roots.imag) < 1e-9]
        expected.append(not ((real >= 0) & (real <= 1)).any())
    assert 0.1 < np.mean(expected) < 0.9
    np.testing.assert_array_equal(stay_positive(rows), expected)
