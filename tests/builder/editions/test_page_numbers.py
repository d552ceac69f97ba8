"""The numbers printed behind links are those of the pages that the links lead to."""

from xml.etree.ElementTree import fromstring

import pytest

from site_builder.editions.page_numbers import PageNumberError, fill
from site_builder.editions.pdf import UnsettledError, settle

NUMBER = "(p.\N{NO-BREAK SPACE}{page})"
TEXT = f'<p><span data-page-of="a"/> <span data-page-of="b" data-page-as="{NUMBER}"/></p>'


def test_each_number_is_that_of_its_anchor() -> None:
    text = fromstring(TEXT)
    fill(text, {"a": 7, "b": 42})
    assert "".join(text.itertext()) == "7 (p.\N{NO-BREAK SPACE}42)"


def test_an_anchor_on_no_page_is_named() -> None:
    with pytest.raises(PageNumberError, match="b"):
        fill(fromstring(TEXT), {"a": 7})


def test_the_book_is_set_again_until_its_numbers_are_its_own() -> None:
    """Here the numbers push a line onto the next page once they are known."""
    answers = iter([{"a": 1, "b": 2}, {"a": 1, "b": 3}, {"a": 1, "b": 3}])
    pdf = settle(fromstring(TEXT), lambda document: document, lambda _: next(answers))
    assert "(p.\N{NO-BREAK SPACE}3)" in pdf.decode()


def test_numbers_that_never_settle_are_no_book() -> None:
    pages = iter(range(1, 100))
    with pytest.raises(UnsettledError):
        settle(
            fromstring(TEXT), lambda document: document, lambda _: dict.fromkeys("ab", next(pages))
        )
