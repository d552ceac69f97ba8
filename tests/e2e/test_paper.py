"""A page as it is printed."""

from collections.abc import Iterator

import pytest
from support.reader import Reader

pytestmark = pytest.mark.browser

RIGHT_EDGES = """
table => [...table.querySelectorAll("tr")]
  .map(row => [...row.querySelectorAll(".number")]
    .filter(cell => cell.getClientRects().length)
    .map(cell => Math.round(cell.getBoundingClientRect().right)))
  .filter(row => row.length)
"""


@pytest.fixture
def paper(plain_reader: Reader) -> Iterator[Reader]:
    yield plain_reader
    plain_reader.page.emulate_media(media="screen")


def test_what_was_answered_is_printed_as_a_question(paper: Reader) -> None:
    paper.open("lens-distortion/", live=False)
    question = paper.page.locator("form.quiz[data-kind=single]").first
    question.locator("input[name=answer]").first.check()
    question.locator("button[type=submit]").click()
    assert question.locator(".feedback").is_visible()
    paper.page.emulate_media(media="print")
    assert not question.locator(".feedback").is_visible()
    assert question.locator(".option:visible").count() > 1


def test_numbers_of_a_ladder_stand_below_their_headings(paper: Reader) -> None:
    paper.open("speed-and-accuracy/", live=False)
    paper.page.set_viewport_size({"width": 640, "height": 900})  # an A4 page within its margins
    paper.page.emulate_media(media="print")
    tables = paper.page.locator(".ladder table")
    assert tables.count()
    for table in tables.all():
        heading, *rows = _joined_heading(table.evaluate(RIGHT_EDGES))
        assert rows
        assert rows == [heading] * len(rows)


def _joined_heading(rows: list[list[int]]) -> list[list[int]]:
    """The two rows of the heading, that of the times last, as one."""
    errors, times, *rest = rows
    return [errors + times, *rest]
