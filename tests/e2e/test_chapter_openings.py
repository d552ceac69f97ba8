"""A chapter opens near something to do, and says in one line what it takes."""

from typing import Any

import pytest
from playwright.sync_api import expect
from support.reader import Reader

pytestmark = pytest.mark.browser

SCREENS = 2
SIZES = (pytest.param(1440, 900, marks=pytest.mark.deep), (390, 844))
TOP = "document.querySelector('simulation-figure .panels').getBoundingClientRect().top + scrollY"


@pytest.mark.parametrize(("width", "height"), SIZES, ids=["laptop", "phone"])
def test_every_chapter_has_a_figure_within_two_screens(
    plain_reader: Reader, book: Any, width: int, height: int
) -> None:
    plain_reader.page.set_viewport_size({"width": width, "height": height})
    urls = [chapter["url"] for chapter in book["chapters"] if chapter["simulations"]]
    far = {}
    for url in plain_reader.leaf_through(urls):
        screens = plain_reader.page.evaluate(TOP) / height
        if screens > SCREENS:
            far[url] = round(screens, 1)
    assert not far


def test_what_a_chapter_asks_and_gives_is_a_line_that_opens(plain_reader: Reader) -> None:
    page = plain_reader.page
    plain_reader.open("lens-distortion/", live=False)
    facts = page.locator(".chapter-facts")
    need = facts.locator('.before a[href$="perspective-projection/"]')
    expect(need).to_be_hidden()
    expect(facts.locator("summary")).to_contain_text("3")
    facts.locator("summary").press("Enter")
    expect(need).to_be_visible()
    expect(facts.locator(".after li").first).to_be_visible()


def test_every_part_of_a_long_chapter_has_a_figure_within_a_screen(plain_reader: Reader) -> None:
    plain_reader.page.set_viewport_size({"width": 1440, "height": 900})
    plain_reader.open("digital-sensor/", live=False)
    away = """(parts) => parts.map((part) => Math.min(
      ...[...document.querySelectorAll('figure.simulation')].map((figure) => {
        const { top, bottom } = figure.getBoundingClientRect();
        const here = part.getBoundingClientRect().top;
        return Math.max(top - here, here - bottom);
      })))"""
    distances = plain_reader.page.locator("h2[id^=part-]").evaluate_all(away)
    assert len(distances) == 3
    assert max(distances) < 900
