"""Faults of workers and scenes: a figure says what it waits for or what went wrong, and goes on."""

import json
from collections.abc import Iterator
from time import monotonic
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page
from support.limits import limit_s
from support.reader import Reader, visit
from support.static_server import Fault, StaticServer

pytestmark = pytest.mark.browser

CHAPTER, SCENE = "lens-distortion/", "lens-distortion"
WITHOUT_SNAPSHOT = {"/snapshot.wasm": Fault(status=404)}
"""Python starts plainly, and needs all else."""

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

import json, sys
book = sys.modules["simulations.browser"]
asked = book._request

def next_frame(*given):
    {}

book._request = next_frame
"""
"""The next request to the book's interpreter meets with a harm."""
OF_A_SMALL_MOVE = """moved = abs(json.loads(given[2]).get("k1", HERE) - HERE)
    if not 0 < moved < 0.05: return asked(*given)
    """
"""Frames at `HERE` that are estimated, and others that are computed ahead, are let through."""
HASTE = """async (ms) => {
  const {render} = (await customElements.whenDefined('simulation-figure')).inside.CALLS;
  const usual = render.limit;
  Object.defineProperty(render, 'limit', {configurable: true, get: () => {
    Object.defineProperty(render, 'limit', {value: usual, writable: true});
    return ms;
  }});
}"""
"""The time limit of the next frame only."""


def harm(visitor: Reader, code: str) -> tuple[Locator, Locator]:
    """A live figure and its first slider, whose next move meets with ``code``."""
    visitor.turn_to(CHAPTER)
    figure = visitor.figure(SCENE)
    slider = figure.locator("input[type=range]").first
    slider.press("PageUp")
    visitor.settle(figure)
    harmful = CODE.format(code.replace("HERE", slider.input_value()))
    edits = {"simulations.scenes.lens_distortion.stages:_encoded": harmful}
    assert visitor.page.evaluate(HARM, json.dumps(edits)) is None
    return figure, slider


LOSSES = {
    "endless loop": "while True: pass",
    "memory exhausted": "import numpy; kept = book.kept = []\n"
    "    while True: kept.append(numpy.empty(2**24))",
}


@pytest.mark.parametrize(
    "loss", ["endless loop", pytest.param("memory exhausted", marks=pytest.mark.deep)]
)
def test_a_worker_lost_in_the_midst_of_a_frame_is_replaced_and_the_values_are_kept(
    visitor: Reader, loss: str
) -> None:
    figure, slider = harm(visitor, OF_A_SMALL_MOVE + LOSSES[loss])
    kept = slider.input_value()
    visitor.page.evaluate(HASTE, 1500)
    with visitor.next_frame(figure):
        slider.press("ArrowRight")
    assert figure.get_attribute("data-state") == "live"
    assert slider.input_value() != kept
    slider.press("ArrowLeft")
    assert slider.input_value() == kept


def test_an_exception_in_a_scene_is_told_and_the_next_try_has_the_same_values(
    visitor: Reader,
) -> None:
    failing = "book._request = asked; raise ZeroDivisionError('the scene divides')"
    figure, slider = harm(visitor, OF_A_SMALL_MOVE + failing)
    slider.press("ArrowRight")
    kept = slider.input_value()
    figure.locator(".retry").wait_for()
    assert "ZeroDivisionError: the scene divides" in figure.locator(".figure-message").inner_text()
    with visitor.next_frame(figure):
        figure.locator(".retry").click()
    assert slider.input_value() == kept
    assert not figure.locator(".figure-status").is_visible()


def test_what_python_refuses_is_told_and_the_next_call_is_answered(visitor: Reader) -> None:
    """A slider past its end is at its end, also where a script sets it to no number."""
    frame = {"figure": "figure-x", "scene": "lens-distortion", "values": "{}", "tier": ""}
    refused = [
        ("render", frame | {"scene": "lens-distorsion"}, "unknown simulation 'lens-distorsion'"),
        ("render", frame | {"values": '{"k1": "NaN"}'}, "'NaN' is not finite"),
        ("render", frame | {"values": '{"picture": "sunset"}'}, "'sunset' is not an option"),
        ("measure", {"ladder": "precision", "tier": "no", "budget": 0.01}, "has no tier 'no'"),
    ]
    last = ("render", frame | {"values": '{"k1": 1e300}'})
    *answers, answered = visitor.page.evaluate(ANSWERS, [*(call[:2] for call in refused), last])
    for answer, (_, _, words) in zip(answers, refused, strict=True):
        assert answer.startswith("python: "), answer
        assert words in answer
    assert answered == "answered"
    visitor.turn_to("perspective-projection/")
    figure = visitor.figure("perspective-projection")
    slider = figure.locator("input[name=focal_length]")
    for value in ("NaN", "1e309"):
        visitor.put_back(figure)
        with visitor.next_frame(figure):
            slider.evaluate(SET, value)
        assert figure.get_attribute("data-state") == "live"
        assert 20 <= float(slider.input_value()) <= 200


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
SET = """(slider, value) => {
  slider.value = value;
  slider.dispatchEvent(new Event('input', {bubbles: true}));
}"""


SILENT = {
    "an empty script": ("worker.js", Fault(lambda _: b"")),
    "a script that sends nothing": ("worker.js", Fault(lambda _: b"onmessage = () => {};")),
    "a script that never comes": ("worker.js", Fault(late_s=3600)),
    "a file that never comes": ("numpy.zip", Fault(late_s=3600)),
}
AWAITED = """async () =>
  (await customElements.whenDefined('simulation-figure')).inside.sharedRuntime().awaits.file"""


@pytest.mark.parametrize(
    "silent", [*[*SILENT][3:], *(pytest.param(n, marks=pytest.mark.deep) for n in [*SILENT][:3])]
)
def test_within_5_s_a_figure_says_what_it_waits_for_and_within_20_s_it_offers_another_try(
    brisk_chromium: Browser, uncached: StaticServer, silent: str
) -> None:
    """The page's clock is turned on by hand, beside the time that passes."""
    file, fault = SILENT[silent]
    uncached.faults = {**WITHOUT_SNAPSHOT, f"/{file}": fault}
    with visit(brisk_chromium, uncached) as reader:
        page, figure = reader.page, reader.figure(SCENE)
        page.clock.install()
        reader.open(CHAPTER, live=False)
        figure.locator("input[type=range]").first.scroll_into_view_if_needed()
        end = monotonic() + limit_s()
        while page.evaluate(AWAITED) != file or figure.evaluate("figure => figure.rests"):
            assert monotonic() < end
        message, waited_s = figure.locator(".figure-message"), 0
        while file not in message.inner_text():
            assert waited_s < 5
            page.clock.run_for(1000)
            waited_s += 1
        page.clock.run_for(15_000)
        assert file in message.inner_text()
        uncached.faults = {}
        page.clock.resume()
        figure.locator(".retry").click()
        reader.wait_live()
        assert not message.is_visible()


BEGIN = """async () => {
  const {Runtime} = (await customElements.whenDefined('simulation-figure')).inside;
  window.ended = 0;
  window.plain = [];
  window.dead = false;
  window.Worker = class {
    postMessage({id, call, plain}) {
      window.send = (data) => this.onmessage({data});
      window.answer = (more) => send({id, ok: true, meta: '{}', rasters: [], ...more});
      window.wait = (waits) => send({id, waits});
      if (!window.dead) setTimeout(() => wait(''));
      if (call === 'start') window.plain.push(plain);
      if (call === 'start') setTimeout(() => answer());
    }
    terminate() { window.ended += 1; }
  };
  window.runtime = new Runtime(location.href, () => []);
}"""
"""A stand-in for the worker, which answers when the test lets it."""
ASK = """([name, payload]) => {
  window.told = null;
  window.runtime.call(name, payload).then(
    () => { window.told = 'answered'; },
    ({kind, message}) => { Object.assign(window, {told: kind, reason: message}); });
}"""


class Watched:
    """A page whose clock stands, and its stand-in for the worker."""

    def __init__(self, page: Page) -> None:
        self.page = page

    def begin(self) -> None:
        """Start a worker, have a frame of it, and ask for another."""
        self.page.evaluate(BEGIN)
        self.ask("render")
        self.page.clock.run_for(100)
        self.is_waited_for()
        self.ask("render")
        self.page.clock.run_for(100)

    def ask(self, call: str) -> None:
        self.page.evaluate(ASK, [call, {"figure": "figure-x", "scene": "any"}])

    def told(self) -> Any:
        self.page.evaluate("Promise.resolve()")
        return self.page.evaluate("told")

    def is_waited_for(self) -> None:
        """The worker's answer is still taken, now."""
        assert self.told() is None
        self.page.evaluate("answer({computeMs: 5})")
        assert self.told() == "answered"


@pytest.fixture
def watched(plain_reader: Reader) -> Iterator[Watched]:
    page = plain_reader.page.context.new_page()
    raised: list[str] = []
    page.on("pageerror", lambda error: raised.append(str(error)))
    page.add_init_script("delete Navigator.prototype.serviceWorker")
    page.clock.install()
    page.goto(plain_reader.root + "licences/")
    yield Watched(page)
    page.close()
    assert not raised


def test_a_worker_is_given_up_when_it_is_silent_but_not_while_it_may_be_at_work(
    watched: Watched,
) -> None:
    page, clock = watched.page, watched.page.clock
    watched.begin()
    clock.run_for(58_000)
    assert watched.told() is None
    clock.run_for(3_000)
    assert watched.told() == "lost"
    assert page.evaluate("ended") == 1

    watched.begin()
    clock.run_for(40_000)
    clock.fast_forward("01:00:00")  # an hour of sleep is no waiting
    clock.run_for(15_000)
    watched.is_waited_for()

    watched.begin()
    for _ in range(120):  # a slow download is no slow frame
        page.evaluate("wait('numpy.zip')")
        clock.run_for(1000)
    watched.is_waited_for()

    page.evaluate("dead = true")
    watched.ask("render")
    clock.run_for(3000)
    assert watched.told() == "lost", "a dead worker, within 2 s and a tick of the clock"

    page.evaluate(BEGIN)
    watched.ask("prepare")
    clock.run_for(100)
    page.evaluate("answer({ok: false, fatal: true, error: 'table index is out of bounds'})")
    assert watched.told() == "lost"
    watched.ask("render")
    clock.run_for(100)
    assert page.evaluate("plain") == [False, True], "then without the snapshot"


NO_MESSAGES = ("null", "undefined", "5", "'text'", "[]", "{id: 3}", "{id: 3, waits: {}}", "{ok: 1}")
NO_FRAMES = ("meta: 5", "rasters: null", "rasters: ['pixels']", "computeMs: 'NaN'", "sound: 1")


def test_messages_of_a_worker_that_are_not_in_the_protocol_are_dropped(watched: Watched) -> None:
    for message in NO_MESSAGES:
        watched.begin()
        watched.page.evaluate(f"send({message})")
        watched.is_waited_for()
    for values in NO_FRAMES:
        watched.begin()
        watched.page.evaluate(f"answer({{computeMs: 5, {values}}})")
        assert watched.told() == "lost", values
    watched.begin()
    watched.page.evaluate("wait('numpy.zip')")
    watched.page.evaluate("answer({ok: false, error: '\\x1b[31m' + 'x'.repeat(1e7)})")
    assert watched.told() == "python"
    assert watched.page.evaluate("reason.length") < 5000
    watched.begin()
    watched.page.evaluate("answer({ok: false, error: ''})")
    assert watched.told() == "python"
    assert watched.page.evaluate("reason"), "no failure without a reason"
