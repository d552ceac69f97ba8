"""Pixels lie one apart, and as many on either side of the middle."""

import pytest

from simulations.models.pixel_grid import centred


@pytest.mark.parametrize(
    ("count", "places"), [(1, [0.0]), (3, [-1.0, 0.0, 1.0]), (4, [-1.5, -0.5, 0.5, 1.5])]
)
def test_a_row_of_pixels_is_counted_from_its_middle(count: int, places: list[float]) -> None:
    assert centred(count).tolist() == places
