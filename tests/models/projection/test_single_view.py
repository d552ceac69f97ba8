"""A camera from lines along the axes: exact, accurate, and as uncertain as it says."""

import math

import numpy as np
import pytest
from support.drawn_lines import CENTRE, FOCAL, SIZE, K, drawn, some_pose

from simulations.models.arrays import Floats
from simulations.models.projection.level_ground import pose_above_ground
from simulations.models.projection.pinhole import intrinsics
from simulations.models.projection.single_view import (
    SingleView,
    by_small_steps,
    fit_view,
    focal_from_pair,
)
from simulations.models.projection.vanishing_lines import (
    fit_vanishing_point,
    line_residuals,
    pixel_of,
)

POSE = pose_above_ground(1.5, 0.6, 0.3, 0.05)
EXACT = 1e-3
"""Error of ends that were drawn without noise, so small that nothing known beforehand counts."""


def log_focal(view: SingleView) -> float:
    return math.log(view.focal_px)


@pytest.mark.parametrize("counts", [(4, 4, 4), (2, 2, 0), (2, 0, 2), (0, 3, 2), (2, 2, 1)])
def test_lines_without_noise_give_the_camera(counts: tuple[int, int, int]) -> None:
    view = fit_view(*drawn(POSE, np.random.default_rng(1), counts), SIZE, EXACT)
    assert view.focal_px == pytest.approx(FOCAL, rel=1e-6)
    np.testing.assert_allclose(view.R, POSE[:3, :3], atol=1e-6)
    assert (view.pitch, view.roll) == pytest.approx((0.3, 0.05), abs=1e-6)
    assert view.misfit < 1e-6


def test_three_directions_give_the_principal_point_too() -> None:
    shifted = intrinsics(FOCAL, (450.0, 260.0))
    ends, axes = drawn(POSE, np.random.default_rng(1), K=shifted)
    view = fit_view(ends, axes, SIZE, EXACT, find_centre=True)
    assert view.centre == pytest.approx((450.0, 260.0), abs=1e-4)
    assert view.focal_px == pytest.approx(FOCAL, rel=1e-6)


def test_of_two_directions_the_focal_length_is_that_of_the_formula() -> None:
    rng = np.random.default_rng(4)
    ends, axes = drawn(POSE, rng, (4, 4, 0))
    ends = ends + rng.normal(0, 0.1, ends.shape)
    first, second = (fit_vanishing_point(ends[axes == axis])[0] for axis in (0, 1))
    view = fit_view(ends, axes, SIZE, 0.1)
    assert view.focal_px == pytest.approx(focal_from_pair(first, second, CENTRE), rel=1e-4)
    for fitted, alone in zip(view.vanishing, (first, second), strict=False):
        np.testing.assert_allclose(fitted / fitted[2], alone / alone[2], atol=0.05)
    for axis in (0, 1):
        _, spread, _ = pixel_of(view.vanishing[axis], view.vanishing_covariances[axis])
        _, alone, _ = pixel_of(*fit_vanishing_point(ends[axes == axis], 0.1))
        np.testing.assert_allclose(spread, alone, rtol=1e-3)


def test_the_formula_is_that_of_the_text() -> None:
    assert focal_from_pair((50, 150, 1), (800, 150, 1), (200, 150)) == pytest.approx(300.0)
    assert focal_from_pair((50, 150, 1), (1, 0, 0), (200, 150)) == math.inf
    assert math.isnan(focal_from_pair((250, 150, 1), (800, 150, 1), (200, 150)))


def test_the_derivatives_are_those_of_small_steps() -> None:
    """By which the search converges, and the covariance is stated."""
    rng = np.random.default_rng(6)
    ends, axes = drawn(POSE, rng)
    ends = ends + rng.normal(0, 1, ends.shape)
    view = fit_view(ends, axes, SIZE, find_centre=True)

    def residuals(step: Floats) -> Floats:
        return line_residuals(ends, view.moved(step).vanishing[axes])[0]

    steps = 1e-6 * np.eye(6)
    J = np.stack([(residuals(step) - residuals(-step)) / 2e-6 for step in steps], axis=1)
    np.testing.assert_allclose(view.covariance, np.linalg.inv(J.T @ J), rtol=2e-3, atol=1e-9)
    slope = J.T @ residuals(np.zeros(6))
    slope[0] += log_focal(view) - math.log(view.diagonal)  # of what is known beforehand
    np.testing.assert_allclose(slope, 0.0, atol=0.05)


def test_the_focal_length_is_within_one_per_cent_for_twelve_lines_with_a_pixel_of_noise() -> None:
    """800 × 600 px, f = 560 px, four lines of 150 px or more along each axis; the median."""
    off, inside, errors = [], [], []
    for seed in range(100):
        rng = np.random.default_rng(seed)
        pose = some_pose(rng)
        ends, axes = drawn(pose, rng)
        view = fit_view(ends + rng.normal(0, 1, ends.shape), axes, SIZE, 1.0)
        error = view.spread(lambda view: np.array([log_focal(view), view.pitch, view.roll]))
        x, y, z = pose[:3, 2]
        truth = (math.log(FOCAL), math.atan2(-z, math.hypot(x, y)), math.atan2(-x, -y))
        deviation = np.array([log_focal(view), view.pitch, view.roll]) - truth
        off.append(np.abs(deviation))
        inside.append([np.abs(deviation) < error, np.abs(deviation) < 1.96 * error])
        errors.append(view.misfit / view.spare)
    assert np.median(off, axis=0)[0] < 0.01
    one, two = np.mean(inside, axis=0)
    assert ((one > 0.59) & (one < 0.78)).all()  # of 0.683
    assert ((two > 0.9) & (two < 0.99)).all()  # of 0.95
    assert np.mean(errors) == pytest.approx(1.0, abs=0.15)


def test_more_noise_says_more_error() -> None:
    ends, axes = drawn(POSE, np.random.default_rng(1))
    small, large = (fit_view(ends, axes, SIZE, sigma).spread(log_focal) for sigma in (1.0, 3.0))
    assert large == pytest.approx(3.0 * small, rel=1e-3)


@pytest.mark.parametrize("seed", range(4))
def test_a_view_with_one_vanishing_point_does_not_tell_the_focal_length(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ends, axes = drawn(pose_above_ground(1.5, 0.0, 0.0), rng)
    view = fit_view(ends + rng.normal(0, 1, ends.shape), axes, SIZE)
    assert view.spread(log_focal) > 0.5
    away = view.vanishing[1]
    np.testing.assert_allclose(away[:2] / away[2], CENTRE, atol=12.0)


def test_directions_that_no_camera_sees_at_right_angles_do_not_fit() -> None:
    def line(end: tuple[float, float], start: tuple[float, float]) -> Floats:
        return np.array([start, np.add(start, 0.4 * np.subtract(end, start))])

    first = [line((1200, 300), (200, y)) for y in (100, 250, 500)]
    second = [line((1500, 280), (300, y)) for y in (100, 350, 550)]
    view = fit_view([*first, *second], [0, 0, 0, 1, 1, 1], SIZE)
    assert view.misfit > 10 * max(view.spare, 1)


def test_a_picture_of_another_size_changes_only_the_units() -> None:
    rng = np.random.default_rng(3)
    ends, axes = drawn(POSE, rng)
    ends = ends + rng.normal(0, 1, ends.shape)
    view = fit_view(ends, axes, SIZE, 1.0)
    larger = fit_view(7.5 * (ends + 0.5) - 0.5, axes, (6000, 4500), 7.5)
    assert larger.focal_px == pytest.approx(7.5 * view.focal_px, rel=1e-6)
    np.testing.assert_allclose(larger.R, view.R, atol=1e-7)
    np.testing.assert_allclose(larger.covariance, view.covariance, rtol=1e-4, atol=1e-12)


@pytest.mark.parametrize(
    ("axes", "message"),
    [([0, 0, 0, 0], "two for two axes"), ([0, 0, 1, 3], "0, 1, 2"), ([0, 0, 0, 1], "two for two")],
)
def test_too_few_directions_are_refused(axes: list[int], message: str) -> None:
    ends, _ = drawn(POSE, np.random.default_rng(1), (2, 2, 0))
    with pytest.raises(ValueError, match=message):
        fit_view(ends, axes, SIZE)


def test_two_directions_with_one_vanishing_point_are_refused() -> None:
    ends, _ = drawn(POSE, np.random.default_rng(1), (2, 0, 0))
    with pytest.raises(ValueError, match="apart"):
        fit_view([*ends, *ends], [0, 0, 1, 1], SIZE)


def test_derivatives_by_small_steps_leave_out_what_does_not_vary() -> None:
    J = by_small_steps(lambda x: np.array([(2 + x[0]) * (3 + x[1]), x[0]]), 2)
    np.testing.assert_allclose(J, [[3.0, 2.0], [1.0, 0.0]], rtol=1e-9)
    J = by_small_steps(lambda x: np.array([x[0] + x[1]]), 2, np.diag([0.0, 1.0]))
    np.testing.assert_allclose(J, [[0.0, 1.0]], rtol=1e-9)


def test_the_error_of_ln_f_is_in_the_covariance() -> None:
    view = fit_view(*drawn(POSE, np.random.default_rng(1)), SIZE)
    assert view.spread(log_focal) == pytest.approx(math.sqrt(view.covariance[0, 0]), rel=1e-6)


def test_the_camera_is_the_one_that_took_the_picture() -> None:
    view = fit_view(*drawn(POSE, np.random.default_rng(9)), SIZE, EXACT)
    np.testing.assert_allclose(view.K, K, rtol=1e-6)
