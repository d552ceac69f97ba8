"""Words, symbols, readouts and controls that have to do with one another show it."""

import pytest
from playwright.sync_api import expect
from support.reader import Reader

pytestmark = pytest.mark.browser

LIT = "document.querySelector('article').dataset.lit ?? null"


def test_coloured_words_and_symbols_light_up_and_are_no_stops_of_the_keyboard(
    plain_reader: Reader,
) -> None:
    plain_reader.open("perspective-projection/", live=False)
    page = plain_reader.page
    symbol = page.locator('main math [class^="role-"]').first
    symbol.hover()
    page.wait_for_function(f"{LIT} === '{str(symbol.get_attribute('class'))[5:]}'")
    assert page.locator('main :is(span, math *)[class^="role-"][tabindex]').count() == 0


def test_a_word_lights_the_control_that_moves_what_it_names(plain_reader: Reader) -> None:
    plain_reader.open("lighting-and-reflectance/", live=False)
    figure = plain_reader.figure("phong")
    word = plain_reader.page.locator(":is(figcaption, .figure-caption) .role-light").first
    word.hover()
    expect(figure.locator(".control.driven [name=light_angle]")).to_have_count(1)
    plain_reader.page.mouse.move(0, 0)
    expect(figure.locator(".control.driven")).to_have_count(0)


def test_numbers_that_a_control_changes_are_marked_until_the_hand_rests(visitor: Reader) -> None:
    visitor.turn_to("lens-distortion/")
    figure = visitor.figure("lens-distortion")
    visitor.settle(figure)
    marked = figure.locator(".readout[data-moved] output")
    frames = visitor.frames(figure)
    figure.evaluate("""(figure) => {
      window.marked = new Set();
      figure.addEventListener('painted', () => {
        for (const item of figure.querySelectorAll('.readout[data-moved] output')) {
          window.marked.add(item.name);
        }
      });
    }""")
    figure.locator("[name=k1]").fill("0.21")
    visitor.wait_frame(figure, frames)
    marked_then = set(visitor.page.evaluate("[...window.marked]"))
    assert {"corner", "bow"} & marked_then
    assert "kind" not in marked_then
    expect(marked).to_have_count(0)
