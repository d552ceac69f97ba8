"""Vanishing points and horizons, and vanishing points fitted to drawn lines."""

import math
from collections.abc import Sequence

import numpy as np
import pytest
from scipy.optimize import least_squares

from simulations.models.arrays import Floats
from simulations.models.projection import pinhole, vanishing
from simulations.models.projection.vanishing_lines import fit_vanishing_point, pixel_of

K = pinhole.intrinsics((400.0, 410.0), (320.0, 240.0), skew=2.0)
RNG = np.random.default_rng(2)
NOWHERE = (math.nan, math.nan)


@pytest.mark.parametrize(
    ("direction", "pixel"),
    [
        *(((s, 0, s), (720, 240)) for s in (1, -1, 1e-300, 1e300)),
        ((0, 1, 1), (322, 650)),
        ((-1e300, 0.5e300, 1e300), (320 - 400 + 1, 240 + 205)),
        ((-1e-300, 0, 2e-300), (320 - 200, 240)),
        *((d, NOWHERE) for d in ((1, 0, 0), (0, 0, 0), (math.inf, 0, 1), (math.nan, 0, 1))),
        ((1e300, 0, 1e-20), NOWHERE),
    ],
)
def test_directions_towards_the_picture_have_a_vanishing_point(
    direction: Sequence[float], pixel: Sequence[float]
) -> None:
    found, valid = vanishing.vanishing_point(direction, K)
    assert valid == np.isfinite(pixel).all()
    assert found == pytest.approx(pixel, nan_ok=True)


@pytest.mark.parametrize(
    ("normal", "valid"),
    [
        *(
            (n, False)
            for n in ((0, 0, 1), (0, 0, -1), (0, 0, 0), (math.nan, 0, 1), (math.inf, 0, 1))
        ),
        ((1e-10, 0, 1), True),
        ((1e-17, 0, 1), False),  # indistinguishable from the axis
        ((1e-17, 0, -1), False),
        ((-1e300, -2e-10, 1.0), True),
    ],
)
def test_plane_has_a_horizon_unless_parallel_to_the_picture_or_invalid(
    normal: Sequence[float], valid: bool
) -> None:
    line, seen = vanishing.horizon(normal, pinhole.intrinsics(1.0, (0, 0)))
    assert seen == valid
    assert np.isnan(line).all() != valid


def test_all_directions_of_a_plane_vanish_on_its_horizon() -> None:
    normal = np.array([0.1, 1.0, 0.2])
    line, valid = vanishing.horizon(normal, K)
    directions = np.cross(normal, RNG.normal(size=(20, 3)))
    pixels, _ = vanishing.vanishing_point(directions, K)
    assert valid
    assert math.hypot(line[0], line[1]) == pytest.approx(1.0)
    assert pixels @ line[:2] + line[2] == pytest.approx(np.zeros(20), abs=1e-8)


def test_angle_between_lines_follows_from_their_vanishing_points() -> None:
    first, second = RNG.normal(size=(2, 20, 3))
    cosines = (first * second).sum(axis=1) / np.prod(
        np.linalg.norm((first, second), axis=2), axis=0
    )
    angles = vanishing.angle_between(first @ K.T, second @ K.T, K)
    assert angles == pytest.approx(np.arccos(np.abs(cosines)))


def towards(point: tuple[float, float], count: int, rng: np.random.Generator) -> Floats:
    near = rng.uniform((0.0, 0.0), (800.0, 600.0), (count, 2))
    return np.stack([near, near + 0.3 * (np.array(point) - near)], axis=1)


def test_vanishing_point_of_parallel_lines_is_at_infinity() -> None:
    start = np.random.default_rng(1).uniform(0, 600, (4, 2))
    found, covariance = fit_vanishing_point(
        np.stack([start, start + np.array([120.0, 50.0])], axis=1)
    )
    x, y, w = found
    assert abs(w) < 1e-9 * np.hypot(x, y)
    np.testing.assert_allclose(y / x, 50.0 / 120.0)
    pixel, spread, finite = pixel_of((1.0, 0.0, 0.0), covariance)
    assert not finite
    assert np.isnan(pixel).all()
    assert np.isnan(spread).all()


def test_fitted_vanishing_point_agrees_with_scipys_maximum_likelihood() -> None:
    rng = np.random.default_rng(5)
    ends = towards((1100.0, 220.0), 6, rng) + rng.normal(0, 2, (6, 2, 2))

    def distances(unknowns: Floats) -> Floats:
        point, angles = unknowns[:2], unknowns[2:]
        normals = np.column_stack([-np.sin(angles), np.cos(angles)])
        return np.einsum("nei,ni->ne", ends - point, normals).ravel()

    way = ends[:, 1] - ends[:, 0]
    start = np.concatenate([[1000.0, 200.0], np.arctan2(way[:, 1], way[:, 0])])
    expected = least_squares(distances, start, x_scale=np.maximum(np.abs(start), 0.1), xtol=1e-14)
    found, covariance = fit_vanishing_point(ends, 2.0)
    pixel, spread, _ = pixel_of(found, covariance)
    np.testing.assert_allclose(pixel, expected.x[:2], rtol=1e-5)
    J = expected.jac
    np.testing.assert_allclose(spread, 4.0 * np.linalg.inv(J.T @ J)[:2, :2], rtol=0.02)
