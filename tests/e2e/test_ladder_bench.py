"""A reader measures a ladder on the device at hand: points, numbers, a file; and can stop."""

import csv
import io
import json
from pathlib import Path

import pytest
from playwright.sync_api import Locator
from support.reader import START_MS, Reader

from site_builder.benchmarks.record import close

pytestmark = pytest.mark.browser

CHAPTER = "speed-and-accuracy/"
LADDER = "rotation-interpolation"
"""A quick one."""
DATA = Path(__file__).resolve().parents[2] / "content" / "measurements.json"


@pytest.fixture
def bench(visitor: Reader) -> Locator:
    visitor.turn_to(CHAPTER)
    return unfold(visitor.page.locator(f'ladder-bench[data-ladder="{LADDER}"]').first)


def unfold(bench: Locator) -> Locator:
    bench.evaluate("bench => { bench.closest('details').open = true; }")
    return bench


def wait_state(visitor: Reader, bench: Locator, *states: str) -> None:
    visitor.page.wait_for_function(
        "([bench, states]) => states.includes(bench.dataset.state)",
        arg=[bench.element_handle(), list(states)],
        timeout=START_MS,
    )


def measure(visitor: Reader, bench: Locator) -> None:
    bench.locator("button.run").click()
    wait_state(visitor, bench, "done", "failed")
    assert bench.get_attribute("data-state") == "done", bench.locator(".ladder-status").inner_text()


def read_csv(bench: Locator) -> list[dict[str, str]]:
    text = bench.evaluate("async (b) => (await fetch(b.querySelector('a.download').href)).text()")
    return list(csv.DictReader(io.StringIO(text)))


HOLD = """() => {
  const send = Worker.prototype.postMessage;
  const held = [];
  Worker.prototype.postMessage = function (message, ...rest) {
    if (message.call === 'measure') held.push(() => send.call(this, message, ...rest));
    else send.call(this, message, ...rest);
  };
  window.release = () => {
    Worker.prototype.postMessage = send;
    for (const go of held) go();
  };
}"""
"""No tier is measured until `release()`, so that a hand is in time on the slowest machine."""


def test_every_ladder_of_the_book_offers_to_be_measured(visitor: Reader) -> None:
    visitor.turn_to(CHAPTER)
    benches = visitor.page.locator("ladder-bench")
    assert benches.count() >= len(json.loads(DATA.read_text(encoding="utf-8"))["ladders"])
    for index in range(benches.count()):
        assert benches.nth(index).get_attribute("data-state") == "idle"
        assert benches.nth(index).locator("button.run").is_enabled()


def test_measuring_adds_a_time_and_a_point_for_every_tier_and_moves_nothing(
    visitor: Reader, bench: Locator
) -> None:
    visitor.page.evaluate("window.shifts.length = 0")
    measure(visitor, bench)
    cells = bench.locator("td.own").all_inner_texts()
    assert all(float(text) > 0.0 for text in cells)
    assert bench.locator(".overlay .own polygon").count() == len(cells)
    assert bench.get_attribute("data-measured") == str(len(cells))
    own, drawn = bench.evaluate(HEIGHTS)
    assert own == pytest.approx(drawn, abs=2.0), "each level with the tier that it belongs to"
    moved = visitor.page.evaluate("window.shifts")
    assert sum(shift["value"] for shift in moved) < 0.01, moved
    assert_file_holds_what_was_measured(bench)


HEIGHTS = """bench => [['.own .spread', 'y1'], ['circle.hollow', 'cy']].map(([what, name]) =>
  [...bench.querySelectorAll(what)].map(mark => Number(mark.getAttribute(name))))"""


def assert_file_holds_what_was_measured(bench: Locator) -> None:
    """And the errors of the book."""
    rows = read_csv(bench)
    entry = json.loads(DATA.read_text(encoding="utf-8"))["ladders"][LADDER]
    assert [row["tier"] for row in rows] == list(entry["tiers"])
    for row in rows:
        low, middle, high = (
            float(row[f"{name} (ms)"]) for name in ("lower quartile", "median", "upper quartile")
        )
        assert 0.0 < low <= middle <= high
        for metric, unit in entry["metrics"].items():
            recorded = entry["tiers"][row["tier"]]["errors"][metric]
            assert close(float(row[f"{metric} ({unit})"]), recorded)


def test_a_reader_who_stops_by_keyboard_keeps_what_was_measured_and_never_has_a_dead_button(
    visitor: Reader, bench: Locator
) -> None:
    visitor.page.evaluate(HOLD)
    focused = "() => document.activeElement.className"
    bench.locator("button.run").press("Enter")
    assert visitor.page.evaluate(focused) == "stop"
    visitor.page.keyboard.press("Enter")
    visitor.page.evaluate("release()")
    wait_state(visitor, bench, "stopped")
    assert visitor.page.evaluate(focused) == "run"
    rows = bench.locator("td.own").all_inner_texts()
    measured = [text for text in rows if text != "–"]
    assert len(measured) < len(rows)
    assert str(len(measured)) in bench.locator(".ladder-status").inner_text()


def test_a_lost_worker_is_said_and_the_next_attempt_succeeds(
    visitor: Reader, bench: Locator
) -> None:
    visitor.page.evaluate("""() => {
      const send = Worker.prototype.postMessage;
      Worker.prototype.postMessage = function (message, ...rest) {
        if (message.call !== 'measure') return send.call(this, message, ...rest);
        Worker.prototype.postMessage = send;
        this.onerror(new ErrorEvent('error', {message: 'lost on purpose'}));
      };
    }""")
    bench.locator("button.run").click()
    wait_state(visitor, bench, "failed")
    assert "lost on purpose" in bench.locator(".ladder-status").inner_text()
    measure(visitor, bench)


def test_leaving_the_chapter_ends_the_measurement(visitor: Reader, bench: Locator) -> None:
    page = visitor.page
    page.evaluate(HOLD)
    bench.locator("button.run").click()
    wait_state(visitor, bench, "running")
    page.locator(".pager a[rel=prev]").click()
    page.evaluate("release()")
    page.wait_for_selector(f'main .pager a[href$="{CHAPTER}"]')
    visitor.wait_live()
    page.go_back()
    page.wait_for_selector(
        f'ladder-bench[data-ladder="{LADDER}"][data-state="idle"]', state="attached"
    )
