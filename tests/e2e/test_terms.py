"""A term of the glossary tells its definition where it is first used."""

import pytest
from playwright.sync_api import Locator, expect
from support.reader import Reader

pytestmark = pytest.mark.browser

CHAPTER = "full-camera-model/"


def mark_and_definition(reader: Reader) -> tuple[Locator, Locator]:
    reader.open(CHAPTER, live=False)
    mark = reader.page.locator("#term-circle-of-confusion")
    return mark, reader.page.locator("#definition-circle-of-confusion")


def test_the_mouse_shows_it_and_may_rest_on_it(plain_reader: Reader) -> None:
    mark, definition = mark_and_definition(plain_reader)
    expect(definition).to_be_hidden()
    mark.hover()
    expect(definition).to_be_visible()
    expect(definition).to_be_in_viewport(ratio=1)
    definition.hover()
    plain_reader.page.wait_for_timeout(400)
    expect(definition).to_be_visible()
    plain_reader.page.mouse.move(2, 2)
    expect(definition).to_be_hidden()


def test_the_focus_shows_it_and_escape_puts_it_away(plain_reader: Reader) -> None:
    mark, definition = mark_and_definition(plain_reader)
    mark.evaluate("mark => mark.focus({ focusVisible: true })")
    expect(definition).to_be_visible()
    plain_reader.page.keyboard.press("Escape")
    expect(definition).to_be_hidden()
    expect(mark).to_be_focused()
    expect(mark).to_have_accessible_description(definition.text_content() or "")


def test_a_first_tap_shows_it_and_a_second_leads_to_the_glossary(plain_reader: Reader) -> None:
    mark, definition = mark_and_definition(plain_reader)
    tap = "mark => mark.dispatchEvent(new PointerEvent('click', TOUCH))".replace(
        "TOUCH", "{ pointerType: 'touch', bubbles: true, cancelable: true }"
    )
    assert mark.evaluate(tap) is False  # its default, to follow the link, is prevented
    expect(definition).to_be_visible()
    mark.evaluate(tap)
    plain_reader.page.wait_for_url("**/glossary/#circle-of-confusion")
    expect(plain_reader.page.locator("#circle-of-confusion")).to_be_in_viewport()
