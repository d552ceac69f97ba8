"""The zigzag order, and blocks cut off at a place of it."""

import numpy as np
import pytest

from simulations.models.compression.zigzag import RANK, ZIGZAG, first_in_order


def test_the_zigzag_starts_as_in_the_standard_and_visits_every_place() -> None:
    assert ZIGZAG[:10].tolist() == [0, 1, 8, 16, 9, 2, 3, 10, 17, 24]
    assert ZIGZAG[-3:].tolist() == [55, 62, 63]
    assert RANK.ravel()[ZIGZAG].tolist() == list(range(64))


@pytest.mark.parametrize("count", [1, 3, 63, 64])
def test_as_many_are_left_as_asked_for_and_they_are_the_first(count: int) -> None:
    codes = np.arange(1, 129).reshape(2, 8, 8)
    kept = first_in_order(codes, count)
    assert np.count_nonzero(kept, axis=(1, 2)).tolist() == [count, count]
    np.testing.assert_array_equal(
        kept.reshape(2, 64)[:, ZIGZAG[:count]], codes.reshape(2, 64)[:, ZIGZAG[:count]]
    )
