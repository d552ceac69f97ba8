"""A term of the glossary tells its definition where it is first used."""

import pytest
from playwright.sync_api import expect
from support.reader import Reader

pytestmark = pytest.mark.browser

CHAPTER = "full-camera-model/"


TAP = """mark => mark.dispatchEvent(new PointerEvent('click',
  {pointerType: 'touch', bubbles: true, cancelable: true}))"""


def test_mouse_focus_and_a_first_tap_show_it_and_a_second_leads_to_the_glossary(
    plain_reader: Reader,
) -> None:
    plain_reader.open(CHAPTER, live=False)
    mark = plain_reader.page.locator("#term-circle-of-confusion")
    definition = plain_reader.page.locator("#definition-circle-of-confusion")
    expect(definition).to_be_hidden()
    mark.hover()
    expect(definition).to_be_visible()
    expect(definition).to_be_in_viewport(ratio=1)
    definition.hover()
    plain_reader.page.wait_for_timeout(400)
    expect(definition).to_be_visible()
    plain_reader.page.mouse.move(2, 2)
    expect(definition).to_be_hidden()
    mark.evaluate("mark => mark.focus({ focusVisible: true })")
    expect(definition).to_be_visible()
    plain_reader.page.keyboard.press("Escape")
    expect(definition).to_be_hidden()
    expect(mark).to_be_focused()
    expect(mark).to_have_accessible_description(definition.text_content() or "")
    assert mark.evaluate(TAP) is False  # its default, to follow the link, is prevented
    expect(definition).to_be_visible()
    mark.evaluate(TAP)
    plain_reader.page.wait_for_url("**/glossary/#circle-of-confusion")
    expect(plain_reader.page.locator("#circle-of-confusion")).to_be_in_viewport()
