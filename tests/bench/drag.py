"""Latency of figures while a slider is dragged: ``PYTHONPATH=tests python -m bench.drag``.

Every slider of every scene of the built book is dragged from end to end and back by a script
independent of the book's (``js/drag.js``). A latency is the time from an event to the first
animation frame after the one that shows the result, so that it is about a whole number of display
frames. A row has the number of moves beyond the bound of the speed, the level of most moves and the
level at rest. All sliders are measured at full speed; then, on Linux, the slowest of each scene in
slowed browsers (``slowed.py``), where all would take an hour. ``--scene`` measures some scenes only
and ``--times`` all their sliders at these speeds; otherwise a summary goes into
``content/costs.json``.
"""

import argparse
import json
import statistics
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bench.costs import SITE, store_section
from bench.slowed import slowed_down
from playwright.sync_api import JSHandle, Page
from support.chromium import open_chromium
from support.reader import DESK
from support.static_server import serving

from site_builder.benchmarks.measuring import significant

FRAME_MS = 1000 / 60
BOUNDS_MS = {1.0: 2 * FRAME_MS, 4.0: 67.0, 7.5: 150.0}
"""Bound of the 95th percentile, by the slowdown of the browser."""
TOLERANCE_MS = 1.0
"""Jitter allowed in the time of an animation frame."""
MOVES, ROUNDS = 6, 2
READ_MS = 2000
"""The pause before the first drag, in which a frame may be computed in advance."""
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
"""Figures in folded sections do not start."""


@dataclass(frozen=True, slots=True)
class Drag:
    """A slider dragged from end to end and back, with times of each move in milliseconds."""

    scene: str
    control: str
    times: float
    """The slowdown of the browser."""
    latencies: Sequence[float]
    computes: Sequence[float]
    """Computing times in Python."""
    levels: Sequence[str]
    """The levels shown; empty if the scene has only one."""
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
        return sum(latency > BOUNDS_MS[self.times] + TOLERANCE_MS for latency in self.latencies)

    @property
    def late(self) -> bool:
        """Whether the 95th percentile is beyond the bound."""
        return self.p95 > BOUNDS_MS[self.times] + TOLERANCE_MS


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
    """A page of a browser slowed down ``times`` times, and the address of the built book."""
    with open_chromium(*slowed_down(times)) as browser, serving(SITE) as server:
        page = browser.new_page(
            viewport=DESK,
            service_workers="block",
            bypass_csp=True,
            reduced_motion="reduce",  # no motion except the script's
        )
        page.set_default_timeout(LONGEST_MS)
        yield page, server.url


def hand_script(page: Page, name: str = "drag.js") -> JSHandle:
    """The module ``js/NAME``, imported in the page."""
    source = (SCRIPTS / name).read_text(encoding="utf-8")
    return page.evaluate_handle(
        "source => import(URL.createObjectURL(new Blob([source], {type: 'text/javascript'})))",
        source,
    )


def figure_at_rest(page: Page, scene: str) -> JSHandle:
    """The figure of a scene in the middle of the window, with its section unfolded, once all
    visible figures are at rest."""
    figure = page.query_selector(f'simulation-figure[data-simulation="{scene}"]')
    if figure is None:
        raise ValueError(f"scene {scene!r}; legal: one that this page shows")
    figure.evaluate(SHOW)
    page.wait_for_function(RESTS)
    return figure


def measure(
    page: Page, address: str, book: Any, wanted: Mapping[str, Sequence[str]], times: float
) -> Iterator[Drag]:
    """Measure these sliders, by scene, in the first chapter that shows the scene."""
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
            for name in wanted[scene]:
                hand = {"name": name, "moves": MOVES, "rounds": ROUNDS}
                found = page.evaluate(DRAG, [drag, figure, hand])
                yield Drag(scene, name, times, **found)


def sliders_of(book: Any, scenes: Sequence[str]) -> dict[str, list[str]]:
    """The names of the sliders of these scenes, or of all if there are none, by scene."""
    return {
        each["id"]: [slider["name"] for slider in each["controls"] if slider["kind"] == "slider"]
        for each in book["simulations"]
        if not scenes or each["id"] in scenes
    }


def slowest_sliders(rows: Sequence[Drag]) -> dict[str, list[str]]:
    """The slider of each scene whose 95th percentile is the highest."""
    return {row.scene: [row.control] for row in sorted(rows, key=lambda row: row.p95)}


def summary(rows: Sequence[Drag]) -> dict[str, float]:
    """Statistics of all sliders."""
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
    arguments, book = parser.parse_args(), read_book()
    wanted = sliders_of(book, arguments.scene)
    print(HEADING)
    found: dict[str, dict[str, float]] = {}
    for times in arguments.times or BOUNDS_MS:
        rows = []
        with open_book(times) as (page, address):
            for each in measure(page, address, book, wanted, times):
                rows.append(each)
                print(line(each), flush=True)
        found[f"{times:g}"] = summary(rows)
        print(f"slowed {times:g} times: {json.dumps(found[f'{times:g}'])}", flush=True)
        if not arguments.times:
            wanted = slowest_sliders(rows)
    if not arguments.scene and not arguments.times:
        store_section("drags", found)


if __name__ == "__main__":
    main()
