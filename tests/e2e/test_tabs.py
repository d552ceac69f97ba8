"""Alternatives: one on show by mouse, keys, search and address; all of them on paper."""

import pytest
from playwright.sync_api import expect
from support.reader import Reader

pytestmark = pytest.mark.browser

GROUP = """
<div class="tabs">
  <section class="tab" id="tab-hand"><p class="tab-title">By hand</p><p>Multiply.</p></section>
  <section class="tab" id="tab-code"><p class="tab-title">By <em>code</em></p>
    <p id="inside">Call it.</p></section>
  <section class="tab" id="tab-eye"><p class="tab-title">By eye</p><p>Look.</p></section>
</div>
"""
INSERT = """async (html) => {
  document.querySelector("article").insertAdjacentHTML("afterbegin", html);
  const main = document.querySelector("script[type=module][src]").src;
  (await import(new URL("page/tabs.js", main))).arrangeTabs();
}"""


@pytest.fixture
def reader(plain_reader: Reader) -> Reader:
    plain_reader.open("connections/", live=False)
    plain_reader.page.evaluate(INSERT, GROUP)
    return plain_reader


def test_the_first_is_on_show_until_another_is_chosen(reader: Reader) -> None:
    tabs = reader.page.get_by_role("tab")
    assert tabs.all_inner_texts() == ["By hand", "By code", "By eye"]
    expect(reader.page.get_by_role("tabpanel", name="By hand")).to_be_visible()
    tabs.nth(1).click()
    expect(reader.page.get_by_role("tabpanel", name="By code")).to_be_visible()
    expect(reader.page.locator("#tab-hand")).to_be_hidden()
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
    reader.page.evaluate("location.hash = 'inside'")
    expect(reader.page.locator("#inside")).to_be_in_viewport()
    expect(reader.page.get_by_role("tab").nth(1)).to_have_attribute("aria-selected", "true")


def test_all_stand_on_paper_with_their_titles(reader: Reader) -> None:
    reader.page.emulate_media(media="print")
    for title, words in (("By hand", "Multiply."), ("By code", "Call it."), ("By eye", "Look.")):
        expect(reader.page.locator(".tab-title", has_text=title)).to_be_visible()
        expect(reader.page.get_by_text(words, exact=True)).to_be_visible()
    expect(reader.page.get_by_role("tablist")).to_be_hidden()
    reader.page.emulate_media(media="screen")
