"""Points on a lens: evenly spread, or with the moments of a uniform disc."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.lens.aperture import (
    fibonacci_disc,
    jittered_disc,
    random_disc,
    turned_disc,
)


@pytest.mark.parametrize("count", [1, 16, 500])
def test_every_ring_of_equal_area_holds_one_point_of_the_spiral(count: int) -> None:
    square = np.sum(fibonacci_disc(count) ** 2, axis=1)
    np.testing.assert_allclose(square, (np.arange(count) + 0.5) / count, rtol=1e-12)


def test_the_spiral_turns_by_the_golden_section_of_a_circle() -> None:
    points = fibonacci_disc(200)
    golden = (1 + math.sqrt(5)) / 2
    expected = np.exp(2j * np.pi * np.arange(200) / golden**2)
    np.testing.assert_allclose((points @ [1, 1j]) / np.hypot(*points.T), expected, atol=1e-10)


@pytest.mark.parametrize(
    ("draw", "count"),
    [
        (lambda rng: random_disc(300, (20, 30), rng), 300),
        (lambda rng: jittered_disc(15, 20, (20, 30), rng), 300),
    ],
    ids=["random", "jittered"],
)
def test_points_are_uniform_on_the_disc(
    draw: Callable[[np.random.Generator], Floats], count: int
) -> None:
    points = draw(np.random.default_rng(3))
    assert points.shape == (count, 2, 20, 30)
    assert points.dtype == np.float32
    square = np.sum(points**2, axis=1)
    assert square.max() <= 1 + 1e-6
    for power in (1, 2):  # E r^2k = 1 / (k + 1)
        assert np.mean(square**power) == pytest.approx(1 / (power + 1), abs=0.003)
    assert np.mean(points, axis=(0, 2, 3)) == pytest.approx([0, 0], abs=0.004)
    assert np.mean(points**2, axis=(0, 2, 3)) == pytest.approx([1 / 4, 1 / 4], abs=0.003)


def test_random_points_of_each_pixel_are_its_own() -> None:
    points = random_disc(2000, (2,), np.random.default_rng(0))
    assert abs(np.corrcoef(points[:, 0, 0], points[:, 0, 1])[0, 1]) < 0.08
    assert abs(np.corrcoef(points[:-1, 0, 0], points[1:, 0, 0])[0, 1]) < 0.08


def test_each_cell_of_the_lens_holds_one_jittered_point() -> None:
    points = jittered_disc(3, 5, (20, 30), np.random.default_rng(3))
    ring = np.floor(3 * np.sum(points**2, axis=1) * (1 - 1e-6))
    part = np.floor(5 * np.arctan2(points[:, 1], points[:, 0]) / (2 * np.pi)) % 5
    assert (np.sort(5 * ring + part, axis=0) == np.arange(15)[:, None, None]).mean() > 0.999
    assert len(np.unique(points[0, 0])) > 590


def test_a_spiral_is_turned_as_a_whole_and_for_each_pixel_by_another_angle() -> None:
    spiral = fibonacci_disc(7)
    points = turned_disc(spiral, (20, 30), np.random.default_rng(3)).astype(float)
    assert points.shape == (7, 2, 20, 30)
    np.testing.assert_allclose(
        np.hypot(*points.swapaxes(0, 1)),
        np.hypot(*spiral.T)[:, None, None] + np.zeros((20, 30)),
        atol=1e-6,
    )
    turns = ((points[:, 0] + 1j * points[:, 1]).T / (spiral @ [1, 1j])).T
    np.testing.assert_allclose(turns, turns[:1] + np.zeros_like(turns), atol=1e-5)
    assert len(np.unique(np.angle(turns[0]).round(3))) > 550
    assert abs(turns[0].mean()) < 0.1
