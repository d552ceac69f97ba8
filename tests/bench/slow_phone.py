"""The book on a slow phone: ``PYTHONPATH=tests python -m bench.slow_phone``, on Linux.

Page and workers run at a sixth of their speed (``slowed.py``), on a phone's screen. Starts are
measured as by ``bench.start``, beside plain Pyodide under the same throttle, and drags as by
``bench.drag``, a script's hand at every slider. Medians go to what pages cost, for the book to
tell.
"""

import json
import statistics
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from bench.costs import keep
from bench.drag import EXERCISE, Latency, figure_at_rest, hand_script, read_book, summary
from bench.drag import measure as measure_drags
from bench.start import Start, profiles
from bench.start import measure as measure_starts
from playwright.sync_api import Page

from site_builder.benchmarks.measuring import significant

TIMES = 6
SLOWED = f"{sys.executable} {Path(__file__).with_name('slowed.py')} {TIMES}"
PHONE: dict[str, Any] = {
    "viewport": {"width": 390, "height": 844},
    "device_scale_factor": 3,
    "is_mobile": True,
    "has_touch": True,
    "bypass_csp": True,
}
BOUND_MS = 250
"""Within which half of the moves of a slider are answered."""
FRAMES, ROUNDS = 60, 3
DRAWN = {"light": ("perspective-projection", "depth"), "middle": ("lens-distortion", "k1")}
DRAWN["heavy"] = ("camera", "focal_length")
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
"""How many times as long as at its best a short loop takes."""
IN_WORKER = f"""() => new Promise((resolve) => {{
  const source = `postMessage(({BUSY})())`;
  new Worker(URL.createObjectURL(new Blob([source]))).onmessage = ({{data}}) => resolve(data);
}})"""
EARLY = """async (name) => {
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
"""A hand at a figure's main slider while Python starts: milliseconds to each frame."""
INTERPRETERS = """async () => {
  const {inside} = await customElements.whenDefined('simulation-figure');
  return inside.sharedRuntime().generation;
}"""
PAINTED = "performance.getEntriesByName('first-contentful-paint')[0].startTime"


def slowness(start: Start, address: str) -> dict[str, float]:
    """How many times as long work takes in a page and in a worker."""
    with start() as browser:
        page = browser.pages[0]
        page.goto(address + "404.html")
        found = {"page_times": page.evaluate(BUSY), "worker_times": page.evaluate(IN_WORKER)}
        return {name: significant(times, 2) for name, times in found.items()}


def measure_first(page: Page, address: str) -> dict[str, float]:
    """When text is on the screen, and how soon a slider answers before Python runs."""
    painted: list[float] = []
    answers: list[float] = []
    for _ in range(ROUNDS):
        page.goto(f"{address}lens-distortion/", wait_until="commit")
        page.wait_for_selector("simulation-figure[data-state=starting]", state="attached")
        answers += page.evaluate(EARLY, "k1") or []
        painted.append(page.evaluate(PAINTED))
    found = {"paint_ms": statistics.median(painted), "slider_ms": statistics.median(answers)}
    return {name: significant(ms, 3) for name, ms in found.items()}


def measure_frames(page: Page, address: str, book: Any) -> dict[str, dict[str, float]]:
    """Frames a second of three figures."""
    found = {}
    for kind, (scene, control) in DRAWN.items():
        page.goto(address + next(c["url"] for c in book["chapters"] if scene in c["simulations"]))
        drag, figure = hand_script(page), figure_at_rest(page, scene)
        hand = {"name": control, "frames": FRAMES}
        page.evaluate(EXERCISE, [drag, figure, hand])  # until machine code is there
        begun = page.evaluate("performance.now()")
        page.evaluate(EXERCISE, [drag, figure, hand])
        seconds = (page.evaluate("performance.now()") - begun) / 1000
        found[kind] = {"rate": significant(FRAMES / seconds, 2)}
    return found


def drag_summary(rows: Sequence[Latency]) -> dict[str, float]:
    medians = [found.median for found in rows]
    return summary(rows, medians, sum(median > BOUND_MS for median in medians))


def main() -> int:
    book = read_book()
    with profiles(f"--renderer-cmd-prefix={SLOWED}", **PHONE) as (slow, address):
        found: dict[str, Any] = slowness(slow, address)
        print(found, flush=True)
        found |= measure_starts(slow, address, ROUNDS)
        with slow(service_workers="block") as browser:
            page = browser.pages[0]
            found |= {"first": measure_first(page, address)}
            found |= measure_frames(page, address, book)
            rows, interpreters = [], 1
            scenes = [each["id"] for each in book["simulations"]]
            for row in measure_drags(page, address, book, scenes, rounds=1):
                rows.append(row)
                interpreters = max(interpreters, page.evaluate(INTERPRETERS))
                late = f"  over {BOUND_MS} ms" if row.median > BOUND_MS else ""
                print(f"{row.scene:24} {row.control:16} {row.median:8.1f}{late}", flush=True)
    found |= {"drags": drag_summary(rows), "ended": interpreters - 1}
    print(json.dumps(found, indent=1))
    keep("slow_phone", found)
    return 1 if found["ended"] or found["drags"]["late"] else 0


if __name__ == "__main__":
    raise SystemExit(main())
