"""The first fall of a curve to a level."""

import numpy as np
import pytest

from simulations.models.sampling.first_fall import first_fall


def test_the_first_fall_lies_between_samples_and_before_later_ones() -> None:
    assert first_fall([0, 10, 20, 30, 40], [1, 0.75, 0.25, 0.75, 0], 0.5) == 15
    assert first_fall([0, 10, 20, 40], [1, 0.9, 0.4, 0.3], 0.5) == pytest.approx(18)
    assert first_fall([0, 10, 20], [1, 0.5, 0.7], 0.5) == 10
    assert first_fall([0, 10], [1, 0.6], 0.5) == np.inf
