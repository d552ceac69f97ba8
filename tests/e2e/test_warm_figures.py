"""While the reader rests, the stages of the figures here and of the next chapter are computed."""

from typing import Any

import pytest
from support.reader import Reader, chapter_of

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
