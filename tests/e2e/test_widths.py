"""On any width nothing but code has to be pushed sideways to be read."""

from typing import Any

import pytest
from support.reader import Reader

pytestmark = pytest.mark.browser

PUSHED_SIDEWAYS = """() => [...document.querySelectorAll("main *:not(pre)")]
  .filter((one) => ["auto", "scroll"].includes(getComputedStyle(one).overflowX))
  .filter((one) => one.scrollWidth > one.clientWidth + 1)
  .map((one) => `${one.className}: ${one.textContent.trim().slice(0, 40)}`)"""


@pytest.mark.parametrize("width", [1440, 1000, 390, 360])
def test_tables_and_formulae_fit_the_page(plain_reader: Reader, book: Any, width: int) -> None:
    plain_reader.page.set_viewport_size({"width": width, "height": 800})
    for chapter in book["chapters"]:
        plain_reader.open(chapter["url"], live=False)
        plain_reader.page.evaluate("document.fonts.ready")
        assert plain_reader.page.evaluate(PUSHED_SIDEWAYS) == [], chapter["id"]
