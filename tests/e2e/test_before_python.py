"""While Python is on its way, a figure's main control shows frames that were drawn beforehand."""

import json
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Route
from support.reader import Reader, chapter_of

pytestmark = pytest.mark.browser

SCENE, CONTROL = "lens-distortion", "k1"
MOVED = f"""document.addEventListener('readystatechange', () => {{
  const figure = document.getElementById('figure-{SCENE}');
  if (figure && document.readyState === 'interactive') {{
    figure.querySelector('input[name={CONTROL}]').value = '0.3';
  }}
}})"""
"""In every page: moves the slider before the first script of the book runs."""
MOVE = """(figure, [name, value]) => {
  const slider = figure.querySelector(`input[name="${name}"]`);
  slider.value = value;
  slider.dispatchEvent(new Event('input', {bubbles: true}));
}"""


def test_the_nearest_frame_is_shown_until_the_live_one_takes_its_place(
    reader: Reader, built_site: Path, book: Any
) -> None:
    held: list[Route] = []
    page = reader.page
    page.context.route("**/runtime.json", lambda route: held.append(route))
    reader.open(chapter_of(book, SCENE), live=False)
    figure = reader.figure(SCENE)
    place = figure.get_attribute("data-prerendered") or ""
    strip = json.loads((built_site / place.removeprefix("../")).read_text(encoding="utf-8"))
    wanted = strip["frames"][-2]
    box = reader.bring(figure)

    figure.evaluate(MOVE, [CONTROL, wanted["value"] + 0.01])
    figure.locator(".early-mark").wait_for()
    early = reader.shown(figure)
    assert figure.get_attribute("data-early") == str(wanted["value"])
    assert figure.get_attribute("data-frames") == "0"
    for readout in wanted["readouts"]:
        shown = figure.locator(f"output[name={readout['name']}]").text_content()
        assert readout["text"] in (shown or "")

    for route in held:
        route.continue_()
    reader.wait_live()
    assert reader.shown(figure) != early, "not the frame of just this value"
    assert figure.locator(".early-mark").count() == 0
    assert reader.bring(figure) == box


def test_a_slider_that_was_moved_before_any_script_ran_is_followed(
    reader: Reader, book: Any
) -> None:
    page = reader.page
    page.context.route("**/runtime.json", lambda _: None)
    page.add_init_script(MOVED)
    reader.open(chapter_of(book, SCENE), live=False)
    figure = reader.figure(SCENE)
    figure.scroll_into_view_if_needed()
    figure.locator(".early-mark").wait_for()
    assert figure.get_attribute("data-early") == "0.3"
