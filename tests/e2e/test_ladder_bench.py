"""Measuring a ladder on the reader's device: points, times, a file, and stopping."""

import csv
import io
import json
from typing import Any

import pytest
from playwright.sync_api import Locator, expect
from support.places import ROOT
from support.reader import Reader

from site_builder.benchmarks.measuring import close

pytestmark = pytest.mark.browser

CHAPTER = "speed-and-accuracy/"
LADDER = "rotation-interpolation"
"""A ladder with quick tiers."""
RECORDED = json.loads((ROOT / "content" / "measurements.json").read_text("utf-8"))["ladders"]


@pytest.fixture
def bench(visitor: Reader) -> Locator:
    visitor.turn_to(CHAPTER)
    found = visitor.page.locator(f'ladder-bench[data-ladder="{LADDER}"]').first
    found.evaluate("bench => { bench.closest('details').open = true; }")
    return found


def expect_state(bench: Locator, expected: str) -> None:
    expect(bench).to_have_attribute("data-state", expected)


def test_measuring_adds_a_time_and_a_point_per_tier_and_moves_nothing(
    visitor: Reader, bench: Locator
) -> None:
    """Every ladder can be measured, and after a lost worker the next attempt succeeds."""
    page, run = visitor.page, bench.locator("button.run")
    benches = page.locator("ladder-bench")
    assert benches.count() >= len(RECORDED)
    assert benches.evaluate_all(OFFERED) == [["idle", True]] * benches.count()
    page.evaluate(LOSE)
    run.click()
    expect_state(bench, "failed")
    assert "lost on purpose" in bench.locator(".ladder-status").inner_text()
    page.evaluate("window.shifts.length = 0")
    run.click()
    expect_state(bench, "done")
    cells = bench.locator("td.own").all_inner_texts()
    assert all(float(text) > 0.0 for text in cells)
    assert bench.locator(".overlay .own polygon").count() == len(cells)
    assert bench.get_attribute("data-measured") == str(len(cells))
    own, drawn = bench.evaluate(HEIGHTS)
    assert own == pytest.approx(drawn, abs=2.0), "each level with its tier"
    moved = page.evaluate("window.shifts")
    assert sum(shift["value"] for shift in moved) < 0.01, moved

    entry: Any = RECORDED[LADDER]
    text = bench.evaluate("async (b) => (await fetch(b.querySelector('a.download').href)).text()")
    rows = list(csv.DictReader(io.StringIO(text)))
    assert [row["tier"] for row in rows] == list(entry["tiers"])
    for row in rows:
        low, middle, high = (
            float(row[f"{name} (ms)"]) for name in ("lower quartile", "median", "upper quartile")
        )
        assert 0.0 < low <= middle <= high
        for metric, unit in entry["metrics"].items():
            recorded = entry["tiers"][row["tier"]]["errors"][metric]
            assert close(float(row[f"{metric} ({unit})"]), recorded)


OFFERED = """(benches) => benches.map(
  (bench) => [bench.dataset.state, !bench.querySelector('button.run').disabled])"""
LOSE = """() => {
  const send = Worker.prototype.postMessage;
  Worker.prototype.postMessage = function (message, ...rest) {
    if (message.call !== 'measure') return send.call(this, message, ...rest);
    Worker.prototype.postMessage = send;
    this.onerror(new ErrorEvent('error', {message: 'lost on purpose'}));
  };
}"""
HEIGHTS = """bench => [['.own .spread', 'y1'], ['circle.hollow', 'cy']].map(([what, name]) =>
  [...bench.querySelectorAll(what)].map(mark => Number(mark.getAttribute(name))))"""


def test_measurement_is_stopped_by_keyboard_or_by_leaving_the_chapter(
    visitor: Reader, bench: Locator
) -> None:
    """Finished measurements are kept, and buttons stay usable."""
    page, run = visitor.page, bench.locator("button.run")
    page.evaluate(HOLD)
    run.press("Enter")
    expect(bench.locator("button.stop")).to_be_focused()
    page.keyboard.press("Enter")
    page.evaluate("release()")
    expect_state(bench, "stopped")
    expect(run).to_be_focused()
    rows = bench.locator("td.own").all_inner_texts()
    measured = [text for text in rows if text != "–"]
    assert len(measured) < len(rows)
    assert str(len(measured)) in bench.locator(".ladder-status").inner_text()
    page.evaluate(HOLD)
    run.click()
    expect_state(bench, "running")
    page.locator(".pager a[rel=prev]").click()
    page.evaluate("release()")
    page.wait_for_selector(f'main .pager a[href$="{CHAPTER}"]')
    visitor.wait_live()
    page.go_back()
    expect_state(bench, "idle")


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
"""No tier is measured until `release()`, so that the test is in time on the slowest machine."""
