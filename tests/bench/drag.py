"""How soon a figure follows a hand: ``PYTHONPATH=tests python -m bench.drag``.

Every slider of every scene of the built book is dragged from end to end and back by a script that
stands outside the book's own: ``js/drag.js``. A time runs from an event to the first animation
frame after the one that shows the answer, so that it is about a whole number of display frames.
A row says how many moves were answered later than the bound of the speed, and which level was shown
for most of them and at rest. All is measured at full speed and, on Linux, in browsers that are held
back (``slowed.py``). ``--scene`` measures some scenes only and ``--times`` some speeds; of all, a
summary goes into ``content/costs.json``.
"""

import argparse
import json
import statistics
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bench.costs import SITE, keep
from bench.slowed import held_back
from playwright.sync_api import JSHandle, Page
from support.chromium import open_chromium
from support.reader import DESK
from support.static_server import serving

from site_builder.benchmarks.measuring import significant

FRAME_MS = 1000 / 60
BOUNDS_MS = {1.0: 2 * FRAME_MS, 4.0: 67.0, 7.5: 150.0}
"""Bound of the 95th percentile, by how many times the browser is held back."""
EARLY_MS = 1.0
"""An animation frame that comes so much late is still that frame."""
MOVES, ROUNDS = 6, 2
READ_MS = 2000
"""What a reader takes at least before a hand comes: a frame may be computed ahead meanwhile."""
LONGEST_MS = 120_000
DRAG = "([drag, figure, hand]) => drag.drag({...hand, figure})"
EXERCISE = "([drag, figure, hand]) => drag.exercise({...hand, figure})"
SCRIPTS = Path(__file__).parent / "js"
SHOW = """figure => {
  for (let at = figure; at; at = at.parentElement) if (at.matches('details')) at.open = true;
  figure.scrollIntoView({block: 'center', behavior: 'instant'});
}"""
RESTS = """() => [...document.querySelectorAll('simulation-figure')]
  .filter(figure => !figure.closest('details:not([open])'))
  .every(figure => figure.dataset.state === 'live' && figure.rests)"""
"""A figure in a section that is folded up does not start."""


@dataclass(frozen=True, slots=True)
class Drag:
    """A slider dragged from end to end and back; times in milliseconds, one of each move."""

    scene: str
    control: str
    times: float
    """How many times the browser was held back."""
    latencies: Sequence[float]
    computes: Sequence[float]
    """In Python."""
    levels: Sequence[str]
    """What was shown; empty where the scene has only one level."""
    rest: str
    """The level at rest."""

    @property
    def median(self) -> float:
        return statistics.median(self.latencies)

    @property
    def p95(self) -> float:
        return statistics.quantiles(self.latencies, n=20, method="inclusive")[-1]

    @property
    def level(self) -> str:
        """The level of most moves."""
        return statistics.mode(self.levels)

    @property
    def late_moves(self) -> int:
        return sum(latency > BOUNDS_MS[self.times] + EARLY_MS for latency in self.latencies)

    @property
    def late(self) -> bool:
        """Whether the hand has to wait for the figure."""
        return self.p95 > BOUNDS_MS[self.times] + EARLY_MS


HEADING = (
    f"{'scene':24} {'control':16} {'times':>5} {'late':>7} {'median':>7} {'p95':>7} {'Python':>7}"
    "  moving -> at rest"
)


def line(found: Drag) -> str:
    late = f"{found.late_moves}/{len(found.latencies)}"
    levels = f"{found.level} -> {found.rest}" if found.rest else "one level"
    mark = f"  over {BOUNDS_MS[found.times]:.0f} ms" if found.late else ""
    return (
        f"{found.scene:24} {found.control:16} {found.times:5g} {late:>7} {found.median:7.1f} "
        f"{found.p95:7.1f} {statistics.median(found.computes):7.1f}  {levels}{mark}"
    )


@contextmanager
def open_book(times: float = 1.0) -> Iterator[tuple[Page, str]]:
    """A page of a browser that is held back, and the address of the built book."""
    with open_chromium(*held_back(times)) as browser, serving(SITE) as server:
        page = browser.new_page(
            viewport=DESK,
            service_workers="block",
            bypass_csp=True,
            reduced_motion="reduce",  # nothing moves but what the script drags
        )
        page.set_default_timeout(LONGEST_MS)
        yield page, server.url


def hand_script(page: Page, name: str = "drag.js") -> JSHandle:
    """The module ``js/NAME`` in the page; it goes with it."""
    source = (SCRIPTS / name).read_text(encoding="utf-8")
    return page.evaluate_handle(
        "source => import(URL.createObjectURL(new Blob([source], {type: 'text/javascript'})))",
        source,
    )


def figure_at_rest(page: Page, scene: str) -> JSHandle:
    """The figure of a scene in the middle of the window, its section unfolded, when all figures
    that may start have their frames."""
    figure = page.query_selector(f'simulation-figure[data-simulation="{scene}"]')
    if figure is None:
        raise ValueError(f"scene {scene!r}; legal: one that this page shows")
    figure.evaluate(SHOW)
    page.wait_for_function(RESTS)
    return figure


def measure(
    page: Page, address: str, book: Any, wanted: Sequence[str], times: float
) -> Iterator[Drag]:
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
                    hand = {"name": control["name"], "moves": MOVES, "rounds": ROUNDS}
                    found = page.evaluate(DRAG, [drag, figure, hand])
                    yield Drag(scene, control["name"], times, **found)


def summary(rows: Sequence[Drag]) -> dict[str, float]:
    """All sliders in few numbers."""
    late = sum(found.late for found in rows)
    return {
        "sliders": len(rows),
        "late": late,
        "in_time": len(rows) - late,
        "at_rest": sum(found.level == found.rest for found in rows),
        "median_ms": significant(statistics.median(found.median for found in rows), 3),
        "slowest_ms": significant(max(found.p95 for found in rows), 3),
    }


def read_book() -> Any:
    """``book.json`` of the built book."""
    return json.loads((SITE / "book.json").read_text(encoding="utf-8"))


def main() -> None:
    parser = argparse.ArgumentParser(prog="bench.drag", description=__doc__)
    parser.add_argument("--scene", action="append", default=[])
    parser.add_argument("--times", action="append", default=[], type=float, choices=BOUNDS_MS)
    asked, book = parser.parse_args(), read_book()
    wanted = asked.scene or [each["id"] for each in book["simulations"]]
    print(HEADING)
    found: dict[str, dict[str, float]] = {}
    for times in asked.times or BOUNDS_MS:
        rows = []
        with open_book(times) as (page, address):
            for each in measure(page, address, book, wanted, times):
                rows.append(each)
                print(line(each), flush=True)
        found[f"{times:g}"] = summary(rows)
        print(f"held back {times:g} times: {json.dumps(found[f'{times:g}'])}", flush=True)
    if not asked.scene and not asked.times:
        keep("drags", found)


if __name__ == "__main__":
    main()
