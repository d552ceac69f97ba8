"""Defocus as a filter: Gaussian bins against scipy, gathered discs against their definition."""

import numpy as np
import pytest
import scipy.ndimage

from simulations.models.arrays import Floats
from simulations.models.lens.screen_blur import binned_gaussian, gather_discs

NOISE = np.random.default_rng(1).random((3, 40, 50)).astype(np.float32)


def gaussian(planes: Floats, sigma: float) -> Floats:
    return np.array([scipy.ndimage.gaussian_filter(plane, sigma, truncate=4) for plane in planes])


def test_each_pixel_takes_the_nearest_of_evenly_spaced_blurs() -> None:
    radius = np.zeros((40, 50))
    radius[:, 10:20], radius[:, 20:30], radius[:, 30:] = 0.9, 1.7, 4.0
    blurred = binned_gaussian(NOISE, radius, bins=3)  # of radius 0, 2 and 4
    np.testing.assert_array_equal(blurred[..., :20], NOISE[..., :20])
    np.testing.assert_allclose(blurred[..., 20:30], gaussian(NOISE, 1.0)[..., 20:30], atol=1e-5)
    np.testing.assert_allclose(blurred[..., 30:], gaussian(NOISE, 2.0)[..., 30:], atol=1e-5)


def test_a_blur_of_less_than_a_pixel_is_its_own_widest() -> None:
    point = np.zeros((1, 9, 9), np.float32)
    point[0, 4, 4] = 1
    along = binned_gaussian(point, np.full((9, 9), 0.8), bins=2)[0].sum(axis=0)
    assert along @ (np.arange(9) - 4) ** 2 == pytest.approx(0.4**2, rel=1e-3)


def test_in_focus_everywhere_nothing_changes() -> None:
    np.testing.assert_array_equal(binned_gaussian(NOISE, np.zeros((40, 50))), NOISE)
    np.testing.assert_allclose(
        gather_discs(NOISE, np.zeros((40, 50)), np.ones((40, 50))), NOISE, rtol=1e-6
    )


def test_gathering_weighs_neighbours_by_their_discs_and_holds_back_those_behind() -> None:
    """Word for word from the definition, one pixel and one neighbour at a time."""
    rng = np.random.default_rng(5)
    light = rng.random((2, 6, 8)).astype(np.float32)
    radius, depth = rng.uniform(0.2, 3.0, (6, 8)), rng.integers(1, 4, (6, 8)).astype(float)
    expected = np.zeros_like(light)
    for y, x in np.ndindex(6, 8):
        total = weights = 0.0
        for v, u in np.ndindex(14, 16):
            at = min(max(v - 4, 0), 5), min(max(u - 4, 0), 7)
            own, spread = max(radius[y, x], 0.5), max(radius[at], 0.5)
            if depth[at] > depth[y, x]:
                spread = min(spread, own)
            away = np.hypot(v - 4 - y, u - 4 - x)
            weight = min(max(spread + 0.5 - away, 0.0), 1.0) / spread**2
            total, weights = total + weight * light[:, at[0], at[1]], weights + weight
        expected[:, y, x] = total / weights
    np.testing.assert_allclose(gather_discs(light, radius, depth), expected, atol=1e-5)


def test_the_widest_blur_is_legal_and_leaves_one_grey() -> None:
    """So wide that of a picture reflected at its borders only the mean is left."""
    plane = np.linspace(0.0, 1.0, 64, dtype=np.float32).reshape(1, 8, 8)
    blurred = binned_gaussian(plane, np.full((8, 8), 1024.0))
    np.testing.assert_allclose(blurred, 0.5, atol=1e-5)
