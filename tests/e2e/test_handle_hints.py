"""A handle says what a hand does with it, and the first of a page moves once."""

import pytest
from playwright.sync_api import Browser, Locator, Page, expect
from support.reader import Reader, visit
from support.static_server import StaticServer

pytestmark = pytest.mark.browser

CHAPTER = "lens-distortion/"
FIRST = ".handle:not(.drag, .aim, [hidden])"


def hint_is_seen(handle: Locator) -> bool:
    seen: bool = handle.evaluate(
        "async handle => {"
        "  await Promise.all(handle.getAnimations({subtree: true}).map((one) => one.finished));"
        "  return getComputedStyle(handle, '::after').opacity === '1'; }"
    )
    return seen


def test_a_handle_says_what_a_hand_and_what_keys_do_and_pictures_have_the_names_of_their_panels(
    guest: Reader,
) -> None:
    page = guest.page
    guest.open(CHAPTER)
    page.mouse.move(0, 0)
    handle = page.locator(FIRST).first
    handle.scroll_into_view_if_needed()
    handle.hover()
    assert hint_is_seen(handle)
    assert str(handle.get_attribute("data-hint")).startswith("Drag the ")
    page.mouse.down()
    assert not hint_is_seen(handle)
    page.mouse.up()
    page.mouse.move(0, 0)
    page.keyboard.press("Tab")
    handle.focus()
    shown = handle.evaluate("handle => getComputedStyle(handle, '::after').content")
    assert "← →" in shown
    assert_pictures_are_named(page)


def assert_pictures_are_named(page: Page) -> None:
    pictures = page.get_by_role("img")
    canvases = page.locator("canvas.live")
    assert canvases.count() > 0
    for canvas in canvases.all():
        panel = canvas.locator("xpath=ancestor::*[@data-panel][1]")
        title = panel.locator(".panel-title").inner_text()
        expect(pictures.and_(canvas)).to_have_accessible_name(title)


def test_the_first_handle_of_a_page_moves_once_and_keeps_the_focus_after_a_drag_without_its_hint(
    brisk_chromium: Browser, server: StaticServer
) -> None:
    with visit(brisk_chromium, server) as reader:
        page = reader.page
        reader.open(CHAPTER)
        handle = page.locator(FIRST).first
        values = page.evaluate("location.search")
        handle.evaluate("handle => handle.scrollIntoView({block: 'center'})")
        expect(handle).to_contain_class("nudged")
        assert page.evaluate("location.search") == values
        handle.hover()
        page.mouse.down()
        page.mouse.up()
        page.mouse.move(0, 0)
        assert handle.evaluate("handle => handle === document.activeElement")
        assert not hint_is_seen(handle)
        page.keyboard.press("ArrowRight")
        assert hint_is_seen(handle)


@pytest.mark.deep
def test_the_first_handle_rests_where_less_motion_was_asked_for(
    brisk_chromium: Browser, server: StaticServer
) -> None:
    with visit(brisk_chromium, server, reduced_motion="reduce") as reader:
        reader.open(CHAPTER)
        handle = reader.page.locator(FIRST).first
        handle.evaluate("handle => handle.scrollIntoView({block: 'center'})")
        reader.page.wait_for_timeout(300)
        expect(handle).not_to_contain_class("nudged")
