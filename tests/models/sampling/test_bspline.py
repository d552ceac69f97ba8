"""Cubic B-splines against SciPy's, and against what a pre-filter has to undo."""

from typing import Literal

import numpy as np
import pytest
from scipy import ndimage
from scipy.interpolate import BSpline

from simulations.models.sampling.bspline import coefficients, weigh
from simulations.models.sampling.resampling import sample

RNG = np.random.default_rng(4)
PICTURE = RNG.normal(size=(33, 41))
ANYWHERE = np.stack((RNG.uniform(-0.5, 40.49, 500), RNG.uniform(-0.5, 32.49, 500)), axis=-1)


def test_the_bump_is_scipy_s() -> None:
    x = np.linspace(-2, 2, 401)
    oracle = BSpline.basis_element([-2, -1, 0, 1, 2], extrapolate=False)(x)
    np.testing.assert_allclose(weigh(x), np.nan_to_num(oracle), atol=1e-15)
    assert weigh(np.array([-1.0, 0.0, 1.0, 2.0, 7.0])) == pytest.approx([1 / 6, 4 / 6, 1 / 6, 0, 0])


@pytest.mark.parametrize("order", ["C", "F"])
def test_heights_are_scipy_s_where_the_border_is_far(order: Literal["C", "F"]) -> None:
    oracle = ndimage.spline_filter(np.pad(PICTURE, 30, mode="edge"), order=3, mode="mirror")
    ours = coefficients(np.pad(PICTURE, 2, mode="edge").astype(float, order=order))
    np.testing.assert_allclose(ours, oracle[28:-28, 28:-28], atol=1e-13)


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (2, 3), (5, 1), (40, 40)])
def test_bumps_of_these_heights_add_up_to_the_samples(shape: tuple[int, int]) -> None:
    samples = RNG.normal(size=shape)
    heights = coefficients(np.pad(samples, 1, mode="edge"))
    smoothed = ndimage.convolve1d(heights, [1 / 6, 4 / 6, 1 / 6], axis=0)
    smoothed = ndimage.convolve1d(smoothed, [1 / 6, 4 / 6, 1 / 6], axis=1)
    np.testing.assert_allclose(smoothed[1:-1, 1:-1], samples, atol=1e-13)


def test_values_between_pixels_are_scipy_s_at_the_border_too() -> None:
    x, y = ANYWHERE.T
    oracle = ndimage.map_coordinates(PICTURE, (y, x), order=3, mode="nearest")
    # SciPy lets the border repeat for twelve pixels and mirrors what lies beyond.
    np.testing.assert_allclose(sample(PICTURE, ANYWHERE, "spline"), oracle, atol=1e-6)
    inner = (np.abs(x - 20) < 15) & (np.abs(y - 16) < 12)
    np.testing.assert_allclose(
        sample(PICTURE, ANYWHERE[inner], "spline"), oracle[inner], atol=1e-12
    )
