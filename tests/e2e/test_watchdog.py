"""When a worker that does not answer is given up: not while it may be at work, or while all slept.

The worker is a stand-in that answers when the test lets it; the clock is the test's, too.
"""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Page
from support.reader import Reader

pytestmark = pytest.mark.browser

BEGIN = """async () => {
  const {Runtime} = (await customElements.whenDefined('simulation-figure')).inside;
  window.ended = 0;
  window.plain = [];
  window.Worker = class {
    postMessage({id, call, plain}) {
      window.answer = (more) => this.onmessage({data: {id, ok: true, ...more}});
      if (call === 'start') window.plain.push(plain);
      if (call === 'start') setTimeout(() => this.onmessage({data: {id, ok: true}}));
    }
    terminate() { window.ended += 1; }
  };
  window.runtime = new Runtime(location.href, () => []);
}"""
ASK = """([name, payload]) => {
  window.told = null;
  window.runtime.call(name, payload).then(
    () => { window.told = 'answered'; }, (error) => { window.told = error.kind; });
}"""
FRAME = {"figure": "figure-x", "scene": "any"}


@pytest.fixture
def page(plain_reader: Reader) -> Iterator[Page]:
    """A page of its own, whose clock stands, in the browser without WebAssembly."""
    own = plain_reader.page.context.new_page()
    own.add_init_script("delete Navigator.prototype.serviceWorker")
    own.clock.install()
    own.goto(plain_reader.root + "licences/")
    yield own
    own.close()


def begin(page: Page) -> None:
    """Start a worker, and have a frame of it."""
    page.evaluate(BEGIN)
    ask(page)
    page.clock.run_for(100)
    is_waited_for(page)
    ask(page)


def ask(page: Page) -> None:
    page.evaluate(ASK, ["render", FRAME])


def told(page: Page, what: str | None) -> None:
    page.evaluate("Promise.resolve()")
    assert page.evaluate("told") == what


def is_waited_for(page: Page) -> None:
    """The worker's answer is still taken, now."""
    told(page, None)
    page.evaluate("answer({computeMs: 5})")
    told(page, "answered")


def test_a_silent_worker_is_given_up_after_a_minute(page: Page) -> None:
    begin(page)
    page.clock.run_for(59_000)
    told(page, None)
    page.clock.run_for(2_000)
    told(page, "lost")
    assert page.evaluate("ended") == 1


def test_an_hour_of_sleep_is_no_waiting(page: Page) -> None:
    begin(page)
    page.clock.run_for(40_000)
    page.clock.fast_forward("01:00:00")
    page.clock.run_for(15_000)
    is_waited_for(page)


def test_a_slow_download_is_not_a_slow_frame(page: Page) -> None:
    begin(page)
    page.evaluate("answer({fetching: true})")
    page.clock.run_for(120_000)
    told(page, None)
    page.evaluate("answer({fetching: false})")
    is_waited_for(page)


def test_after_a_fatal_error_in_the_first_import_python_starts_without_the_snapshot(
    page: Page,
) -> None:
    page.evaluate(BEGIN)
    page.evaluate(ASK, ["prepare", FRAME])
    page.clock.run_for(100)
    page.evaluate("answer({ok: false, fatal: true, error: 'table index is out of bounds'})")
    told(page, "lost")
    ask(page)
    page.clock.run_for(100)
    assert page.evaluate("plain") == [False, True]
