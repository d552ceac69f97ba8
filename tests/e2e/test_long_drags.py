"""A slider in a restless hand: the last value is shown, and nothing piles up."""

from typing import Any

import pytest
from support.frames import frame_of, texts_of
from support.reader import Reader

from simulations.registry import load_scene

pytestmark = pytest.mark.browser

DRAG = """async ([count, last]) => {
  const figure = document.querySelector('[data-simulation="perspective-projection"]');
  const range = figure.querySelector('[name="depth"]');
  const pause = () => new Promise((resolve) => setTimeout(resolve, 5));
  for (let move = 1; move <= count; move += 1) {
    range.value = move < count ? 2 + (move % 40) / 10 : last;
    range.dispatchEvent(new Event("input", { bubbles: true }));
    await pause();
  }
  while (!figure.rests) await pause();
  return figure.querySelector('output[name="x"]').textContent;
}"""
METRICS = ("Nodes", "JSEventListeners")


def held(reader: Reader) -> dict[str, float]:
    """What the page holds once the garbage is gone."""
    session = reader.page.context.new_cdp_session(reader.page)
    session.send("HeapProfiler.collectGarbage")
    session.send("Performance.enable")
    metrics = session.send("Performance.getMetrics")["metrics"]
    session.detach()
    return {each["name"]: each["value"] for each in metrics if each["name"] in METRICS}


def test_a_burst_ends_at_its_last_value_and_leaves_nothing_behind(
    visitor: Reader, book: Any
) -> None:
    visitor.turn_to_figure(book, "perspective-projection")
    expected = texts_of(frame_of(load_scene("perspective-projection"), depth=7.3))["x"]
    assert visitor.page.evaluate(DRAG, [120, 7.3]) == expected
    before = held(visitor)
    assert visitor.page.evaluate(DRAG, [120, 7.3]) == expected
    after = held(visitor)
    assert after["JSEventListeners"] == before["JSEventListeners"]
    assert after["Nodes"] < before["Nodes"] + 15  # some thirty frames were painted
