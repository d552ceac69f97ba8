"""A hand on a handle that is asked much. That all can be grabbed: `test_figures_live.py`."""

import math
from typing import Any

import pytest
from support.hands import middle
from support.reader import Reader

pytestmark = pytest.mark.browser


@pytest.mark.long
def test_a_handle_stays_under_the_pointer_and_ends_at_the_last_of_many_moves(
    visitor: Reader, book: Any
) -> None:
    figure = visitor.turn_to_figure(book, "lambertian-shading")
    grip = figure.locator('[data-handle="probe"]')
    visitor.bring(grip)
    start = middle(grip)
    end = (start[0] + 60, start[1])
    page = visitor.page
    page.mouse.move(*start)
    page.mouse.down()
    for step in range(200):
        page.mouse.move(start[0] + 90 * math.sin(step / 9), start[1])
    page.mouse.move(*end)
    page.mouse.up()
    visitor.settle(figure)
    assert middle(grip)[0] == pytest.approx(end[0], abs=2)
