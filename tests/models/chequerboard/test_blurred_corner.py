"""The blurred corner, beside scipy's bivariate normal distribution."""

import numpy as np
import pytest
from scipy.stats import multivariate_normal, norm

from simulations.models.chequerboard.blurred_corner import blurred_corner, blurred_edge


@pytest.mark.parametrize("correlation", [0.0, 0.3, -0.7, 0.9])
def test_it_is_the_mean_of_the_product_of_two_signs(correlation: float) -> None:
    h, k = np.random.default_rng(0).normal(0.0, 1.5, (2, 40))
    law = multivariate_normal([0, 0], [[1, correlation], [correlation, 1]])
    both = np.array([law.cdf(pair) for pair in zip(h, k, strict=True)])
    oracle = 4 * both - 2 * norm.cdf(h) - 2 * norm.cdf(k) + 1
    assert np.abs(blurred_corner(h, k, correlation) - oracle).max() < 1e-6


def test_far_from_one_edge_only_the_other_remains() -> None:
    h = np.linspace(-3, 3, 13)
    assert np.abs(blurred_corner(h, 8.0, 0.5) - blurred_edge(h)).max() < 1e-6
    assert blurred_edge([-9.0, 0.0, 9.0]) == pytest.approx([-1, 0, 1], abs=1e-8)
