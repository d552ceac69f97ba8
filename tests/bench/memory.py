"""Whether anything piles up: ``PYTHONPATH=tests python -m bench.memory``.

One figure draws two thousand frames, and a hundred chapters are turned; after each part of it the
garbage is collected and what is left is counted: the heap of the scripts, nodes of the page,
listeners, and the memory of the interpreter, which never shrinks.
"""

import argparse
import json
from collections.abc import Iterator
from pathlib import Path

from bench.built_book import figure_at_rest, open_book, script
from playwright.sync_api import Page

from site_builder.book_root import ROOT

FRAMES, TURNS, PARTS = 2000, 100, 4
SCENE, CONTROL = "lens-distortion", "k1"
EXERCISE = "([drag, figure, hand]) => drag.exercise({...hand, figure})"
TURN = """url => {
  const link = Object.assign(document.createElement('a'), {href: url});
  document.body.append(link);
  link.click();
  link.remove();
}"""
COUNTED = {"JSHeapUsedSize": "heap MB", "Nodes": "nodes", "JSEventListeners": "listeners"}


def held(page: Page) -> dict[str, float]:
    """What the page and its worker hold once the garbage is gone."""
    session = page.context.new_cdp_session(page)
    session.send("HeapProfiler.collectGarbage")
    session.send("Performance.enable")
    metrics = session.send("Performance.getMetrics")["metrics"]
    session.detach()
    found = {COUNTED[each["name"]]: each["value"] for each in metrics if each["name"] in COUNTED}
    found["heap MB"] = round(found["heap MB"] / 2**20, 2)
    return found


def tell(what: str, found: dict[str, float]) -> None:
    print(f"{what:24}", *(f"{name} {value:g}" for name, value in found.items()), flush=True)


def drawn(page: Page, address: str, url: str) -> Iterator[tuple[str, dict[str, float]]]:
    page.goto(address + url)
    figure, drag = figure_at_rest(page, SCENE), script(page, "drag.js")
    yield "at rest", held(page)
    for part in range(1, PARTS + 1):
        hand = {"name": CONTROL, "frames": FRAMES // PARTS}
        page.evaluate(EXERCISE, [drag, figure, hand])
        yield f"{part * FRAMES // PARTS} frames", held(page)


def turned(page: Page, address: str, urls: list[str]) -> Iterator[tuple[str, dict[str, float]]]:
    """The same chapter after each part: others have figures of their own size."""
    for turn in range(1, TURNS + 1):
        url = address + urls[turn % len(urls) if turn % (TURNS // PARTS) else 0]
        page.evaluate(TURN, url)
        page.wait_for_function("url => location.href === url", arg=url)
        if turn % (TURNS // PARTS) == 0:
            figure_at_rest(page, SCENE)
            yield f"{turn} chapters", held(page)


def main() -> None:
    parser = argparse.ArgumentParser(prog="bench.memory", description=__doc__)
    parser.add_argument("--site", type=Path, default=ROOT / "build" / "site")
    site = parser.parse_args().site
    chapters = json.loads((site / "book.json").read_text(encoding="utf-8"))["chapters"]
    urls = [each["url"] for each in chapters if each["simulations"]]
    urls.sort(key=lambda url: not url.startswith(SCENE))
    with open_book(site) as (page, address):
        for what, found in drawn(page, address, urls[0]):
            tell(what, found)
        for what, found in turned(page, address, urls):
            tell(what, found)


if __name__ == "__main__":
    main()
