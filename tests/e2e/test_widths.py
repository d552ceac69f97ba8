"""No page has to be pushed sideways; what is too wide for one has a box of its own."""

from pathlib import Path
from typing import Any

import pytest
from support.reader import Reader

pytestmark = pytest.mark.browser

PUSHED_SIDEWAYS = """() => [...document.querySelectorAll("main *:not(pre, .panels)")]
  .filter((one) => ["auto", "scroll"].includes(getComputedStyle(one).overflowX))
  .filter((one) => one.scrollWidth > one.clientWidth + 1)
  .map((one) => `${one.className}: ${one.textContent.trim().slice(0, 40)}`)"""

OUT_OF_REACH = """() => [...document.querySelectorAll("main *")]
  .filter((one) => ["auto", "scroll"].includes(getComputedStyle(one).overflowX))
  .filter((one) => one.scrollWidth > one.clientWidth + 1 && one.tabIndex < 0)
  .map((one) => `${one.className}: ${one.textContent.trim().slice(0, 40)}`)"""

LARGER_LETTERS = """html { font-size: 34px !important; }"""
"""Twice those of a phone, as a reader may set them without enlarging the rest."""


@pytest.mark.parametrize(
    "widths", [(320, 1440), pytest.param((1000, 390, 360), marks=pytest.mark.deep)]
)
def test_pages_tables_and_formulae_fit_the_window(
    plain_reader: Reader, book: Any, widths: tuple[int, ...]
) -> None:
    """And what does scroll, on the widest and on the narrowest, is reached by keyboard."""
    page = plain_reader.page
    for address in plain_reader.leaf_through(
        [
            *("", "references/", "lecture-plan/", "glossary/", "symbols/", "index-of-terms/"),
            *(chapter["url"] for chapter in book["chapters"]),
        ]
    ):
        for width in widths:
            page.set_viewport_size({"width": width, "height": 800})
            where = f"{address or 'landing page'} at {width}"
            assert page.evaluate("document.documentElement.scrollWidth") <= width, where
            assert width < 360 or page.evaluate(PUSHED_SIDEWAYS) == [], where
            if width in (320, 1440):
                page.wait_for_function(f"({OUT_OF_REACH})().length === 0")


@pytest.mark.deep
def test_pages_of_source_fit_a_narrow_screen(plain_reader: Reader, built_site: Path) -> None:
    plain_reader.page.set_viewport_size({"width": 320, "height": 740})
    for page in sorted((built_site / "source").rglob("index.html")):
        address = page.parent.relative_to(built_site).as_posix() + "/"
        plain_reader.open(address, live=False)
        width = plain_reader.page.evaluate("document.documentElement.scrollWidth")
        assert width <= 320, f"{address} is {width} wide"


@pytest.mark.deep
def test_no_chapter_scrolls_sideways_with_letters_twice_as_large(
    plain_reader: Reader, book: Any
) -> None:
    plain_reader.page.set_viewport_size({"width": 390, "height": 800})
    urls = (chapter["url"] for chapter in book["chapters"])
    for address in plain_reader.leaf_through(["", "references/", "lecture-plan/", *urls]):
        plain_reader.page.add_style_tag(content=LARGER_LETTERS)
        width = plain_reader.page.evaluate("document.documentElement.scrollWidth")
        assert width <= 390, f"{address} is {width} wide"
