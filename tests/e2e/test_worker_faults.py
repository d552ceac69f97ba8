"""Faults of workers and scenes: a figure reports its waiting or its error, and recovers."""

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
"""Python starts without a snapshot, and needs all other files."""

HARM = """async (edits) => {
  const {internals} = await customElements.whenDefined('simulation-figure');
  const runtime = internals.sharedRuntime();
  const frame = {figure: 'figure-x', scene: 'lens-distortion', values: '{}', tier: '', edits};
  await runtime.call('forget', {figure: ''}, () => -1); // no other call precedes the harm
  return (await runtime.call('render_edited', frame)).problem;
}"""
"""Run edited code in the book's interpreter, which the page itself never does."""
CODE = """def _encoded(photo):
    return opaque(encode_srgb_codes(photo.linear))

import json, sys
book = sys.modules["simulations.browser"]
request = book._request

def next_frame(*given):
    {}

book._request = next_frame
"""
"""Code that harms the next request to the book's interpreter."""
OF_A_SMALL_MOVE = """moved = abs(json.loads(given[2]).get("k1", HERE) - HERE)
    if not 0 < moved < 0.05: return request(*given)
    """
"""Frames estimated at `HERE`, and frames computed in advance, pass unharmed."""
HASTE = """async (ms) => {
  const {render} = (await customElements.whenDefined('simulation-figure')).internals.CALLS;
  const usual = render.limit;
  Object.defineProperty(render, 'limit', {configurable: true, get: () => {
    Object.defineProperty(render, 'limit', {value: usual, writable: true});
    return ms;
  }});
}"""
"""The time limit of the next frame only."""


def harm(visitor: Reader, code: str) -> tuple[Locator, Locator]:
    """A live figure and its first slider, whose next move runs ``code``."""
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
def test_worker_lost_during_a_frame_is_replaced_with_the_same_values(
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


FAILS_TWICE = """book.failures = getattr(book, "failures", 0) + 1
    if book.failures == 2: book._request = request
    raise ZeroDivisionError('the scene divides')"""
"""An exception in the frame while the slider moves, and in the one when it rests."""


def test_exception_in_a_scene_is_reported_and_the_retry_keeps_its_values(visitor: Reader) -> None:
    figure, slider = harm(visitor, OF_A_SMALL_MOVE + FAILS_TWICE)
    slider.press("ArrowRight")
    kept = slider.input_value()
    figure.locator(".retry").wait_for()
    part = visitor.page.locator(f"simulation-figure[data-with=figure-{SCENE}]")
    for shown in (figure, part):
        assert shown.get_attribute("data-state") == "failed"
        message = shown.locator(".figure-message").inner_text()
        assert "ZeroDivisionError: the scene divides" in message
    with visitor.next_frame(figure):
        part.locator(".retry").click()
    assert slider.input_value() == kept
    for shown in (figure, part):
        assert shown.get_attribute("data-state") == "live"
        assert not shown.locator(".figure-status").is_visible()


def test_call_refused_by_python_is_reported_and_the_next_one_succeeds(visitor: Reader) -> None:
    """A slider beyond its end is clamped, even where a script sets it to no number."""
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
        visitor.restore(figure)
        with visitor.next_frame(figure):
            slider.evaluate(SET, value)
        assert figure.get_attribute("data-state") == "live"
        assert 20 <= float(slider.input_value()) <= 200


ANSWERS = """async (calls) => {
  const {internals} = await customElements.whenDefined('simulation-figure');
  const runtime = internals.sharedRuntime();
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
    "empty script": ("worker.js", Fault(lambda _: b"")),
    "silent script": ("worker.js", Fault(lambda _: b"onmessage = () => {};")),
    "script never arrives": ("worker.js", Fault(delay_s=3600)),
    "file never arrives": ("numpy.zip", Fault(delay_s=3600)),
}
AWAITED = """async () =>
  (await customElements.whenDefined('simulation-figure')).internals.sharedRuntime().waitsFor.file"""


@pytest.mark.parametrize(
    "silent", [*[*SILENT][3:], *(pytest.param(n, marks=pytest.mark.deep) for n in [*SILENT][:3])]
)
def test_waiting_figure_names_the_file_within_5_s_and_offers_a_retry(
    baseline_chromium: Browser, uncached: StaticServer, silent: str
) -> None:
    """A retry is offered within 20 s; the page's clock is advanced by the test."""
    file, fault = SILENT[silent]
    uncached.faults = {**WITHOUT_SNAPSHOT, f"/{file}": fault}
    with visit(baseline_chromium, uncached) as reader:
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
  const {Runtime} = (await customElements.whenDefined('simulation-figure')).internals;
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
"""A fake worker, which replies when the test says so."""
REQUEST = """([name, payload]) => {
  window.outcome = null;
  window.runtime.call(name, payload).then(
    () => { window.outcome = 'answered'; },
    ({kind, message}) => { Object.assign(window, {outcome: kind, reason: message}); });
}"""


class FakeWorkerPage:
    """A page with a stopped clock and a fake worker."""

    def __init__(self, page: Page) -> None:
        self.page = page

    def begin(self) -> None:
        """Start a worker, let it answer one frame, and request another."""
        self.page.evaluate(BEGIN)
        self.request("render")
        self.page.clock.run_for(100)
        self.assert_waiting()
        self.request("render")
        self.page.clock.run_for(100)

    def request(self, call: str) -> None:
        self.page.evaluate(REQUEST, [call, {"figure": "figure-x", "scene": "any"}])

    def outcome(self) -> Any:
        self.page.evaluate("Promise.resolve()")
        return self.page.evaluate("outcome")

    def assert_waiting(self) -> None:
        """Assert that the worker's answer is still accepted."""
        assert self.outcome() is None
        self.page.evaluate("answer({computeMs: 5})")
        assert self.outcome() == "answered"


@pytest.fixture
def faked(plain_reader: Reader) -> Iterator[FakeWorkerPage]:
    page = plain_reader.page.context.new_page()
    raised: list[str] = []
    page.on("pageerror", lambda error: raised.append(str(error)))
    page.add_init_script("delete Navigator.prototype.serviceWorker")
    page.clock.install()
    page.goto(plain_reader.root + "licences/")
    yield FakeWorkerPage(page)
    page.close()
    assert not raised


def test_silent_worker_is_given_up_unless_it_may_be_at_work(faked: FakeWorkerPage) -> None:
    page, clock = faked.page, faked.page.clock
    faked.begin()
    clock.run_for(58_000)
    assert faked.outcome() is None
    clock.run_for(3_000)
    assert faked.outcome() == "lost"
    assert page.evaluate("ended") == 1

    faked.begin()
    clock.run_for(40_000)
    clock.fast_forward("01:00:00")  # an hour of sleep does not count as waiting
    clock.run_for(15_000)
    faked.assert_waiting()

    faked.begin()
    for _ in range(120):  # a slow download does not count as a slow frame
        page.evaluate("wait('numpy.zip')")
        clock.run_for(1000)
    faked.assert_waiting()

    page.evaluate("dead = true")
    faked.request("render")
    clock.run_for(3000)
    assert faked.outcome() == "lost", "a dead worker, within 2 s and a tick of the clock"

    page.evaluate(BEGIN)
    faked.request("prepare")
    clock.run_for(100)
    page.evaluate("answer({ok: false, fatal: true, error: 'table index is out of bounds'})")
    assert faked.outcome() == "lost"
    faked.request("render")
    clock.run_for(100)
    assert page.evaluate("plain") == [False, True], "then without the snapshot"


NO_MESSAGES = ("null", "undefined", "5", "'text'", "[]", "{id: 3}", "{id: 3, waits: {}}", "{ok: 1}")
NO_FRAMES = ("meta: 5", "rasters: null", "rasters: ['pixels']", "computeMs: 'NaN'", "sound: 1")


def test_messages_of_a_worker_outside_the_protocol_are_dropped(faked: FakeWorkerPage) -> None:
    for message in NO_MESSAGES:
        faked.begin()
        faked.page.evaluate(f"send({message})")
        faked.assert_waiting()
    for values in NO_FRAMES:
        faked.begin()
        faked.page.evaluate(f"answer({{computeMs: 5, {values}}})")
        assert faked.outcome() == "lost", values
    faked.begin()
    faked.page.evaluate("wait('numpy.zip')")
    faked.page.evaluate("answer({ok: false, error: '\\x1b[31m' + 'x'.repeat(1e7)})")
    assert faked.outcome() == "python"
    assert faked.page.evaluate("reason.length") < 5000
    faked.begin()
    faked.page.evaluate("answer({ok: false, error: ''})")
    assert faked.outcome() == "python"
    assert faked.page.evaluate("reason"), "every failure has a reason"
