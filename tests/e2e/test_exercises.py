"""Functions that readers write: judged, recognised, measured, used in a figure, and stored; any
text gets a reply and leaves the page working."""

import json
import re

import pytest
from playwright.sync_api import Locator, expect
from support.limits import limit_ms
from support.reader import Reader

pytestmark = pytest.mark.browser

NAME, CHAPTER = "write-a-homography", "2d-transformations/"
FIGURE = "figure-transform-2d"
WRITE = """(area, text) => {
  area.value = text;
  area.dispatchEvent(new Event('input', {bubbles: true}));
}"""
ENDED = "form => !form.hasAttribute('aria-busy') && form.dataset.answered"


@pytest.fixture
def form(reader: Reader) -> Locator:
    reader.open(CHAPTER, live=False)
    return form_of(reader)


def form_of(reader: Reader) -> Locator:
    return reader.page.locator(f"form[data-quiz={NAME}]")


def check(form: Locator, text: str) -> str:
    """Write and check a text; return the results and the feedback."""
    form.locator("textarea").evaluate(WRITE, text)
    form.locator("button[type=submit]").click()
    form.page.wait_for_function(ENDED, arg=form.element_handle(), timeout=limit_ms())
    return form.locator("[data-results]").inner_text() + form.locator(".feedback").inner_text()


def test_written_function_is_graded_used_in_a_figure_and_stored(
    reader: Reader, form: Locator
) -> None:
    data = json.loads(form.locator(".quiz-data").text_content() or "")
    solution, wrong = data["program"]["solution"], data["program"]["wrong"]
    form.locator("textarea").focus()
    expect(form.locator(".cm-content")).to_be_focused(timeout=limit_ms())
    for text in wrong:
        message = check(form, text)
        assert text.splitlines()[0].removeprefix("# ")[:30] in message
        assert form.get_attribute("data-answered") == "wrong"
    expect(form.locator(".code-solution")).to_be_visible()
    form.locator("[data-hint]").click()
    expect(form.locator(".code-hints li").first).to_be_visible()
    check(form, solution)
    assert form.get_attribute("data-answered") == "correct"
    assert "image_of" in form.locator(".cm-content").inner_text()
    form.locator("[data-use]").click()
    figure = reader.page.locator(f"#{FIGURE} simulation-figure")
    expect(figure).to_have_attribute("data-edited", "", timeout=limit_ms())
    reader.open(CHAPTER, live=False)
    form = form_of(reader)
    assert form.get_attribute("data-answered") == "correct"
    assert form.locator("textarea").input_value() == solution
    expect(form.locator("[data-use]")).to_be_enabled()
    form.locator("[data-put-back]").click()
    assert form.locator("textarea").input_value() == data["starter"]
    expect(form.locator("[data-use]")).to_be_disabled()


def test_resetting_answers_deletes_written_functions(reader: Reader, form: Locator) -> None:
    starter = form.locator("textarea").input_value()
    check(form, "def image_of(H, points):\n    return H")
    reader.open("", live=False)
    reader.page.locator("section.progress [data-progress-reset]").click()
    reader.open(CHAPTER, live=False)
    assert form_of(reader).locator("textarea").input_value() == starter
    check(form_of(reader), "def image_of(H, points):\n    return H")
    reader.page.locator("section.progress [data-progress-reset]").click()
    expect(form_of(reader).locator("[data-results]")).to_be_empty()
    assert form_of(reader).locator("textarea").input_value() == starter


BODIES = (
    "pass", "return", "return None", "return 3", "return 'text'", "return points[0]", "return H",
    "return [1, 2]", "return points[:, 0]", "return {}", "return points * np.nan", "return print",
    "return points.astype(complex) * 1j", "return points.astype(np.float16)", "return object()",
    "return points / 0", "1 / 0", "raise KeyError('x')", "raise SystemExit", "exit()",
    "raise KeyboardInterrupt", "import os; os._exit(3)", "import sys; sys.exit(1)",
    "import pandas", "import js",
    "import scipy.linalg", "open('/etc/passwd')", "return image_of(H, points)", "yield points",
    "print('x' * 10**6); return points", "points[:] = 0; return points",
    "H[:] = 1; return points",
    "np.linalg.inv(np.zeros((3, 3)))", "global np; np = None; return points",
    "np.array = None; return points", "__builtins__['len'] = None; return points",
    "return np.zeros((10**5, 10**5))", "return 'x' * 10**8", "return [0] * 10**7",
    "assert False, '<img src=x onerror=alert(1)>'", "raise ValueError('\\u202e')", "del points",
    "return unknown", "import numpy.fft; return numpy.fft.fft(points)", "async def f(): pass",
    "return (yield)", "lambda: 0", "eval('1/0')", "exec('return 1')", "return points,",
)  # fmt: skip
TEXTS = (
    *("", "def", "def image_of(", "x = 1", "class image_of: pass", "image_of = 3", "\0", "\ud800"),
)


def assert_names_are_completed(form: Locator) -> None:
    """Assert that the editor completes names and can be left by Escape and Tab."""
    keyboard, offered = form.page.keyboard, form.locator(".cm-tooltip-autocomplete li")
    form.locator("textarea").focus()
    expect(form.locator(".cm-content")).to_be_focused(timeout=limit_ms())
    keyboard.press("Control+a")
    keyboard.type("def image_of(H, points):\nshifted = points + 1\nreturn sh")
    expect(offered).to_have_text(["shifted"])
    keyboard.press("Enter")
    expect(form.locator("textarea")).to_have_value(re.compile(r"return sh\n +$"))
    keyboard.type("sh")
    expect(offered).to_have_text(["shifted"])
    keyboard.press("ArrowDown")
    keyboard.press("Enter")
    expect(form.locator("textarea")).to_have_value(re.compile(r"\n +shifted$"))
    keyboard.type(" + np.n")
    expect(offered).to_have_text(["nan"])
    keyboard.press("Escape")
    keyboard.press("Tab")
    expect(offered).to_have_count(0)
    expect(form.locator("[type=submit]")).to_be_focused()


def test_names_are_completed_and_any_text_gets_a_reply_or_is_stopped(
    reader: Reader, form: Locator
) -> None:
    """The page's figures still work afterwards."""
    assert_names_are_completed(form)
    form.locator("textarea").evaluate(WRITE, "def image_of(H, points):\n    while True: pass")
    form.locator("button[type=submit]").click()
    form.locator("[data-stop]").click()
    expect(form.locator("[data-results]")).not_to_be_empty()
    expect(form.locator("[data-stop]")).to_be_disabled()
    expect(form.locator(".feedback")).to_be_empty()
    assert form.get_attribute("data-answered") is None
    for body in BODIES:
        message = check(form, f"def image_of(H, points):\n    {body}")
        assert len(message) > len("Not yet. Try again."), body
        assert form.get_attribute("data-answered") == "wrong", body
    assert "Error" not in check(form, "def image_of(H, points):\n    return input()")
    address = "import ctypes\ndef image_of(H, points):\n    return ctypes.string_at(0)"
    assert "stopped" not in check(form, address)
    for text in TEXTS:
        assert len(check(form, text)) > len("Not yet. Try again."), text
    figure = reader.page.locator(f"#{FIGURE} simulation-figure")
    reader.scroll_to(figure)
    reader.settle(figure)
