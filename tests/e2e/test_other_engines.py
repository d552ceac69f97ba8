"""A reader's session in the engines that the other tests do not use."""

from pathlib import Path
from typing import Any

import pytest
from support.engines import open_engine
from support.engines.engine import Engine, click, drag, press, wait_for
from support.page_scripts import LIVE, SCROLL_TO, SLOWED, TRY_CONTROLS
from support.static_server import ODD_PATH, serving

pytestmark = pytest.mark.browser

SCENE, CHAPTER = "lens-distortion", "lens-distortion/"
FIGURE = f"#figure-{SCENE}"
HANDLE, SLIDER = f"{FIGURE} [data-handle=point]", f"{FIGURE} input[name=k1]"
PART, LINE = f"{FIGURE} .workshop-part", f"{FIGURE} .cm-line"
QUESTION, PREDICTION = "#quiz-corrected-too-far", "#predict-corner-of-a-barrel"
ARROW_LEFT, ENTER, ESCAPE, HOME = "\ue012", "\ue007", "\ue00c", "\ue011"
NAMES = ["Firefox", pytest.param("WebKitGTK", marks=pytest.mark.deep)]
"""WebKitGTK runs WebAssembly ten times as slowly."""


@pytest.mark.parametrize("name", NAMES)
def test_whole_session_of_a_reader_works_in_other_engines(
    name: str, built_site: Path, book: Any, tmp_path: Path
) -> None:
    with open_engine(name, tmp_path) as engine, serving(built_site, path=ODD_PATH) as host:
        engine.open(host.url + CHAPTER)
        wait_for(engine, f"() => {LIVE}")
        move_figure(engine)
        move_slowly(engine)
        (controls,) = (one["controls"] for one in book["simulations"] if one["id"] == SCENE)
        tried = engine.evaluate(TRIED.replace("TRY", TRY_CONTROLS), FIGURE, controls)
        assert all(one["hit"] and one["focused"] and one["frames"] for one in tried), tried
        edit_python(engine)
        write_function(engine)
        answer_questions(engine)
        search(engine)
        click(engine, middle(engine, ".pager a[rel=next]"))
        wait_for(engine, "(left) => !location.pathname.endsWith(left)", CHAPTER)
        wait_for(engine, f"() => document.activeElement.id === 'main' && {ONE_LIVES}")
        engine.open(host.url + CHAPTER)
        wait_for(engine, f"() => {ONE_LIVES}")
        wait_for(engine, ANSWERED, PREDICTION, "correct")
        assert not engine.errors()
        wait_for(engine, "() => Boolean(navigator.serviceWorker.controller)")
        host.offline = True
        engine.open(host.url + "perspective-projection/")
        wait_for(engine, f"() => {ONE_LIVES}")


def write_function(engine: Engine) -> None:
    """Submit the exercise's starter, then its solution."""
    for text, verdict in (("starter", "wrong"), ("solution", "correct")):
        engine.evaluate(WRITE, text)
        wait_for(engine, WRITTEN, verdict)


WRITE = """(text) => {
  const form = document.querySelector('form[data-kind=code]');
  const data = JSON.parse(form.querySelector('.quiz-data').text);
  const area = form.querySelector('textarea');
  area.value = data[text] ?? data.program[text];
  area.dispatchEvent(new Event('input', {bubbles: true}));
  form.requestSubmit();
}"""
WRITTEN = """(verdict) => {
  const form = document.querySelector('form[data-kind=code]');
  return form.dataset.answered === verdict && !form.hasAttribute('aria-busy');
}"""


def move_figure(engine: Engine) -> None:
    """Use the slider, a handle, and the handle's keys."""
    x, y = middle(engine, SLIDER)
    start = engine.evaluate(STATE, SCENE)
    click(engine, (x + 30, y))
    wait_for(engine, MOVED, SCENE, start)
    x, y = middle(engine, HANDLE)
    start = engine.evaluate(STATE, SCENE)
    drag(engine, (x, y), (x + 10, y + 8), (x + 24, y + 18))
    wait_for(engine, MOVED, SCENE, start)
    start = engine.evaluate(STATE, SCENE)
    engine.evaluate("(handle) => document.querySelector(handle).focus()", HANDLE)
    press(engine, ARROW_LEFT)
    wait_for(engine, MOVED, SCENE, start)


def move_slowly(engine: Engine) -> None:
    """Drag the slider of a figure whose default level is slow: frames of cheaper levels come."""
    engine.evaluate(f"(scene) => ({SLOWED})({THE_FIGURE}, {{'closed-form': 200}})", SCENE)
    x, y = middle(engine, SLIDER)
    drag(engine, *((x + step, y) for step in range(0, 60, 2)))
    wait_for(engine, f"(scene) => {THE_FIGURE}.rests", SCENE)
    levels = engine.evaluate(f"(scene) => {THE_FIGURE}.levels", SCENE)
    assert len(levels) > 5
    assert {*levels[:-1]} - {"closed-form"}
    assert levels[-1] == "closed-form"
    engine.evaluate(f"(scene) => {THE_FIGURE}.unslowed()", SCENE)


def edit_python(engine: Engine) -> None:
    """Edit the figure's Python and run it in a separate interpreter."""
    click(engine, middle(engine, f"{FIGURE} .open-python"))
    wait_for(engine, "(part) => Boolean(document.querySelector(part))", PART)
    click(engine, middle(engine, PART))
    wait_for(engine, "(line) => document.querySelector(line)?.innerText.startsWith('def')", LINE)
    click(engine, middle(engine, LINE))
    press(engine, HOME, *"print(6*7)", ENTER)
    click(engine, middle(engine, f"{FIGURE} .workshop .run"))
    wait_for(engine, SAYS, f"{FIGURE} .workshop-result", "Running your code.")


def answer_questions(engine: Engine) -> None:
    """Answer a question wrongly and a prediction correctly."""
    click(engine, middle(engine, f'{QUESTION} label:has(input[value="0"])'))
    click(engine, middle(engine, f"{QUESTION} button[type=submit]"))
    wait_for(engine, ANSWERED, QUESTION, "wrong")
    click(engine, middle(engine, f"{PREDICTION} input[name=guess]"))
    press(engine, *"-40")
    click(engine, middle(engine, f"{PREDICTION} button[type=submit]"))
    wait_for(engine, ANSWERED, PREDICTION, "correct")


def search(engine: Engine) -> None:
    engine.evaluate("() => document.getElementById('main').focus()")
    press(engine, "/")
    wait_for(engine, "() => document.activeElement.matches('dialog.search input')")
    press(engine, *"vignetting")
    wait_for(engine, "() => document.querySelector('dialog.search a[data-result]')?.href")
    press(engine, ESCAPE)
    wait_for(engine, "() => !document.querySelector('dialog.search').open")


def middle(engine: Engine, selector: str) -> tuple[float, float]:
    """Middle of an element, which is brought into the window and rests there."""
    x, y = engine.evaluate(MIDDLE, selector)
    return x, y


TRIED = """(figure, controls) =>
  (TRY)(document.querySelector(`${figure} simulation-figure`), controls)"""
ONE_LIVES = "document.querySelector('simulation-figure[data-state=live]') !== null"
MIDDLE = f"""async (selector) => {{
  const element = document.querySelector(selector);
  await ({SCROLL_TO})(element);
  const {{x, y, width, height}} = element.getBoundingClientRect();
  return [x + width / 2, y + height / 2];
}}"""
THE_FIGURE = "document.querySelector(`#figure-${scene} simulation-figure`)"
STATE = """(scene) => {
  const figure = document.querySelector(`#figure-${scene} simulation-figure`);
  return [figure.querySelector('[name=k1]').value, Number(figure.dataset.frames)];
}"""
MOVED = f"""(scene, [value, frames]) => {{
  const [now, painted] = ({STATE})(scene);
  return now !== value && painted > frames
    && document.querySelector(`#figure-${{scene}} simulation-figure`).rests;
}}"""
SAYS = "(place, words) => document.querySelector(place)?.textContent.includes(words)"
ANSWERED = "(form, verdict) => document.querySelector(form)?.dataset.answered === verdict"
