"""The frame around a chapter: its header, its sections, its keys."""

from typing import Any

import pytest
from playwright.sync_api import expect
from support.reader import Reader

pytestmark = pytest.mark.browser

SCROLL_TO = "top => scrollTo({top, behavior: 'instant'})"
SIZES = ((1440, 900), (1024, 768), (320, 640))


def chapter_with_sections(book: Any) -> str:
    url: str = book["chapters"][4]["url"]
    return url


def test_on_a_phone_the_sections_are_in_a_fold_and_the_header_leaves_and_comes_back(
    plain_reader: Reader, book: Any
) -> None:
    page = plain_reader.page
    page.set_viewport_size({"width": 390, "height": 800})
    plain_reader.open(chapter_with_sections(book), live=False)
    for top, away in ((1500, True), (1300, False), (1600, True), (0, False)):
        page.evaluate(SCROLL_TO, top)
        page.wait_for_function(
            "away => document.querySelector('.site-header').classList.contains('away') === away",
            arg=away,
        )
    box = page.locator(".site-header").bounding_box()
    assert box
    assert box["height"] <= 48
    fold = page.locator("details.on-this-page")
    expect(fold.locator("a").first).to_be_hidden()
    fold.locator("summary").click()
    last = fold.locator("a").last
    target = (last.get_attribute("href") or "").removeprefix("#")
    last.click()
    expect(page.locator(f"#{target}")).to_be_in_viewport()


def test_the_section_that_is_read_is_marked_and_the_header_tells_how_far_one_is(
    plain_reader: Reader, book: Any
) -> None:
    page = plain_reader.page
    plain_reader.open(chapter_with_sections(book), live=False)
    read = "Number(document.querySelector('.site-header').style.getPropertyValue('--read'))"
    assert page.evaluate(read) == 0
    page.evaluate(SCROLL_TO, page.evaluate("document.querySelector('article').scrollHeight / 2"))
    page.wait_for_function(f"{read} > 0.4 && {read} < 0.7")
    links = page.locator("#contents .sections a")
    for link in (links.nth(2), links.nth(5), links.nth(2)):
        link.click()
        expect(link).to_have_attribute("aria-current", "location")
        assert page.locator("#contents .sections a[aria-current]").count() == 1
    page.evaluate(SCROLL_TO, 1e6)  # past all headings
    expect(links.last).to_have_attribute("aria-current", "location")
    page.wait_for_function(f"{read} === 1")


def test_the_header_is_one_slim_line_at_every_width(plain_reader: Reader, book: Any) -> None:
    header = plain_reader.page.locator(".site-header")
    for address in ("", chapter_with_sections(book)):
        plain_reader.open(address, live=False)
        for width, height in SIZES:
            plain_reader.page.set_viewport_size({"width": width, "height": height})
            box = header.bounding_box()
            assert box
            assert box["height"] <= 48, width
            assert header.evaluate("header => header.scrollWidth <= header.clientWidth"), width
            expect(header.locator("button[data-search]")).to_be_in_viewport(ratio=1)


def test_keys_turn_the_page_and_open_the_card_and_can_be_turned_off(
    visitor: Reader, book: Any
) -> None:
    chapters, keyboard = book["chapters"], visitor.page.keyboard
    visitor.turn_to(chapters[9]["url"], live=False)
    keyboard.press("]")
    visitor.page.wait_for_url(visitor.root + chapters[10]["url"])
    keyboard.press("[")
    visitor.page.wait_for_url(visitor.root + chapters[9]["url"])
    keyboard.press("?")
    card = visitor.page.locator("dialog.keys")
    expect(card).to_be_visible()
    keyboard.press("Escape")
    expect(card).to_be_hidden()
    visitor.page.locator("button[data-keys]").click()
    expect(card).to_be_visible()
    card.get_by_role("checkbox").uncheck()
    keyboard.press("Escape")
    keyboard.press("/")
    assert visitor.page.locator("dialog[open]").count() == 0
    visitor.page.locator("button[data-keys]").click()
    card.get_by_role("checkbox").check()
    keyboard.press("Escape")
    keyboard.press("/")
    expect(visitor.page.locator("dialog.search")).to_be_visible()
    keyboard.press("Escape")


def test_keys_are_letters_where_one_types(visitor: Reader, book: Any) -> None:
    url = next(
        chapter["url"]
        for chapter in book["chapters"]
        for quiz in book["quizzes"]
        if quiz["chapter"] == chapter["id"] and quiz["kind"] == "number"
    )
    visitor.turn_to(url, live=False)
    visitor.page.locator(".number-answer > input:visible").first.focus()
    for key in ("/", "]", "?"):
        visitor.page.keyboard.press(key)
    assert visitor.page.locator("dialog[open]").count() == 0
    assert visitor.page.url == visitor.root + url
