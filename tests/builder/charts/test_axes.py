"""Honest axes: every value on them, in order, with readable ticks."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from site_builder.charts.axes import linear_axis, log_axis


@given(st.lists(st.floats(1e-15, 1e6), min_size=1, max_size=9))
def test_a_log_axis_holds_every_value_and_keeps_their_order(values: list[float]) -> None:
    axis = log_axis(values, 50.0, 446.0)
    places = [axis.position(value) for value in sorted(values)]
    assert places == sorted(places)
    assert all(50.0 < place < 446.0 for place in places)


@given(st.lists(st.floats(1e-15, 1e6), min_size=1, max_size=9))
def test_a_log_axis_has_a_readable_number_of_ticks_within_it(values: list[float]) -> None:
    axis = log_axis(values, 50.0, 446.0)
    ticks = [axis.position(value) for value, _ in axis.ticks()]
    assert 2 <= len(ticks) <= 10
    assert all(50.0 <= place <= 446.0 for place in ticks)
    assert len({label for _, label in axis.ticks()}) == len(ticks)


@given(st.lists(st.floats(-60.0, 120.0), min_size=1, max_size=9))
def test_a_linear_axis_has_a_readable_number_of_ticks_within_it(values: list[float]) -> None:
    axis = linear_axis(values, 270.0, 34.0)
    assert 2 <= len(axis.ticks()) <= 8
    assert all(34.0 <= axis.position(value) <= 270.0 for value, _ in axis.ticks())


def test_a_decade_is_as_long_anywhere_on_a_log_axis() -> None:
    axis = log_axis([0.01, 100.0], 0.0, 440.0)
    places = [axis.position(10.0**power) for power in (-2, -1, 0, 1, 2)]
    assert [b - a for a, b in pairwise(places)] == pytest.approx([100.0] * 4)
