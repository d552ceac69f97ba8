"""Words of the text that set a figure: by mouse and keyboard, in motion and at once."""

import json
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Locator, expect
from support.reader import Reader

pytestmark = pytest.mark.browser

BARREL = 'a.set[href="?figure-lens-distortion.k1=-0.2&figure-lens-distortion.k2=0#{}"]'.format(
    "figure-lens-distortion"
)
CORRECTED = "a.set[data-values*='\"correct\": true']"

NOTE_VALUES = """(figure) => {
  const k1 = figure.querySelector('[name=k1]');
  window.passed = [];
  k1.addEventListener('input', () => window.passed.push(k1.value));
}"""


STEADY_CLOCK = """() => {
  const usual = requestAnimationFrame;
  let now = 0;
  globalThis.usualFrame = usual;
  requestAnimationFrame = (draw) => usual(() => draw((now += 40)));
}"""
"""On a busy machine, too, a glide has frames on its way."""


@pytest.fixture
def figure(guest: Reader, book: Any) -> Iterator[Locator]:
    """As its page has put it, with all answers shown."""
    found = guest.stay_at_figure(book, "lens-distortion")
    guest.put_back(found)
    guest.page.evaluate("document.querySelectorAll('[data-reveal]').forEach((b) => b.click())")
    guest.page.evaluate(STEADY_CLOCK)
    yield found
    guest.page.evaluate("() => { requestAnimationFrame = usualFrame; }")
    guest.page.emulate_media(reduced_motion="null")


def wait_value(guest: Reader, figure: Locator, name: str, value: str) -> None:
    guest.page.wait_for_function(
        "([figure, name, value]) => figure.querySelector(`[name=${name}]`).value === value",
        arg=[figure.element_handle(), name, value],
    )


def in_view(locator: Locator) -> bool:
    box = locator.bounding_box()
    assert box
    height: float = locator.page.evaluate("innerHeight")
    return box["y"] > -0.5 * box["height"] and box["y"] + 0.5 * box["height"] < height


def test_sliders_glide_to_where_the_words_send_them(guest: Reader, figure: Locator) -> None:
    figure.evaluate(NOTE_VALUES)
    start = float(figure.locator("[name=k1]").input_value())
    guest.page.locator(BARREL).first.click()
    wait_value(guest, figure, "k1", "-0.2")
    passed = [float(value) for value in guest.page.evaluate("window.passed")]
    assert passed == sorted(passed, reverse=True)
    assert any(-0.2 < value < start for value in passed)
    assert all(round(100 * value, 6) == round(100 * value) for value in passed)
    guest.settle(figure)
    assert figure.locator("output[name=corner]").inner_text() == "−40.0"


def test_a_figure_out_of_view_is_brought_into_it_and_a_press_leads_back_to_the_link(
    guest: Reader, figure: Locator
) -> None:
    link = guest.page.locator(CORRECTED)
    guest.bring(link)
    assert not in_view(figure.locator(".panels"))
    back = guest.page.locator(".way-back")
    expect(back).to_have_count(0)
    link.click()
    guest.page.wait_for_function(
        "figure => figure.querySelector('[name=correct]').checked", arg=figure.element_handle()
    )
    assert in_view(figure.locator(".panels"))
    back.click()
    expect(link).to_be_in_viewport()
    expect(link).to_be_focused()
    expect(back).to_have_count(0)


def test_a_reader_who_asked_for_less_motion_is_taken_there_at_once(
    guest: Reader, figure: Locator
) -> None:
    guest.page.emulate_media(reduced_motion="reduce")
    figure.evaluate(NOTE_VALUES)
    guest.page.locator(BARREL).first.click()
    wait_value(guest, figure, "k1", "-0.2")
    assert guest.page.evaluate("window.passed") == []


def test_a_hand_on_the_figure_stops_the_motion_where_it_is(guest: Reader, figure: Locator) -> None:
    figure.evaluate("""(figure) => {
      const k1 = figure.querySelector('[name=k1]');
      k1.addEventListener('input', function touch() {
        if (k1.value > -0.05) return;
        k1.removeEventListener('input', touch);
        figure.dispatchEvent(new Event('pointerdown'));
      });
    }""")
    guest.page.locator(BARREL).first.click()
    guest.page.wait_for_function(
        "figure => figure.querySelector('[name=k1]').value <= -0.05", arg=figure.element_handle()
    )
    stopped = figure.locator("[name=k1]").input_value()
    guest.settle(figure)
    assert figure.locator("[name=k1]").input_value() == stopped != "-0.2"


def test_a_link_of_a_prediction_sets_all_that_its_claim_depends_on(
    guest: Reader, figure: Locator
) -> None:
    page = guest.page
    start = figure.evaluate("f => JSON.parse(f.querySelector('script.schema').textContent).values")
    guest.uncover(figure)
    figure.locator("[name=correct]").check(force=True)
    figure.locator("[name=k2]").fill("0.3")
    link = page.locator("[data-answers] a.set[data-figure=figure-lens-distortion]").first
    link.click()
    said = json.loads(link.get_attribute("data-values") or "")
    for name, value in ({**start, **said}).items():
        control = figure.locator(f"[name={name}]")
        kind = control.get_attribute("type")
        if kind == "checkbox":
            expect(control).to_be_checked(checked=value)
        elif kind == "range":
            wait_value(guest, figure, name, f"{value:g}")


def test_back_undoes_what_the_words_did_by_keyboard(guest: Reader, figure: Locator) -> None:
    figure.locator("[name=k1]").fill("0.3")
    guest.page.locator(BARREL).first.press("Enter")
    wait_value(guest, figure, "k1", "-0.2")
    guest.page.go_back()
    wait_value(guest, figure, "k1", "0.3")
    guest.page.go_forward()
    wait_value(guest, figure, "k1", "-0.2")


@pytest.mark.deep
def test_every_link_of_the_book_brings_its_figure_to_what_it_says(
    plain_reader: Reader, book: Any
) -> None:
    plain_reader.page.emulate_media(reduced_motion="reduce")
    for url in plain_reader.leaf_through(chapter["url"] for chapter in book["chapters"]):
        assert plain_reader.page.evaluate(FOLLOW_ALL) == [], url


FOLLOW_ALL = """async () => {
  const wrong = [];
  for (const button of document.querySelectorAll('[data-reveal]')) button.click();
  for (const link of document.querySelectorAll('a.set')) {
    const figure = document.getElementById(link.dataset.figure);
    link.click();
    const shows = () => Object.entries(JSON.parse(link.dataset.values)).every(([name, value]) => {
      const control = figure.querySelector(`form.controls [name="${name}"]`);
      if (control.type === 'checkbox') return control.checked === value;
      if (control.type === 'button') return control.dataset.state === String(value);
      return control.value === String(value);
    });
    for (let left = 100; left && !shows(); left -= 1) await new Promise((r) => setTimeout(r, 20));
    if (!shows()) wrong.push(link.outerHTML);
  }
  return wrong;
}"""
