"""Vanishing points of drawn lines: distances, the likeliest point, and its uncertainty."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from simulations.models.arrays import Floats
from simulations.models.projection.vanishing_lines import (
    fit_vanishing_point,
    line_residuals,
    pixel_of,
)

RNG = np.random.default_rng(2)
SEGMENTS = RNG.uniform(0.0, 600.0, (6, 2, 2))


def towards(point: tuple[float, float], count: int, rng: np.random.Generator) -> Floats:
    near = rng.uniform((0.0, 0.0), (800.0, 600.0), (count, 2))
    return np.stack([near, near + 0.3 * (np.array(point) - near)], axis=1)


def test_a_residual_is_the_distance_of_the_ends_from_the_nearest_line_through_the_point() -> None:
    residuals, _ = line_residuals(SEGMENTS, (900.0, -200.0, 1.0))
    seen = SEGMENTS - (900.0, -200.0)
    smallest = np.linalg.eigvalsh(np.swapaxes(seen, 1, 2) @ seen)[:, 0]
    np.testing.assert_allclose(residuals**2, smallest, rtol=1e-8)


def test_lines_that_should_be_parallel_miss_by_half_their_rise_at_each_end() -> None:
    residuals, _ = line_residuals([((0.0, 0.0), (100.0, 6.0))], (1.0, 0.0, 0.0))
    np.testing.assert_allclose(residuals**2, 2 * 3.0**2)


@pytest.mark.parametrize("point", [(900.0, -200.0, 1.3), (3.0, 4.0, 0.0), (0.3, 0.1, -1e-3)])
def test_the_derivatives_are_those_of_small_steps(point: tuple[float, float, float]) -> None:
    segments, at = SEGMENTS / 300.0 - 1.0, np.array(point) / np.linalg.norm(point)
    _, J = line_residuals(segments, at)
    steps = 1e-6 * np.eye(3)
    small = [
        (line_residuals(segments, at + step)[0] - line_residuals(segments, at - step)[0]) / 2e-6
        for step in steps
    ]
    np.testing.assert_allclose(J, np.transpose(small), atol=1e-7)


@pytest.mark.parametrize("factor", [-1.0, 1e-9, 1e9])
def test_the_scale_of_the_point_changes_no_distance(factor: float) -> None:
    point = np.array([900.0, -200.0, 1.0])
    np.testing.assert_allclose(
        np.abs(line_residuals(SEGMENTS, factor * point)[0]),
        np.abs(line_residuals(SEGMENTS, point)[0]),
        rtol=1e-9,
    )


@pytest.mark.parametrize("point", [(400.0, 300.0), (-350.0, 250.0), (9e4, -2e4)])
def test_lines_without_noise_meet_where_they_were_drawn_to(point: tuple[float, float]) -> None:
    found, covariance = fit_vanishing_point(towards(point, 5, np.random.default_rng(1)))
    pixel, _, finite = pixel_of(found, covariance)
    assert finite
    np.testing.assert_allclose(pixel, point, rtol=1e-6)


def test_parallel_lines_meet_at_infinity() -> None:
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


def test_it_is_the_likeliest_point_that_scipy_finds_with_a_free_line_for_each() -> None:
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


def test_the_truth_is_inside_the_stated_ellipse_as_often_as_stated() -> None:
    truth, inside = np.array([1000.0, 250.0]), 0
    for seed in range(200):
        rng = np.random.default_rng(seed)
        ends = towards((1000.0, 250.0), 5, rng) + rng.normal(0, 1, (5, 2, 2))
        pixel, spread, _ = pixel_of(*fit_vanishing_point(ends, 1.0))
        off = pixel - truth
        inside += off @ np.linalg.solve(spread, off) < 2.0 * np.log(2.0)
    assert 0.42 < inside / 200 < 0.58  # of a half


def test_turning_moving_and_scaling_the_picture_takes_the_point_along() -> None:
    rng = np.random.default_rng(8)
    ends = towards((700.0, 900.0), 4, rng) + rng.normal(0, 1, (4, 2, 2))
    turn = 3.0 * np.array([[np.cos(0.7), -np.sin(0.7)], [np.sin(0.7), np.cos(0.7)]])
    pixel, spread, _ = pixel_of(*fit_vanishing_point(ends, 1.0))
    other, other_spread, _ = pixel_of(
        *fit_vanishing_point((ends @ turn.T + (50.0, -20.0))[::-1, ::-1], 3.0)
    )
    np.testing.assert_allclose(other, turn @ pixel + (50.0, -20.0), rtol=1e-6)
    np.testing.assert_allclose(other_spread, turn @ spread @ turn.T, rtol=1e-4)


@pytest.mark.parametrize(
    "segments",
    [
        [((0, 0), (1, 1))],
        [((0, 0), (1, 1)), ((2, 2), (2, 2))],
        [((0, 0), (1, 1)), ((2, 2), (3, 3))],
        [((0, 0), (1, 1)), ((2, np.nan), (3, 3))],
    ],
)
def test_lines_that_determine_no_point_are_refused(segments: list[object]) -> None:
    with pytest.raises(ValueError, match="legal"):
        fit_vanishing_point(segments)  # type: ignore[arg-type]
