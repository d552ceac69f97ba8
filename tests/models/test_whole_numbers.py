"""Whole numbers are taken, and everything else is refused by name."""

import numpy as np
import pytest

from simulations.models.whole_numbers import as_whole


@pytest.mark.parametrize("value", [3, 3.0, np.int64(3), np.float32(3)])
def test_whole_numbers_of_any_type_become_ints(value: float) -> None:
    assert as_whole("count", value, 1, 3) == 3
    assert type(as_whole("count", value, 1)) is int


@pytest.mark.parametrize("value", [0, 4, 2.5, -1, np.nan, np.inf, -np.inf])
def test_the_rest_is_refused_with_the_range(value: float) -> None:
    with pytest.raises(ValueError, match=f"count {value}; legal: whole numbers, 1 to 3"):
        as_whole("count", value, 1, 3)


def test_a_range_may_be_open_above() -> None:
    assert as_whole("count", 10**9, 1) == 10**9
    with pytest.raises(ValueError, match="count 0; legal: whole numbers, 1 or more"):
        as_whole("count", 0, 1)
