"""A handle says what a hand does with it, and the first of a page moves once."""

import pytest
from playwright.sync_api import Browser, Locator, expect
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


def test_a_handle_that_is_pointed_at_says_what_to_do_and_is_quiet_while_dragged(
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


def test_a_handle_that_has_the_focus_of_the_keyboard_shows_its_keys(guest: Reader) -> None:
    guest.open(CHAPTER)
    handle = guest.page.locator(FIRST).first
    guest.page.keyboard.press("Tab")
    handle.focus()
    shown = handle.evaluate("handle => getComputedStyle(handle, '::after').content")
    assert "← →" in shown


def test_pictures_are_named_by_the_titles_of_their_panels(guest: Reader) -> None:
    guest.open(CHAPTER)
    pictures = guest.page.get_by_role("img")
    canvases = guest.page.locator("canvas.live")
    assert canvases.count() > 0
    for canvas in canvases.all():
        panel = canvas.locator("xpath=ancestor::*[@data-panel][1]")
        title = panel.locator(".panel-title").inner_text()
        expect(pictures.and_(canvas)).to_have_accessible_name(title)


@pytest.mark.parametrize("motion", ["no-preference", "reduce"])
def test_the_first_handle_of_a_page_moves_once_where_motion_is_welcome(
    chromium: Browser, server: StaticServer, motion: str
) -> None:
    with visit(chromium, server, reduced_motion=motion) as reader:
        reader.open(CHAPTER)
        handle = reader.page.locator(FIRST).first
        values = reader.page.evaluate("location.search")
        handle.evaluate("handle => handle.scrollIntoView({block: 'center'})")
        if motion == "reduce":
            reader.page.wait_for_timeout(300)
            expect(handle).not_to_have_class("nudged")
        else:
            expect(handle).to_contain_class("nudged")
        assert reader.page.evaluate("location.search") == values


def test_a_handle_that_was_dragged_keeps_the_focus_without_its_hint(
    chromium: Browser, server: StaticServer
) -> None:
    with visit(chromium, server) as reader:
        page = reader.page
        reader.open(CHAPTER)
        handle = page.locator(FIRST).first
        handle.scroll_into_view_if_needed()
        handle.hover()
        page.mouse.down()
        page.mouse.up()
        page.mouse.move(0, 0)
        assert handle.evaluate("handle => handle === document.activeElement")
        assert not hint_is_seen(handle)
        page.keyboard.press("ArrowRight")
        assert hint_is_seen(handle)
