"""What the reader meets when something breaks: a message, a way on, and nothing lost."""

import json
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator
from support.reader import START_MS, Reader
from support.static_server import StaticServer

pytestmark = pytest.mark.browser

HASTE = """async (ms) => {
  const {TIMEOUTS} = (await customElements.whenDefined('simulation-figure')).inside;
  const usual = TIMEOUTS.render;
  Object.defineProperty(TIMEOUTS, 'render', {configurable: true, get: () => {
    Object.defineProperty(TIMEOUTS, 'render', {value: usual, writable: true});
    return ms;
  }});
}"""
"""The time limit of the next frame only."""

HARM = """async (edits) => {
  const {inside} = await customElements.whenDefined('simulation-figure');
  const runtime = inside.sharedRuntime();
  const frame = {figure: 'figure-x', scene: 'lens-distortion', values: '{}', tier: '', edits};
  await runtime.call('forget', {figure: ''}, () => -1); // nothing else is on its way to the harm
  return (await runtime.call('render_edited', frame)).problem;
}"""
"""Run edited code in the interpreter of the book: the page itself never does."""

CODE = """def _encoded(photo):
    return to_rgba8(encode_srgb_table(photo.linear))

import sys
book = sys.modules["simulations.browser"]
asked = book._request

def next_frame(*given):
    {}

book._request = next_frame
"""
"""Whatever is asked of the book's interpreter next meets with a harm."""


def harm(visitor: Reader, code: str) -> Locator:
    """A live figure, whose next frame meets with ``code``; its first slider has been moved, to
    ``HERE``."""
    visitor.turn_to("lens-distortion/")
    figure = visitor.figure("lens-distortion")
    figure.locator("input[type=range]").first.press("PageUp")
    visitor.settle(figure)
    here = figure.locator("input[type=range]").first.input_value()
    harmful = CODE.format(code.replace("HERE", here))
    edits = {"simulations.scenes.lens_distortion.stages:_encoded": harmful}
    assert visitor.page.evaluate(HARM, json.dumps(edits)) is None
    return figure


@pytest.mark.parametrize(
    "code",
    [
        pytest.param(
            "import js; js.self.postMessage = lambda *_: None; js.self.close(); "
            "return asked(*given)",
            id="ended",
        ),
        pytest.param("while True: pass", id="endless loop", marks=pytest.mark.deep),
        pytest.param(
            "import numpy; kept = book.kept = []\n    while True: kept.append(numpy.empty(2**24))",
            id="memory exhausted",
            marks=pytest.mark.deep,
        ),
    ],
)
def test_a_worker_lost_in_the_midst_of_a_frame_is_replaced_and_the_values_are_kept(
    visitor: Reader, code: str
) -> None:
    figure = harm(visitor, code)
    slider = figure.locator("input[type=range]").first
    kept = slider.input_value()
    frames = visitor.frames(figure)
    visitor.page.evaluate(HASTE, 1500)
    slider.press("ArrowRight")
    visitor.wait_frame(figure, frames, START_MS)
    assert figure.get_attribute("data-state") == "live"
    assert slider.input_value() != kept
    slider.press("ArrowLeft")
    assert slider.input_value() == kept


def test_an_exception_in_a_scene_is_told_and_the_next_try_finds_the_values_as_they_were(
    visitor: Reader,
) -> None:
    figure = harm(
        visitor,
        "import json; moved = abs(json.loads(given[2]).get('k1', HERE) - HERE)\n"
        "    if not 0 < moved < 0.05: return asked(*given)  # what is estimated or computed ahead\n"
        "    book._request = asked; raise ZeroDivisionError('the scene divides')",
    )
    slider = figure.locator("input[type=range]").first
    slider.press("ArrowRight")
    kept = slider.input_value()
    figure.locator(".retry").wait_for()
    assert "ZeroDivisionError: the scene divides" in figure.locator(".figure-message").inner_text()
    frames = visitor.frames(figure)
    figure.locator(".retry").click()
    visitor.wait_frame(figure, frames)
    assert slider.input_value() == kept
    assert not figure.locator(".figure-status").is_visible()


def test_a_browser_without_webassembly_is_told_so_and_keeps_the_stills(
    plain_reader: Reader,
) -> None:
    plain_reader.open("lens-distortion/", live=False)
    figure = plain_reader.figure("lens-distortion")
    figure.locator(".figure-message").wait_for(state="visible")
    assert "WebAssembly" in figure.locator(".figure-message").inner_text()
    assert not figure.locator(".control-grid >> nth=0").is_visible()
    assert figure.locator("svg.overlay").first.is_visible()


def test_without_script_pages_are_whole_and_offer_nothing_that_does_nothing(
    chromium: Browser, server: StaticServer, book: Any
) -> None:
    with chromium.new_context(java_script_enabled=False) as context:
        page = context.new_page()
        for chapter in book["chapters"][::4]:
            page.goto(server.url + chapter["url"])
            paragraphs, drawings, offered, kept_back = page.evaluate(WHOLE)
            assert paragraphs > 3, chapter["id"]
            assert drawings >= len(chapter["simulations"])
            assert (offered, kept_back) == (0, 0), chapter["id"]
            assert page.locator("#contents ol a").first.is_visible()


WHOLE = """() => {
  const count = (what, wanted) => [...document.querySelectorAll(what)]
    .filter((one) => one.checkVisibility() === wanted).length;
  return [
    document.querySelectorAll('article.chapter p').length,
    document.querySelectorAll('simulation-figure svg.overlay').length,
    count('.control-grid, .site-header button, dialog', true),
    count('form.quiz details, .answer-body', false),
  ];
}"""


ANSWERS = """async (calls) => {
  const {inside} = await customElements.whenDefined('simulation-figure');
  const runtime = inside.sharedRuntime();
  const answers = [];
  for (const [name, payload] of calls) {
    answers.push(await runtime.call(name, payload)
      .then(() => 'answered', (error) => `${error.kind}: ${error.message}`));
  }
  return answers;
}"""


def test_what_python_refuses_is_told_and_the_next_call_is_answered(visitor: Reader) -> None:
    frame = {"figure": "figure-x", "scene": "lens-distortion", "values": "{}", "tier": ""}
    calls = [
        ("render", frame | {"scene": "lens-distorsion"}),
        ("render", frame | {"values": '{"k1": "NaN"}'}),
        ("render", frame | {"values": '{"picture": "sunset"}'}),
        ("measure", {"ladder": "precision", "tier": "perfect", "budget": 0.01}),
        ("render", frame | {"values": '{"k1": 1e300}'}),
    ]
    answers = visitor.page.evaluate(ANSWERS, calls)
    told = [
        "unknown simulation 'lens-distorsion'",
        "'NaN' is not finite",
        "'sunset' is not an option",
    ]
    for answer, words in zip(answers, [*told, "has no tier 'perfect'"], strict=False):
        assert answer.startswith("python: "), answer
        assert words in answer
    assert answers[-1] == "answered", "a slider past its end is at its end"
