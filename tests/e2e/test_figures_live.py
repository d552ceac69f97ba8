"""Every chapter opens, and every figure comes alive in place."""

from typing import Any

import pytest
from support.reader import Reader

pytestmark = pytest.mark.browser


def test_every_chapter_shows_its_figures_and_questions_and_figures_come_alive_in_place(
    reader: Reader, book: Any
) -> None:
    reader.page.add_init_script(HOLD)
    reader.page.emulate_media(reduced_motion="reduce")  # one plays as it comes into view
    reader.open(live=False)
    come_alive(reader, "landing page")
    for number, chapter in enumerate(book["chapters"]):
        if number:
            reader.page.evaluate("window.hold()")
            reader.turn_to(chapter["url"], live=False)
        else:
            reader.open(chapter["url"], live=False)
        title, scenes, questions = reader.page.evaluate(CATALOGUED)
        assert title == chapter["title"]
        assert {*scenes} == {*chapter["simulations"]}, title
        assert questions == chapter["quizzes"], title
        come_alive(reader, title)


def come_alive(reader: Reader, where: str) -> None:
    """Let Python answer: what is shown stays as it is, and where it is."""
    still = reader.page.evaluate(STILLS)
    reader.page.evaluate("window.release()")
    reader.wait_live()
    assert reader.page.evaluate(STILLS) == still, where
    shifts = reader.page.evaluate("window.shifts")  # on pages before this one, too
    total = sum(shift["value"] for shift in shifts)
    assert total < 0.01, f"{where} moved by {total:.3f}: {shifts}"


CATALOGUED = """() => [
  document.querySelector('h1').innerText.trim(),
  [...document.querySelectorAll('simulation-figure')].map((one) => one.dataset.simulation),
  [...document.querySelectorAll('form.quiz')].map((form) => form.dataset.quiz),
]"""

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
