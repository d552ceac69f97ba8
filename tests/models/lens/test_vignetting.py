"""Vignetting, the overlap of two discs, and sample points on a lens."""

from collections.abc import Callable

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.lens.aperture import (
    aperture_grid,
    fibonacci_disc,
    jittered_disc,
    random_disc,
    turned_disc,
)
from simulations.models.lens.vignetting import disc_overlap_area, mechanical_vignetting


@pytest.mark.parametrize(
    ("tangent", "pupil", "rim", "separation", "share"),
    [
        ([0.0, 0.1, -0.1, 5.0, np.inf], 5.0, 6.0, 10.0, [1, 1, 1, 0, 0]),
        ([0.0], 5.0, 2.5, 10.0, [0.25]),  # a narrower rim stops the lens down
        ([0.0, 0.5], 5.0, 6.0, 0.5, [1, 1]),
        ([0.0, 1e300, np.inf, -np.inf, np.nan], 5.0, 4.0, 0.0, [0.64] * 4 + [np.nan]),
        ([0.1], 1e-40, 1.0, 1.0, [1]),
        ([0.1], 1e40, 1.0, 1.0, [0]),
    ],
)
def test_mechanical_vignetting_is_the_share_of_the_pupil_inside_the_rim(
    tangent: list[float], pupil: float, rim: float, separation: float, share: list[float]
) -> None:
    found = mechanical_vignetting(tangent, pupil, rim, separation)
    np.testing.assert_allclose(found, share, atol=1e-15)


def shared_area(apart: float, a: float, b: float) -> float:
    """Two sectors minus the kite between them, in long doubles."""
    d, one, two = np.longdouble(apart), np.longdouble(a), np.longdouble(b)
    along = (d * d + one * one - two * two) / (2 * d)
    half = np.sqrt(one * one - along * along)
    sectors = one * one * np.arctan2(half, along) + two * two * np.arctan2(half, d - along)
    return float(sectors - d * half)


@pytest.mark.parametrize("scale", [1e-60, 1.0, 1e60])
@pytest.mark.parametrize(
    ("apart", "a", "b"),
    [(1, 1, 1), (1e-5, 1, 1), (1.999, 1, 1), (4, 3, 2), (1.5, 2, 3), (4.9, 5, 0.5), (1e4, 1, 1e4)],
)
def test_overlap_of_two_discs_is_two_sectors_minus_a_kite(
    apart: float, a: float, b: float, scale: float
) -> None:
    found = disc_overlap_area([apart * scale, -apart * scale], a * scale, b * scale)
    assert found / scale**2 == pytest.approx([shared_area(apart, a, b)] * 2, rel=1e-9)
    smaller = np.pi * min(a, b) ** 2
    assert disc_overlap_area([0.0, 1e70], a, b) == pytest.approx([smaller, 0.0])


@pytest.mark.parametrize("cut", [-0.96875, 0.0, 0.9375])
def test_large_disc_overlaps_like_a_half_plane(cut: float) -> None:
    area = np.arccos(cut) - cut * np.sqrt(1 - cut * cut)
    assert disc_overlap_area(2.0**46 + cut, 1.0, 2.0**46) == pytest.approx(area, abs=1e-13)


@pytest.mark.parametrize("count", [1, 16, 500])
def test_each_ring_of_equal_area_holds_one_point_of_the_spiral(count: int) -> None:
    square = np.sum(fibonacci_disc(count) ** 2, axis=1)
    np.testing.assert_allclose(square, (np.arange(count) + 0.5) / count, rtol=1e-12)


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


def test_spiral_is_turned_by_a_different_angle_for_each_pixel() -> None:
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


@pytest.mark.parametrize("across", [2, 5, 8])
def test_grid_points_are_centres_of_square_cells_with_x_first(across: int) -> None:
    centres = (np.arange(across) + 0.5) * 2 / across - 1
    assert {round(x, 9) for point in aperture_grid(across) for x in point} <= {
        round(float(c), 9) for c in centres
    }
    first = aperture_grid(across)[0]  # the upper left of those inside: left of the centre, above
    assert first[1] == pytest.approx(centres[0])
    assert first[0] < 0
