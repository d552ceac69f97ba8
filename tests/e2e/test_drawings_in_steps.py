"""A drawing in steps: it grows in place with each step, and is complete on paper."""

import re

import pytest
from playwright.sync_api import Locator, expect
from support.reader import Reader

pytestmark = pytest.mark.browser


def state(drawing: Locator) -> tuple[int, int]:
    """The step whose sentence is visible, and the last step whose marks are visible."""
    sentences, marks = drawing.locator(".step-words"), drawing.locator("svg > [class^=step-]")
    read = [at for at, each in enumerate(sentences.all(), start=1) if each.is_visible()]
    seen = [at for at, each in enumerate(marks.all(), start=2) if each.is_visible()]
    assert len(read) == 1
    assert seen == [*range(2, len(seen) + 2)]
    return read[0], len(seen) + 1


def test_drawing_grows_step_by_step_and_is_complete_on_paper(plain_reader: Reader) -> None:
    plain_reader.open("lens-distortion/", live=False)
    page, drawing = plain_reader.page, plain_reader.page.locator("#figure-lensmaker")
    radio = drawing.get_by_role("radio")
    drawing.scroll_into_view_if_needed()
    place = drawing.bounding_box()
    assert state(drawing) == (1, 1)
    drawing.get_by_text("Next step").locator("visible=true").click()
    assert state(drawing) == (2, 2)
    page.keyboard.press("ArrowRight")
    assert state(drawing) == (3, 3)
    drawing.locator("svg").click(force=True)  # the label over it takes the press
    assert state(drawing) == (4, 4)
    drawing.get_by_text("Back").locator("visible=true").click()
    assert state(drawing) == (3, 3)
    radio.last.check()
    assert state(drawing) == (5, 5)
    expect(radio.last).to_have_accessible_description(re.compile("equals"))  # formulae, too
    assert drawing.bounding_box() == place
    radio.first.check()
    page.emulate_media(media="print")
    assert all(each.is_visible() for each in drawing.locator(".step-words, svg > g").all())
    assert not any(each.is_visible() for each in drawing.locator("input, label").all())
    page.emulate_media(media="null")
