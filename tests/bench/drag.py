"""How soon a figure follows a hand: ``PYTHONPATH=tests python -m bench.drag``.

Every slider of every scene of the built book is dragged from end to end and back by a script that
stands outside the book's own: ``js/drag.js``. A time runs from an event to the first animation
frame after the one that shows the answer, so that it is about a whole number of display frames.
A slider whose 95th percentile is beyond its scene's bound is named at the end. ``--scene`` measures
some scenes only; of all scenes, a summary goes into ``content/costs.json``.
"""

import argparse
import json
import statistics
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bench.costs import SITE, keep
from playwright.sync_api import JSHandle, Page
from support.chromium import open_chromium
from support.reader import DESK
from support.static_server import serving

from site_builder.benchmarks.measuring import significant

FRAME_MS = 1000 / 60
BOUND_FRAMES = 2
"""Display frames at the 95th percentile."""
BOUNDS = {"camera": 3, "depth-of-field": 3, "lens-distortion": 3}
"""Bounds of scenes that compute a whole camera."""
EARLY_MS = 1.0
"""An animation frame that comes so much late is still that frame."""
MOVES, ROUNDS = 6, 2
READ_MS = 2000
"""What a reader takes at least before a hand comes: drafts are computed meanwhile."""
DRAG = "([drag, figure, hand]) => drag.drag({...hand, figure})"
EXERCISE = "([drag, figure, hand]) => drag.exercise({...hand, figure})"
SCRIPTS = Path(__file__).parent / "js"
CENTRE = """figure => figure.scrollIntoView({block: 'center', behavior: 'instant'})"""
RESTS = """() => [...document.querySelectorAll('simulation-figure')]
  .every(figure => figure.dataset.state === 'live' && figure.rests)"""


@dataclass(frozen=True, slots=True)
class Latency:
    """A row of the table; times in milliseconds."""

    scene: str
    control: str
    moves: int
    median: float
    p95: float
    compute: float
    """Median in Python."""

    @property
    def bound_ms(self) -> float:
        return BOUNDS.get(self.scene, BOUND_FRAMES) * FRAME_MS

    @property
    def late(self) -> bool:
        """Whether the hand has to wait for the figure."""
        return self.p95 > self.bound_ms + EARLY_MS


def row(scene: str, control: str, latencies: list[float], computes: list[float]) -> Latency:
    """The figures of one slider's moves."""
    p95 = statistics.quantiles(latencies, n=20, method="inclusive")[-1]
    times = (statistics.median(latencies), p95, statistics.median(computes))
    return Latency(scene, control, len(latencies), *(round(time, 1) for time in times))


def line(found: Latency) -> str:
    mark = f"  over {found.bound_ms:.0f} ms" if found.late else ""
    return (
        f"{found.scene:24} {found.control:16} {found.moves:4} "
        f"{found.median:8.1f} {found.p95:8.1f} {found.compute:8.1f}{mark}"
    )


@contextmanager
def open_book() -> Iterator[tuple[Page, str]]:
    """A page, and the address of the built book."""
    with open_chromium() as browser, serving(SITE) as server:
        page = browser.new_page(viewport=DESK, service_workers="block", bypass_csp=True)
        page.set_default_timeout(60_000)
        yield page, server.url


def hand_script(page: Page, name: str = "drag.js") -> JSHandle:
    """The module ``js/NAME`` in the page; it goes with it."""
    source = (SCRIPTS / name).read_text(encoding="utf-8")
    return page.evaluate_handle(
        "source => import(URL.createObjectURL(new Blob([source], {type: 'text/javascript'})))",
        source,
    )


def figure_at_rest(page: Page, scene: str) -> JSHandle:
    """The figure of a scene in the middle of the window, when all of the page have their frames."""
    figure = page.query_selector(f'simulation-figure[data-simulation="{scene}"]')
    if figure is None:
        raise ValueError(f"scene {scene!r}; legal: one that this page shows")
    figure.evaluate(CENTRE)
    page.wait_for_function(RESTS)
    return figure


def measure(
    page: Page, address: str, book: Any, wanted: Sequence[str], rounds: int = ROUNDS
) -> Iterator[Latency]:
    """Each scene in the first chapter that shows it."""
    controls = {each["id"]: each["controls"] for each in book["simulations"]}
    waiting = set(wanted)
    for chapter in book["chapters"]:
        here = [scene for scene in chapter["simulations"] if scene in waiting]
        waiting.difference_update(here)
        if not here:
            continue
        page.goto(address + chapter["url"])
        drag = hand_script(page)
        for scene in here:
            figure = figure_at_rest(page, scene)
            page.wait_for_timeout(READ_MS)
            for control in controls[scene]:
                if control["kind"] == "slider":
                    hand = {"name": control["name"], "moves": MOVES, "rounds": rounds}
                    yield row(scene, control["name"], **page.evaluate(DRAG, [drag, figure, hand]))


def summary(rows: Sequence[Latency], slowest: Sequence[float], late: int) -> dict[str, float]:
    """All sliders in few numbers; ``slowest`` has one of each."""
    return {
        "sliders": len(rows),
        "late": late,
        "in_time": len(rows) - late,
        "median_ms": significant(statistics.median(found.median for found in rows), 3),
        "slowest_ms": significant(max(slowest), 3),
    }


def read_book() -> Any:
    """``book.json`` of the built book."""
    return json.loads((SITE / "book.json").read_text(encoding="utf-8"))


def main() -> int:
    parser = argparse.ArgumentParser(prog="bench.drag", description=__doc__)
    parser.add_argument("--scene", action="append", default=[])
    asked, book = parser.parse_args(), read_book()
    wanted = asked.scene or [each["id"] for each in book["simulations"]]
    print(f"{'scene':24} {'control':16} {'n':>4} {'median':>8} {'p95':>8} {'Python':>8}")
    rows = []
    with open_book() as (page, address):
        for found in measure(page, address, book, wanted):
            rows.append(found)
            print(line(found), flush=True)
    late = [found for found in rows if found.late]
    if not asked.scene:
        keep("frames", summary(rows, [found.p95 for found in rows], len(late)))
    print(f"{len(rows) - len(late)} of {len(rows)} sliders are followed in time")
    print(*(line(found) for found in late), sep="\n", end="\n" if late else "", file=sys.stderr)
    return 1 if late else 0


if __name__ == "__main__":
    raise SystemExit(main())
