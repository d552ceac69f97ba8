"""Quantiles beside NumPy's."""

import numpy as np
import pytest

from simulations.models.quantiles import quantile_of


@pytest.mark.parametrize("share", [0.0, 0.05, 0.5, 1.0])
def test_a_quantile_is_the_nearest_of_the_values_in_order(share: float) -> None:
    values = np.random.default_rng(0).normal(size=(7, 9))
    assert quantile_of(values, share) == np.percentile(values, 100 * share, method="nearest")
