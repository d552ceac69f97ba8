"""The book on a slow phone: ``PYTHONPATH=tests python -m bench.slow_phone``, on Linux.

The page and its workers are slowed down (``slowed.py``), on a phone's screen. Starts are measured
as by ``bench.start``, beside plain Pyodide slowed down as much; `bench.drag` measures sliders.
Medians go into ``content/costs.json``, which the book prints.
"""

import json
import statistics
from typing import Any

from bench.costs import store_section
from bench.slowed import slowed_down
from bench.start import Start, profiles
from bench.start import measure as measure_starts
from playwright.sync_api import Page

from site_builder.benchmarks.measuring import significant

SLOWDOWN = 7.5
PHONE: dict[str, Any] = {
    "viewport": {"width": 390, "height": 844},
    "device_scale_factor": 3,
    "is_mobile": True,
    "has_touch": True,
    "bypass_csp": True,
}
ROUNDS = 3
BUSY = """() => {
  const times = [];
  for (let round = 0, sum = 0; round < 200; round += 1) {
    const begun = performance.now();
    for (let turn = 0; turn < 2e6; turn += 1) sum += turn % 7;
    times.push(performance.now() - begun);
  }
  const sum = times.reduce((one, other) => one + other);
  return sum / times.length / Math.min(...times);
}"""
"""The ratio of the mean to the shortest time of a short loop."""
IN_WORKER = f"""() => new Promise((resolve) => {{
  const source = `postMessage(({BUSY})())`;
  new Worker(URL.createObjectURL(new Blob([source]))).onmessage = ({{data}}) => resolve(data);
}})"""
EARLY_MOVES = """async (name) => {
  const figure = document.querySelector('simulation-figure[data-prerendered]');
  figure.scrollIntoView({block: 'center', behavior: 'instant'});
  const slider = figure.querySelector(`input[name="${name}"]`);
  const frame = () => new Promise(requestAnimationFrame);
  figure.dispatchEvent(new TouchEvent('touchstart', {bubbles: true}));
  const times = [];
  for (const place of [0.1, 0.3, 0.5, 0.7, 0.9]) {
    const shown = figure.dataset.early;
    slider.value = String(Number(slider.min) + place * (slider.max - slider.min));
    const begun = performance.now();
    slider.dispatchEvent(new Event('input', {bubbles: true}));
    while (figure.dataset.early === shown && figure.dataset.state === 'starting') await frame();
    times.push(performance.now() - begun);
  }
  return figure.dataset.state === 'starting' ? times : null;
}"""
"""Move a figure's main slider while Python starts; returns milliseconds to each frame."""
PAINTED = "performance.getEntriesByName('first-contentful-paint')[0].startTime"


def slowness(start: Start, address: str) -> dict[str, float]:
    """The slowdown of work in a page and in a worker."""
    with start() as browser:
        page = browser.pages[0]
        page.goto(address + "404.html")
        found = {"page_times": page.evaluate(BUSY), "worker_times": page.evaluate(IN_WORKER)}
        return {name: significant(times, 2) for name, times in found.items()}


def measure_first(page: Page, address: str) -> dict[str, float]:
    """The time to the first paint, and the latency of a slider before Python runs."""
    painted: list[float] = []
    answers: list[float] = []
    for _ in range(ROUNDS):
        page.goto(f"{address}lens-distortion/", wait_until="commit")
        page.wait_for_selector("simulation-figure[data-state=starting]", state="attached")
        answers += page.evaluate(EARLY_MOVES, "k1") or []
        painted.append(page.evaluate(PAINTED))
    found = {"paint_ms": statistics.median(painted), "slider_ms": statistics.median(answers)}
    return {name: significant(ms, 3) for name, ms in found.items()}


def main() -> None:
    with profiles(*slowed_down(SLOWDOWN), **PHONE) as (slow, address):
        found: dict[str, Any] = slowness(slow, address)
        print(found, flush=True)
        found |= measure_starts(slow, address, ROUNDS)
        with slow(service_workers="block") as browser:
            found |= {"first": measure_first(browser.pages[0], address)}
    print(json.dumps(found, indent=1))
    store_section("slow_phone", found)


if __name__ == "__main__":
    main()
