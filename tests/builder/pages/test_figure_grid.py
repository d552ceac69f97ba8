"""Rows of controls and of numbers below a figure's panels."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.engine.controls import Action, Slider, Toggle
from site_builder.pages.figure_grid import (
    COLUMNS,
    cells_in_sight,
    even_columns,
    gather_buttons,
    spans,
)


@pytest.mark.parametrize(
    ("count", "most", "columns"),
    [(0, 4, 1), (1, 4, 1), (2, 2, 2), (3, 2, 2), (4, 4, 4), (5, 4, 3), (6, 4, 3), (7, 6, 4)],
)
def test_numbers_stand_in_few_rows_and_none_alone_where_that_can_be(
    count: int, most: int, columns: int
) -> None:
    assert even_columns(count, most) == columns


def test_buttons_that_follow_each_other_share_a_cell() -> None:
    slider = Slider(name="x", label="x", default=0.0, minimum=0.0, maximum=1.0, step=0.1)
    play = Action(name="play", labels=("Play",), drives="x", effect="play")
    reset = Action(name="reset", labels=("Reset",), drives="x", effect="reset")
    on, again = Toggle(name="on", label="On"), Action(name="again", labels=("Again",))
    cells = gather_buttons([slider, play, reset, on, again])
    assert cells == [(slider,), (play, reset), (on,), (again,)]


@pytest.mark.parametrize(
    ("places", "most", "expected"),
    [
        ([1] * 4, 1, [12] * 4),
        ([1] * 3, 2, [12, 6, 6]),
        ([1] * 4, 3, [6] * 4),
        ([1] * 7, 4, [4] * 3 + [3] * 4),
        ([1, 2], 3, [4, 8]),
        ([2, 1], 1, [12, 12]),
        ([1], 4, [6]),
        ([], 3, []),
    ],
)
def test_controls_stand_in_few_and_even_rows(
    places: list[int], most: int, expected: list[int]
) -> None:
    assert spans(places, most) == expected


@pytest.mark.parametrize(
    ("places", "in_sight"),
    [
        ([1] * 4, 4),
        ([1] * 6, 6),
        ([1] * 7, 4),
        ([1, 1, 1, 2, 1, 1, 2], 3),
        ([1, 2, 1, 1, 1], 2),
        ([1, 1, 2, 2], 4),
        ([], 0),
    ],
)
def test_first_controls_are_in_sight_and_no_fold_hides_a_single_row(
    places: list[int], in_sight: int
) -> None:
    assert cells_in_sight(places, 2) == in_sight


@given(st.lists(st.integers(1, 2), min_size=2, max_size=12), st.integers(1, 4))
def test_every_row_of_controls_is_full(places: list[int], most: int) -> None:
    left = 0
    for span in spans(places, most):
        left = left or COLUMNS
        assert span <= left, "a cell would start a new row before the old one is full"
        left -= span
    assert left == 0
