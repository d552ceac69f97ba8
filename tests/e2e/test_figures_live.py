"""Every chapter opens, and every figure comes alive in place."""

from typing import Any

import pytest
from support.reader import Reader

pytestmark = pytest.mark.browser


def test_every_figure_comes_alive_in_place(reader: Reader, book: Any) -> None:
    reader.page.add_init_script(HOLD)
    first, *others = (chapter["url"] for chapter in book["chapters"])
    for address in ("", first, *others):
        if address in others:
            reader.page.evaluate("window.hold()")
            reader.turn_to(address, live=False)
        else:
            reader.open(address, live=False)
        still = reader.page.evaluate(STILLS)
        reader.page.evaluate("window.release()")
        reader.wait_live()
        where = address or "landing page"
        assert reader.page.evaluate(STILLS) == still, where
        _assert_unmoved(reader, where)


def test_every_chapter_shows_the_figures_and_questions_that_the_catalogue_names(
    plain_reader: Reader, book: Any
) -> None:
    urls = [chapter["url"] for chapter in book["chapters"]]
    for chapter, url in zip(book["chapters"], plain_reader.leaf_through(urls), strict=True):
        assert plain_reader.page.locator("h1").inner_text().strip() == chapter["title"]
        found = plain_reader.page.evaluate(
            "[...document.querySelectorAll('simulation-figure')].map(f => f.dataset.simulation)"
        )
        assert set(found) == set(chapter["simulations"])
        quizzes = plain_reader.page.evaluate(
            "[...document.querySelectorAll('form.quiz')].map(form => form.dataset.quiz)"
        )
        assert quizzes == chapter["quizzes"]
        _assert_unmoved(plain_reader, url)


def _assert_unmoved(reader: Reader, where: str) -> None:
    """Nothing has moved on this page, nor on those from which the reader turned to it."""
    shifts = reader.page.evaluate("window.shifts")
    total = sum(shift["value"] for shift in shifts)
    assert total < 0.01, f"{where} moved by {total:.3f}: {shifts}"


HOLD = """(() => {
  const send = Worker.prototype.postMessage;
  let held = [];
  window.hold = () => {
    Worker.prototype.postMessage = function (...message) { held.push([this, message]); };
  };
  window.release = () => {
    Worker.prototype.postMessage = send;
    for (const [worker, message] of held) worker.postMessage(...message);
    held = [];
  };
  window.hold();
})()"""
"""What is sent to the interpreter waits, so that the page can be looked at as it was served."""

STILLS = """async () => {
  const figures = [];
  for (const figure of document.querySelectorAll('simulation-figure')) {
    figures.push({
      drawings: [...figure.querySelectorAll('svg.overlay')].map((svg) => svg.innerHTML),
      readouts: [...figure.querySelectorAll('output')].map((output) => output.textContent),
      values: [...figure.querySelectorAll('.control-value')].map((text) => text.textContent),
      description: figure.querySelector('.description').textContent,
      boxes: [...figure.querySelectorAll('.panel-view')].map((box) => box.offsetHeight),
    });
  }
  return figures;
}"""
