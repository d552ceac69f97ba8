"""Quantiles of numbers, without what NumPy's would load in the browser."""

import numpy as np

from simulations.models.arrays import Floats


def quantile_of(values: Floats, share: float = 0.5) -> float:
    """The value (...) that this share of all is below; by default the middle one.

    `np.median` and `np.percentile` would load all of `np.ma` in the browser. NaN counts as the
    largest. Raises `IndexError` if there are no values.
    """
    return float(np.sort(values, axis=None)[round(share * (values.size - 1))])
