"""Alternatives: one on show by mouse, keys, search and address; all of them on paper."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect
from support.reader import Reader, visit
from support.static_server import serving

pytestmark = pytest.mark.browser

INSIDE = "Half a wave later they disagree."
ON_PAPER = {
    "By hand": "Multiply out the product",
    "By phase": INSIDE,
    "By ear": "it throbs.",
}


@pytest.fixture(scope="module")
def visitor(waves_site: Path, chromium: Browser) -> Iterator[Reader]:
    with (
        serving(waves_site) as server,
        visit(chromium, server, "delete globalThis.WebAssembly") as someone,
    ):
        yield someone


@pytest.fixture
def reader(visitor: Reader) -> Iterator[Reader]:
    visitor.begin_anew()
    visitor.open("beats/", live=False)
    yield visitor
    visitor.assert_no_complaints()


def test_the_first_is_on_show_until_another_is_chosen(reader: Reader) -> None:
    tabs = reader.page.get_by_role("tab")
    assert tabs.all_inner_texts() == ["By hand", "By phase", "By ear"]
    expect(reader.page.get_by_role("tabpanel", name="By hand")).to_be_visible()
    tabs.nth(1).click()
    expect(reader.page.get_by_role("tabpanel", name="By phase")).to_be_visible()
    expect(reader.page.get_by_text(ON_PAPER["By hand"])).to_be_hidden()
    expect(tabs.nth(1)).to_have_attribute("aria-selected", "true")


def test_arrow_keys_home_and_end_choose_and_one_tab_is_in_the_order(reader: Reader) -> None:
    tabs = reader.page.get_by_role("tab")
    tabs.first.focus()
    for key, chosen in (("ArrowLeft", 2), ("ArrowRight", 0), ("End", 2), ("Home", 0)):
        reader.page.keyboard.press(key)
        expect(tabs.nth(chosen)).to_be_focused()
        expect(tabs.nth(chosen)).to_have_attribute("aria-selected", "true")
    assert reader.page.locator("[role=tab][tabindex='0']").count() == 1


def test_an_address_inside_opens_its_alternative(reader: Reader) -> None:
    reader.page.evaluate("location.hash = 'index-interference'")
    expect(reader.page.get_by_text(INSIDE)).to_be_in_viewport()
    expect(reader.page.get_by_role("tab").nth(1)).to_have_attribute("aria-selected", "true")


def test_all_stand_on_paper_with_their_titles(reader: Reader) -> None:
    reader.page.emulate_media(media="print")
    for title, words in ON_PAPER.items():
        expect(reader.page.locator(".tab-title", has_text=title)).to_be_visible()
        expect(reader.page.get_by_text(words)).to_be_visible()
    expect(reader.page.get_by_role("tablist")).to_be_hidden()
    reader.page.emulate_media(media="screen")
