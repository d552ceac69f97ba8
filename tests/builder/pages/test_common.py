"""What all pages share is put into each where it has a place for it."""

from dataclasses import replace

import pytest

from site_builder.pages.common import BEFORE, BEHIND, STYLES, Common
from site_builder.pages.places import Card

COMMON = Common(b"p {}", [b"one ", b"two ", b"three "], {"one": 0, "two": 1, "three": 2})
CARD = Card("two", "two/", "2", "Chapter 2", "Two", "")
PAGE = f"<style>{STYLES}</style><ol>{BEFORE}TWO {BEHIND}</ol>".encode()


@pytest.mark.parametrize(
    ("chapter", "entries"),
    [("one", "TWO two three "), ("two", "one TWO three "), ("three", "one two TWO ")],
)
def test_a_chapter_stands_between_the_entries_of_the_others(chapter: str, entries: str) -> None:
    page = COMMON.put_into(PAGE, replace(CARD, id=chapter))
    assert page.decode() == f"<style>p {{}}</style><ol>{entries}</ol>"


def test_a_page_that_is_no_chapter_has_the_entries_of_all() -> None:
    page = f"<ol>{BEFORE}{BEHIND}</ol>".encode()
    assert COMMON.put_into(page, None) == b"<ol>one two three </ol>"


def test_a_page_without_a_place_is_as_it_was() -> None:
    assert COMMON.put_into(b"<p>Not found.</p>", None) == b"<p>Not found.</p>"
