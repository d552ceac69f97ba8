"""While the reader rests, the stages of the figures here and of the next chapter are computed."""

from typing import Any

import pytest
from playwright.sync_api import Browser
from support.reader import Reader, chapter_of, visit
from support.static_server import StaticServer

pytestmark = pytest.mark.browser

NOTE = """async () => {
  const {inside} = await customElements.whenDefined('simulation-figure');
  const runtime = inside.sharedRuntime();
  const call = runtime.call.bind(runtime);
  window.calls = [];
  runtime.call = async (name, payload, urgency) => {
    const told = {name, ...payload, urgency: urgency?.() ?? 0};
    const reply = await call(name, payload, urgency);
    window.calls.push(told);
    return reply;
  };
}"""
"""Note what the worker has answered from now on."""
WARMED = "scenes => scenes.every(scene => calls.some(" + (
    "({name, figure, scene: of}) => name === 'warm' && figure === '' && of === scene))"
)
WATCH = """window.warmed = [];
globalThis.Worker = class extends Worker {
  postMessage(message, ...given) {
    if (message.call === 'warm' && message.figure) window.warmed.push(message);
    super.postMessage(message, ...given);
  }
};"""
"""Note what of a page's own figures is computed ahead."""
SETTINGS = "scene => new Set(warmed.filter(call => call.scene === scene).map(c => c.values)).size"
TRIED = f"warmed.some(({{scene}}) => ({SETTINGS})(scene) > 10)"
"""Whichever figure was the first to rest, moves of it have been tried."""
STAGES = """async scene => {
  const figure = document.querySelector(`simulation-figure[data-simulation="${scene}"]`);
  const {inside} = await customElements.whenDefined('simulation-figure');
  const runtime = inside.sharedRuntime();
  return (await new Promise(resolve => {
    const call = runtime.call.bind(runtime);
    runtime.call = async (name, payload, urgency) => {
      const reply = await call(name, payload, urgency);
      if (name === 'render' && payload.scene === scene) resolve(JSON.parse(reply.meta).stages);
      return reply;
    };
    const slider = figure.querySelector('input[type=range]');
    slider.stepUp();
    slider.dispatchEvent(new Event('input', {bubbles: true}));
  })).filter(({status}) => status === 'computed').map(({name}) => name);
}"""
"""Which stages the first touch on a figure computes."""


def test_the_next_chapter_s_figures_have_their_stages_before_the_page_is_turned(
    visitor: Reader, book: Any
) -> None:
    chapters = [each for each in book["chapters"] if each["simulations"]]
    index = next(i for i, each in enumerate(chapters) if "camera" in each["simulations"])
    following = chapters[index]["simulations"]
    visitor.turn_to(chapters[index - 1]["url"])
    visitor.page.evaluate(NOTE)
    visitor.page.wait_for_function(WARMED, arg=list(following), timeout=60_000)
    assert all(
        call["urgency"] < -1 for call in visitor.page.evaluate("calls") if call["name"] == "warm"
    ), "before any frame that a figure waits for"
    visitor.turn_to(chapters[index]["url"])
    computed = visitor.page.evaluate(STAGES, "camera")
    assert computed
    assert "grain" not in computed


def test_a_figure_has_the_drafts_of_its_sliders_once_it_rests(visitor: Reader, book: Any) -> None:
    visitor.turn_to(chapter_of(book, "wagon-wheel"))
    visitor.page.evaluate(NOTE)
    visitor.turn_to(chapter_of(book, "camera"))
    visitor.page.wait_for_function(
        "drafts => drafts.every(draft => calls.some(call => call.scene === 'camera'"
        " && call.name === 'warm' && call.figure && call.tier === draft))",
        arg=["draft", "scaled", "bowed"],
        timeout=60_000,
    )


def test_moves_of_a_slider_are_tried_once_a_visit_before_the_first_hand(
    brisk_chromium: Browser, site_server: StaticServer
) -> None:
    with visit(brisk_chromium, site_server, WATCH) as reader:
        reader.open("lens-distortion/")
        reader.page.wait_for_function(TRIED, timeout=60_000)
        reader.turn_to("full-camera-model/")
        reader.page.wait_for_function(f"({SETTINGS})('camera') > 0", timeout=60_000)
        reader.page.wait_for_function(
            "warmed.some(({scene, tier}) => scene === 'camera' && tier === 'bowed')", timeout=60_000
        )
        assert reader.page.evaluate(SETTINGS, "camera") == 1, "drafts, at rest"
