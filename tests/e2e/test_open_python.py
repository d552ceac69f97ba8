"""The Python of a figure, opened, changed and run: there, and nowhere else."""

from typing import Any

import pytest
from playwright.sync_api import Locator
from support.reader import DESK, START_MS, Reader

pytestmark = pytest.mark.browser

CHAPTER = "lens-distortion/"
"""Has two figures of one scene with stages."""
NEGATIVE = "def _encoded(photo):\n    return to_rgba8(encode_srgb_table(1 - photo.linear))\n"
LIMIT = """async (limits) => {
  const {EDITED} = (await customElements.whenDefined('simulation-figure')).inside;
  const before = {...EDITED};
  Object.assign(EDITED, limits);
  return before;
}"""
IN_VIEW = """(element) => {
  const {left, width, top, bottom} = element.getBoundingClientRect();
  const met = (y) => document.elementFromPoint(left + Math.min(20, width / 2), y);
  return [top + 4, bottom - 4].every((y) => element.contains(met(y)));
}"""
THE_BOOK_CHANGES = """() => {
  const key = Object.keys(localStorage).find((key) => key.includes('python:'));
  const kept = JSON.parse(localStorage.getItem(key));
  for (const edit of Object.values(kept.edits)) edit.original = 'of another text';
  localStorage.setItem(key, JSON.stringify(kept));
}"""


def figures(reader: Reader) -> list[Locator]:
    places = ("figure-lens-distortion", "figure-two-coefficients")
    return [reader.page.locator(f"#{place} simulation-figure") for place in places]


def open_python(figure: Locator, part: str = "encoded") -> None:
    further = figure.locator("[data-further]")
    if further.is_visible():  # a phone has no room for all tools
        further.click()
    figure.locator(".open-python").click()
    figure.locator(".workshop-part", has_text=part).first.click()


def write(reader: Reader, figure: Locator, text: str) -> None:
    figure.locator(".cm-content").click()
    reader.page.keyboard.press("ControlOrMeta+a")
    reader.page.keyboard.insert_text(text)


def run(reader: Reader, figure: Locator) -> str:
    """Press Run, and wait for what comes of it."""
    figure.locator(".workshop .run").click()
    return result(reader, figure)


def result(reader: Reader, figure: Locator) -> str:
    reader.page.wait_for_function(
        """(figure) => {
          const words = figure.querySelector('.result-words').textContent;
          return words && words !== 'Running …';
        }""",
        arg=figure.element_handle(),
        timeout=START_MS,
    )
    return figure.locator(".workshop-result").inner_text()


def move(reader: Reader, figure: Locator, key: str) -> Any:
    """What the figure shows after a key on its first slider."""
    reader.press(figure, key)
    reader.settle(figure)
    return reader.shown(figure)


def drawn(reader: Reader, figure: Locator) -> Any:
    """What the figure shows once the browser has drawn it, which may be a code off the page's."""
    move(reader, figure, "ArrowRight")
    return move(reader, figure, "ArrowLeft")


def open_by_keyboard(reader: Reader, figure: Locator, part: str) -> None:
    page = reader.page
    figure.locator(".open-python").focus()
    page.keyboard.press("Enter")
    figure.locator(".workshop").wait_for()
    page.wait_for_function("document.activeElement.matches('.workshop-part')")
    while page.evaluate("document.activeElement.textContent").split()[0] != part:
        page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    while not page.evaluate("document.activeElement.matches('.cm-content')"):
        page.keyboard.press("Tab")


def test_edited_code_draws_its_own_figure_and_no_other_until_it_is_put_back(
    visitor: Reader,
) -> None:
    """The first edit is made by keyboard alone."""
    visitor.turn_to(CHAPTER)
    page = visitor.page
    edited, other = figures(visitor)[:2]
    for figure in (other, edited):
        visitor.bring(figure)
    book, others = drawn(visitor, edited), drawn(visitor, other)
    open_by_keyboard(visitor, edited, "encoded")
    page.keyboard.press("ControlOrMeta+a")
    page.keyboard.type("def _encoded(photo):\nreturn ")
    page.keyboard.insert_text("to_rgba8(encode_srgb_table(1 - photo.linear))")
    assert edited.locator(".cm-line").nth(1).inner_text().startswith("    return"), "indented"
    page.keyboard.press("Home")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.matches('.cm-content')"), "Tab indents"
    page.keyboard.press("ControlOrMeta+Enter")
    assert "Running your code" in result(visitor, edited)
    page.keyboard.press("Escape")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.matches('.workshop button')"), "the way out"
    hint = edited.locator(".cm-content").get_attribute("aria-describedby")
    assert "press Escape" in page.locator(f"[id='{hint}']").inner_text()
    visitor.settle(edited)
    changed = visitor.shown(edited)
    assert changed["pixels"] != book["pixels"]
    assert changed["readouts"] == book["readouts"]
    assert edited.locator(".workshop-part", has_text="encoded").inner_text().endswith("computed")
    assert move(visitor, other, "ArrowRight") != others
    assert move(visitor, other, "ArrowLeft") == others
    assert move(visitor, edited, "ArrowRight")["pixels"] != changed["pixels"]
    assert move(visitor, edited, "ArrowLeft") == changed
    assert edited.locator(".workshop-part", has_text="pinhole").inner_text().endswith("reused")
    edited.locator(".use", has_text="encode_srgb").click()
    assert "simulations/models/color/srgb.py" in edited.locator(".workshop-place").inner_text()
    linear = "def encode_srgb_table(linear):\n    return linear\n"
    write(visitor, edited, f"{linear}print('hello')\n")
    run(visitor, edited)
    assert edited.locator(".workshop-printed").inner_text() == "hello\n"
    visitor.settle(edited)
    assert visitor.shown(edited)["pixels"] not in (book["pixels"], changed["pixels"]), "a model too"
    edited.locator(".put-all-back").click()
    edited.locator(".workshop-result", has_text="book’s code").wait_for()
    visitor.settle(edited)
    assert visitor.shown(edited) == book
    edited.locator(".workshop-part", has_text="encoded").click()
    assert "def _encoded(photo: Photo)" in edited.locator(".cm-content").inner_text()
    assert len(page.workers) == 1
    edited.locator(".workshop .close").press("Enter")
    assert page.evaluate("document.activeElement.matches('.open-python')")


def test_mistakes_point_at_their_line_and_an_edit_survives_a_reload_as_long_as_it_fits(
    visitor: Reader,
) -> None:
    """The editor opens on the formula whose change changes the figure; mistakes leave it as it
    is."""
    visitor.turn_to(CHAPTER)
    figure = figures(visitor)[0]
    book = visitor.shown(figure)
    figure.locator(".open-python").click()
    formula = figure.locator(".workshop-part").first
    assert formula.inner_text() == "The formula"
    assert formula.get_attribute("aria-current") == "true"
    assert "def distort(" in figure.locator(".cm-content").inner_text()
    figure.locator(".workshop-part", has_text="encoded").first.click()
    first = int(figure.locator(".place-line").inner_text())
    write(visitor, figure, "def _encoded(photo):\n    return (photo\n")
    told = run(visitor, figure)
    assert "SyntaxError" in told
    assert f"Line {first + 1} of _encoded" in told
    write(visitor, figure, "def _encoded(photo):\n    x = 1\n    return phot")
    told = run(visitor, figure)
    assert "NameError: name 'phot' is not defined" in told
    assert f"Line {first + 2} of _encoded" in told
    assert figure.locator(".cm-problem").inner_text() == "    return phot"
    figure.locator(".workshop-part", has_text="pinhole").click()
    figure.locator(".result-place").click()
    visitor.page.keyboard.insert_text("# here ")
    assert figure.locator(".cm-problem").inner_text() == "    # here return phot"
    write(visitor, figure, "\n" * 40 + "def _encoded(photo)")
    assert "SyntaxError" in run(visitor, figure)
    for width, height in ((1440, 900), (390, 844)):
        visitor.page.set_viewport_size({"width": width, "height": height})
        figure.locator(".cm-content").click()
        visitor.page.keyboard.press("ControlOrMeta+End")
        for part in (".panel .panel-view", ".result-words", ".cm-problem"):
            assert figure.locator(part).first.evaluate(IN_VIEW), (part, width)
    visitor.page.set_viewport_size(DESK)
    assert visitor.shown(figure) == book
    assert figure.get_attribute("data-state") == "live"
    assert move(visitor, figure, "ArrowRight") != book
    assert figure.locator(".python-state").inner_text() == "Your changes to its code are kept."
    move(visitor, figure, "ArrowLeft")
    write(visitor, figure, NEGATIVE)
    formula.click()
    write(visitor, figure, "def distort(xy, d):\n    return 0.5 * xy\n")
    assert "Running your code" in run(visitor, figure)
    visitor.settle(figure)
    changed = visitor.shown(figure)
    assert changed["drawings"] != book["drawings"]
    visitor.open(CHAPTER)
    figure, other = figures(visitor)[:2]
    figure.locator(".python-state", has_text="runs your code").wait_for(timeout=START_MS)
    visitor.settle(figure)
    assert visitor.shown(figure) == changed
    assert other.locator(".python-state").inner_text() == ""
    assert figure.locator(".workshop").count() == 0
    open_python(figure)
    with visitor.page.expect_download() as caught:
        figure.locator(".download").click()
    assert caught.value.suggested_filename == "lens-distortion-edited.py"
    text = caught.value.path().read_text(encoding="utf-8")
    assert NEGATIVE in text
    assert "# _encoded in simulations/scenes/lens_distortion/stages.py" in text
    visitor.page.evaluate(THE_BOOK_CHANGES)
    visitor.turn_to("licences/", live=False)
    visitor.turn_to(CHAPTER)
    figure = figures(visitor)[0]
    open_python(figure)
    assert "def _encoded(photo: Photo)" in figure.locator(".cm-content").inner_text()
    assert visitor.shown(figure) == book
    figure.locator(".offer-show").click()
    assert figure.locator(".cm-content").inner_text().strip() == NEGATIVE.strip()
    figure.locator(".put-all-back").click()
    assert not visitor.page.evaluate("Object.keys(localStorage).some((k) => k.includes('python:'))")


def test_code_that_does_not_end_is_stopped_by_the_clock_or_by_hand_and_the_figure_is_the_book_s(
    visitor: Reader,
) -> None:
    visitor.turn_to(CHAPTER)
    figure, other = figures(visitor)[:2]
    book = drawn(visitor, figure)
    open_python(figure)
    stop = figure.locator(".workshop .stop")
    assert stop.get_attribute("aria-disabled") == "true"
    usual = visitor.page.evaluate(LIMIT, {"ms": 500, "times": 0})
    write(visitor, figure, "def _encoded(photo):\n    while True:\n        pass\n")
    figure.locator(".workshop .run").click()
    assert move(visitor, other, "ArrowRight"), "another figure does not wait for it"
    told = result(visitor, figure)
    assert "was stopped: it did not finish within" in told
    assert "figure stays as it was" in told
    assert visitor.shown(figure) == book
    visitor.page.evaluate(LIMIT, {"ms": 10 * START_MS, "times": 0})
    figure.locator(".workshop .run").click()
    stop.click()
    assert result(visitor, figure).startswith("Stopped.")
    assert "failed" not in (figure.locator(".workshop-result").get_attribute("class") or "")
    assert stop.get_attribute("aria-disabled") == "true"
    assert visitor.shown(figure) == book
    moved = move(visitor, figure, "ArrowRight")
    assert moved != book, "the book's code draws on"
    assert move(visitor, figure, "ArrowLeft") == book
    # Of which this takes a hundredth, until it is to loop; on a slow machine what the book's does.
    visitor.page.evaluate(LIMIT, {"ms": 1500, "times": 2})
    loops_later = ("while k1 != 0.15:", "    pass", "return Drawings('', '', '', '')")
    write(visitor, figure, NEGATIVE)
    figure.locator(".workshop-part", has_text="drawings").click()
    write(visitor, figure, "\n    ".join(["def _drawings(k1, k2):", *loops_later]))
    assert "Running your code" in run(visitor, figure)
    visitor.settle(figure)
    assert visitor.shown(figure)["pixels"] != book["pixels"]
    stop.click()
    assert result(visitor, figure).startswith("Stopped.")
    visitor.settle(figure)
    assert visitor.shown(figure) == book, "what ran well can be stopped, too"
    assert "while k1 != 0.15:" in figure.locator(".cm-content").inner_text()
    assert len(visitor.page.workers) == 1
    assert "Running your code" in run(visitor, figure)
    figure.locator(".workshop .close").click()
    assert move(visitor, figure, "ArrowRight") == moved, "the book's frame instead"
    told = figure.locator(".python-state").inner_text()
    assert "was stopped" in told
    assert "The figure runs the book’s code" in told
    visitor.page.evaluate(LIMIT, usual)


def test_without_the_editor_the_python_can_be_read(visitor: Reader) -> None:
    visitor.turn_to(CHAPTER)
    figure = figures(visitor)[0]
    figure.locator(".open-python").evaluate("(button) => delete button.dataset.editor")
    open_python(figure)
    assert "def _encoded(photo: Photo)" in figure.locator(".workshop-code").inner_text()
    assert "without the code editor" in figure.locator(".workshop-hint").inner_text()
    assert not figure.locator(".workshop .run").is_visible()
