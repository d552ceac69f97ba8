"""The Python of a figure: opened, edited and run for that figure alone, or copied as a script."""

import ast
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, expect
from support.limits import limit_ms
from support.places import ROOT
from support.reader import DESK, Reader, step

from simulations.script import script

pytestmark = pytest.mark.browser

CHAPTER = "lens-distortion/"
"""A chapter with two figures of one scene with stages."""
NEGATIVE = "def _encoded(photo):\n    return opaque(encode_srgb_codes(1 - photo.linear))\n"
LIMIT = """async (limits) => {
  const {EDITED_LIMIT} = (await customElements.whenDefined('simulation-figure')).internals;
  const before = {...EDITED_LIMIT};
  Object.assign(EDITED_LIMIT, limits);
  return before;
}"""


class Workshop:
    """A figure and the editor of its Python."""

    def __init__(self, reader: Reader, place: str) -> None:
        self.reader, self.page = reader, reader.page
        self.figure = reader.page.locator(f"#{place} simulation-figure")
        self.code = self.figure.locator(".cm-content")
        self.stop = self.figure.locator(".workshop .stop")
        self.state = self.figure.locator(".python-state")

    def part(self, name: str) -> Locator:
        return self.figure.locator(".workshop-part", has_text=name).first

    def open(self, part: str = "encoded") -> None:
        self.figure.locator(".open-python").click()
        self.part(part).click()

    def write(self, text: str) -> None:
        self.code.click()
        self.page.keyboard.press("ControlOrMeta+a")
        self.page.keyboard.insert_text(text)

    def run(self) -> str:
        """Press Run, and wait for the result."""
        self.figure.locator(".workshop .run").click()
        return self.result()

    def result(self) -> str:
        self.reader.wait_for(self.figure, HAS_RESULT)
        return self.figure.locator(".workshop-result").inner_text()

    def content(self) -> Any:
        self.reader.settle(self.figure)
        return self.reader.content(self.figure)

    def move(self, key: str) -> Any:
        """The figure's content after a key press on its first slider."""
        self.reader.press(self.figure, key)
        return self.content()

    def content_of_browser(self) -> Any:
        """The figure's content drawn by the browser, which may differ from the page's by a code."""
        self.reader.scroll_to(self.figure)
        self.move("ArrowRight")
        return self.move("ArrowLeft")


HAS_RESULT = """(figure) => {
  const words = figure.querySelector('.result-words').textContent;
  return words && words !== 'Running …';
}"""


@pytest.fixture
def workshops(visitor: Reader) -> tuple[Workshop, Workshop]:
    """Workshops of two figures of one chapter."""
    visitor.turn_to(CHAPTER)
    return Workshop(visitor, "figure-lens-distortion"), Workshop(visitor, "figure-two-coefficients")


def test_edited_code_draws_only_its_own_figure_until_it_is_put_back(
    workshops: tuple[Workshop, Workshop],
) -> None:
    """The first edit is made only by keyboard."""
    edited, other = workshops
    page, figure = edited.page, edited.figure
    others, book = other.content_of_browser(), edited.content_of_browser()
    focused = "what => document.activeElement.matches(what)"
    with step("a part is opened by keyboard"):
        figure.locator(".open-python").press("Enter")
        page.wait_for_function(focused, arg=".workshop-part")
        while page.evaluate("document.activeElement.textContent").split()[0] != "encoded":
            page.keyboard.press("Tab")
        page.keyboard.press("Enter")
        while not page.evaluate(focused, ".cm-content"):
            page.keyboard.press("Tab")
    with step("code is typed, indented and run by keyboard"):
        page.keyboard.press("ControlOrMeta+a")
        page.keyboard.type("def _encoded(photo):\nreturn ")
        page.keyboard.insert_text("opaque(encode_srgb_codes(1 - photo.linear))")
        assert figure.locator(".cm-line").nth(1).inner_text().startswith("    return"), "indented"
        page.keyboard.press("Home")
        page.keyboard.press("Tab")
        assert page.evaluate(focused, ".cm-content"), "Tab indents"
        page.keyboard.press("ControlOrMeta+Enter")
        assert "Running your code" in edited.result()
    with step("Tab leaves the editor after Escape, which is announced"):
        page.keyboard.press("Escape")
        page.keyboard.press("Tab")
        assert page.evaluate(focused, ".workshop button"), "the way out"
        hint = edited.code.get_attribute("aria-describedby")
        assert "press Escape" in page.locator(f"[id='{hint}']").inner_text()
    with step("the edited code draws this figure alone"):
        assert page.workers[-1].url.startswith("blob:"), "so that it has the policy of the page"
        changed = edited.content()
        assert changed["pixels"] != book["pixels"]
        assert changed["readouts"] == book["readouts"]
        assert other.move("ArrowRight") != others
        assert other.move("ArrowLeft") == others
        assert edited.move("ArrowRight")["pixels"] != changed["pixels"]
        assert edited.move("ArrowLeft") == changed
    with step("a model can be edited too, and its output is shown"):
        figure.locator(".use", has_text="encode_srgb").click()
        assert "simulations/models/color/srgb.py" in figure.locator(".workshop-place").inner_text()
        edited.write(
            "def encode_srgb_codes(linear):\n"
            "    return (255 * linear).astype('uint8')\n"
            "print('hello')\n"
        )
        edited.run()
        assert figure.locator(".workshop-printed").inner_text() == "hello\n"
        assert edited.content()["pixels"] not in (book["pixels"], changed["pixels"]), "a model too"
    with step("everything is put back"):
        figure.locator(".put-all-back").click()
        figure.locator(".workshop-result", has_text="book’s code").wait_for()
        assert edited.content() == book
        edited.part("encoded").click()
        assert "def _encoded(photo: Photo)" in edited.code.inner_text()
        assert len(page.workers) == 1
        figure.locator(".workshop .close").press("Enter")
        assert page.evaluate(focused, ".open-python")


def test_mistakes_point_at_their_line_and_edits_survive_a_reload(
    workshops: tuple[Workshop, Workshop],
) -> None:
    """The editor opens at a formula that the figure depends on; mistakes leave the figure
    unchanged, and an edit is offered, but not run, once the book's code has changed."""
    shop, other = workshops
    page, figure = shop.page, shop.figure
    book = shop.content()
    with step("the editor opens at the formula"):
        figure.locator(".open-python").click()
        formula = figure.locator(".workshop-part").first
        assert formula.get_attribute("aria-current") == "true"
        assert "def distort(" in shop.code.inner_text()
    with step("mistakes name their line and mark it"):
        shop.part("encoded").click()
        first = int(figure.locator(".place-line").inner_text())
        shop.write("def _encoded(photo):\n    return (photo\n")
        message = shop.run()
        assert "SyntaxError" in message
        assert f"Line {first + 1} of _encoded" in message
        shop.write("def _encoded(photo):\n    x = 1\n    return phot")
        message = shop.run()
        assert "NameError: name 'phot' is not defined" in message
        assert f"Line {first + 2} of _encoded" in message
        assert figure.locator(".cm-problem").inner_text() == "    return phot"
        shop.part("pinhole").click()
        figure.locator(".result-place").click()
        page.keyboard.insert_text("# here ")
        assert figure.locator(".cm-problem").inner_text() == "    # here return phot"
    with step("a mistake far down is in view beside the figure on any screen"):
        shop.write("\n" * 40 + "def _encoded(photo)")
        assert "SyntaxError" in shop.run()
        for width, height in ((1440, 900), (390, 844)):
            page.set_viewport_size({"width": width, "height": height})
            shop.code.click()
            page.keyboard.press("ControlOrMeta+End")
            for part in (".panel .panel-view", ".result-words", ".cm-problem"):
                assert figure.locator(part).first.evaluate(IN_VIEW), (part, width)
    with step("a mistake leaves the figure as it is and alive"):
        page.set_viewport_size(DESK)
        assert shop.content() == book
        assert figure.get_attribute("data-state") == "live"
        assert shop.move("ArrowRight") != book
        shop.move("ArrowLeft")
    with step("two edits change the figure"):
        shop.write(NEGATIVE)
        formula.click()
        shop.write("def distort(xy, d):\n    return 0.5 * xy\n")
        assert "Running your code" in shop.run()
        changed = shop.content()
        assert changed["drawings"] != book["drawings"]

    with step("the edits are there after a reload, and can be downloaded"):
        page.wait_for_function(RUNS)  # once the page has answered for some seconds
        shop.reader.open(CHAPTER)
        expect(shop.state).to_contain_text("runs your code")
        assert shop.content() == changed
        assert other.state.inner_text() == ""
        assert figure.locator(".workshop").count() == 0
        shop.open()
        with page.expect_download() as caught:
            figure.locator(".download").click()
        assert caught.value.suggested_filename == "lens-distortion-edited.py"
        text = caught.value.path().read_text(encoding="utf-8")
        assert NEGATIVE in text
        assert "# _encoded in simulations/scenes/lens_distortion/stages.py" in text
    with step("edits of other code are offered, not run"):
        page.evaluate(THE_BOOK_CHANGES)
        shop.reader.turn_to("licences/", live=False)
        shop.reader.turn_to(CHAPTER)
        shop.open()
        assert "def _encoded(photo: Photo)" in shop.code.inner_text()
        assert shop.content() == book
        figure.locator(".offer-show").click()
        assert shop.code.inner_text().strip() == NEGATIVE.strip()
        figure.locator(".put-all-back").click()
        assert not page.evaluate("Object.keys(localStorage).some((k) => k.includes('python:'))")


IN_VIEW = """(element) => {
  const {left, width, top, bottom} = element.getBoundingClientRect();
  const met = (y) => document.elementFromPoint(left + Math.min(20, width / 2), y);
  return [top + 4, bottom - 4].every((y) => element.contains(met(y)));
}"""
RUNS = """() => Object.entries(localStorage)
  .some(([key, value]) => key.includes('python:') && JSON.parse(value).runs)"""
THE_BOOK_CHANGES = """() => {
  const key = Object.keys(localStorage).find((key) => key.includes('python:'));
  const kept = JSON.parse(localStorage.getItem(key));
  for (const edit of Object.values(kept.edits)) edit.original = 'of another text';
  localStorage.setItem(key, JSON.stringify(kept));
}"""


def test_endless_code_is_stopped_and_the_figure_runs_the_books_code(
    workshops: tuple[Workshop, Workshop],
) -> None:
    shop, other = workshops
    page, figure = shop.page, shop.figure
    book = shop.content_of_browser()
    shop.open()
    assert shop.stop.get_attribute("aria-disabled") == "true"
    usual = page.evaluate(LIMIT, {"ms": 500, "times": 0})
    shop.write("def _encoded(photo):\n    while True:\n        pass\n")
    figure.locator(".workshop .run").click()
    assert other.move("ArrowRight"), "another figure does not wait for it"
    message = shop.result()
    assert "was stopped: it did not finish within" in message
    assert shop.content() == book
    page.evaluate(LIMIT, {"ms": 10 * limit_ms(), "times": 0})
    figure.locator(".workshop .run").click()
    shop.stop.click()
    assert shop.result().startswith("Stopped.")
    assert shop.stop.get_attribute("aria-disabled") == "true"
    moved = shop.move("ArrowRight")
    assert moved != book, "the book's code draws on"
    assert shop.move("ArrowLeft") == book
    # Code that ran well and loops later. Of the limit a frame takes a hundredth on a quiet machine.
    page.evaluate(LIMIT, {"ms": limit_ms() / 40, "times": 2})
    names = "('grid', 'picture', 'corrected', 'profile')"
    loops_later = ("while k1 != 0:", "    pass", f"return dict.fromkeys({names}, '')")
    shop.write(NEGATIVE)
    shop.part("drawings").click()
    shop.write("\n    ".join(["def overlays(k1, k2):", *loops_later]))
    assert "Running your code" in shop.run()
    assert shop.content()["pixels"] != book["pixels"]
    shop.stop.click()
    assert shop.result().startswith("Stopped.")
    assert shop.content() == book, "what ran well can be stopped, too"
    assert "while k1 != 0:" in shop.code.inner_text()
    assert len(page.workers) == 1
    assert "Running your code" in shop.run()
    figure.locator(".workshop .close").click()
    assert shop.move("ArrowRight") == moved, "the book's frame instead"
    assert "was stopped" in shop.state.inner_text()
    page.evaluate(LIMIT, usual)


def test_python_can_be_read_without_the_editor(workshops: tuple[Workshop, Workshop]) -> None:
    shop = workshops[0]
    button = shop.figure.locator(".open-python")
    button.evaluate("(button) => delete button.dataset.editor")
    shop.open()
    assert "def _encoded(photo: Photo)" in shop.figure.locator(".workshop-code").inner_text()
    assert not shop.figure.locator(".workshop .run").is_visible()


LEADERS = "simulation-figure:not([data-with])"
FIGURES = """() => [...document.querySelectorAll('LEADERS')].map((figure) => ({
  id: figure.closest('figure').id,
  scene: figure.dataset.simulation,
  schema: JSON.parse(figure.querySelector('script.schema').textContent),
  readouts: [...figure.querySelectorAll('.readout')].map((box) => [
    box.querySelector('.readout-label').textContent,
    box.querySelector('output').textContent,
    box.querySelector('.unit').textContent,
  ]),
}))""".replace("LEADERS", LEADERS)
RUN_ALL = """
import runpy, sys
sys.path.insert(0, sys.argv[1])
for file in sys.argv[2:]:
    runpy.run_path(file)
    print("\\f", end="")
"""


def lines_printed_by(folder: Path, scripts: list[str]) -> list[list[str]]:
    """The sorted lines that each script prints, run in a folder outside the book; sorted, as a page
    shows folded readouts last."""
    files = [folder / f"{number}.py" for number in range(len(scripts))]
    for file, text in zip(files, scripts, strict=True):
        file.write_text(text, encoding="utf-8")
    command = [sys.executable, "-I", "-X", "utf8", "-c", RUN_ALL, str(ROOT), *map(str, files)]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    return [sorted(text.splitlines()) for text in done.stdout.split("\f")[:-1]]


def lines_of(figure: Any) -> list[str]:
    return sorted(f"{label}: {text} {unit}".rstrip() for label, text, unit in figure["readouts"])


@pytest.mark.deep
def test_script_of_every_figure_prints_the_numbers_of_its_page(
    plain_reader: Reader, book: Any, tmp_path: Path
) -> None:
    figures: list[Any] = []
    for _ in plain_reader.open_each(["", *(chapter["url"] for chapter in book["chapters"])]):
        figures += plain_reader.page.evaluate(FIGURES)
    assert {figure["scene"] for figure in figures} == {s["id"] for s in book["simulations"]}
    scripts = []
    for figure in figures:
        schema = figure["schema"]
        values = json.dumps(schema["values"])
        scripts.append(script(figure["scene"], values, schema["default_tier"], "[]"))
    assert lines_printed_by(tmp_path, scripts) == [lines_of(figure) for figure in figures]


def test_script_begins_with_its_notes_and_is_otherwise_the_same() -> None:
    plain, noted = (
        ast.parse(script("camera", "{}", "", json.dumps(["Camera.", *more])))
        for more in ([], ["It ran other Python."])
    )
    assert ast.get_docstring(plain) == "Camera."
    assert ast.get_docstring(noted) == "Camera.\n\nIt ran other Python."
    assert [ast.dump(part) for part in plain.body[1:]] == [ast.dump(p) for p in noted.body[1:]]


def test_copied_script_prints_the_current_numbers_of_the_figure(
    visitor: Reader, tmp_path: Path
) -> None:
    page, place = visitor.page, "figure-lens-distortion"
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    visitor.turn_to_unlinked(f"{CHAPTER}?{place}.k1=-0.31&{place}.k2=0.07")
    figure = visitor.figure("lens-distortion")
    figure.locator(".share > summary").click()
    figure.locator("[data-copy-python]").click()
    figure.locator(".tools-status", has_text="copied").wait_for()
    shown = next(each for each in page.evaluate(FIGURES) if each["id"] == place)
    copied = str(page.evaluate("navigator.clipboard.readText()"))
    assert lines_printed_by(tmp_path, [copied]) == [lines_of(shown)]
