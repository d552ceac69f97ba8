"""On any width nothing but code has to be pushed sideways to be read."""

from typing import Any

import pytest
from support.reader import Reader

pytestmark = pytest.mark.browser

WIDTHS = (1440, 1000, 390, 360)
PUSHED_SIDEWAYS = """() => [...document.querySelectorAll("main *:not(pre)")]
  .filter((one) => ["auto", "scroll"].includes(getComputedStyle(one).overflowX))
  .filter((one) => one.scrollWidth > one.clientWidth + 1)
  .map((one) => `${one.className}: ${one.textContent.trim().slice(0, 40)}`)"""


def test_pages_tables_and_formulae_fit_every_width(plain_reader: Reader, book: Any) -> None:
    page = plain_reader.page
    for address in ["", *(chapter["url"] for chapter in book["chapters"])]:
        plain_reader.open(address, live=False)
        page.evaluate("document.fonts.ready")
        for width in WIDTHS:
            page.set_viewport_size({"width": width, "height": 800})
            where = f"{address or 'landing page'} at {width}"
            assert page.evaluate("document.documentElement.scrollWidth") <= width, where
            assert page.evaluate(PUSHED_SIDEWAYS) == [], where
