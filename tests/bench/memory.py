"""Whether anything piles up: ``PYTHONPATH=tests python -m bench.memory``.

One figure draws two thousand frames, and a hundred chapters are turned; after each part of it the
garbage is collected and what is left is counted: the heap of the scripts, nodes of the page,
listeners, and the memory of the interpreter, which never shrinks and grows by a fifth at a time.
The first half fills what is kept on purpose; what has grown from there to the end is named. What is
held in the end goes to what pages cost, which the book prints.
"""

import json
from collections.abc import Iterator, Sequence

from bench.costs import keep
from bench.drag import EXERCISE, figure_at_rest, hand_script, open_book, read_book
from playwright.sync_api import Page

FRAMES, TURNS, PARTS = 2000, 100, 4
SCENE, CONTROL = "lens-distortion", "k1"
TURN = """url => {
  const link = Object.assign(document.createElement('a'), {href: url});
  document.body.append(link);
  link.click();
  link.remove();
}"""
COLLECTIONS, REST_MS = 3, 1000
"""Pages that were turned go bit by bit: what one collection frees lets the next one free more."""
COUNTED = {"JSHeapUsedSize": "heap MB", "Nodes": "nodes", "JSEventListeners": "listeners"}
INTERPRETER = "interpreter MB"
MOST_GROWTH = {"heap MB": 0.05, "nodes": 0.01, "listeners": 0.0, INTERPRETER: 0.02}
"""Share of what was there at half: what compiled code and the collector leave open."""
PRINTED_BY = "simulations.scenes.lens_distortion.stages:_encoded"
PRINTS = """def _encoded(photo):
    return to_rgba8(encode_srgb_table(photo.linear))

import pyodide_js
print(pyodide_js._module.HEAPU8.length)
"""
"""Printed while the edited module is executed, which happens anew for every other text."""
ASK = """async ([edits]) => {
  const {inside} = await customElements.whenDefined('simulation-figure');
  const runtime = inside.sharedRuntime();
  const frame = {figure: 'memory', scene: 'lens-distortion', values: '{}', tier: '', edits};
  return await runtime.call('render_edited', frame);
}"""

type Held = dict[str, float]


def held(page: Page, number: int) -> Held:
    """What the page and its worker hold once the garbage is gone."""
    interpreter = interpreter_bytes(page, number)
    session = page.context.new_cdp_session(page)
    for _ in range(COLLECTIONS):
        page.wait_for_timeout(REST_MS)
        session.send("HeapProfiler.collectGarbage")
    session.send("Performance.enable")
    metrics = session.send("Performance.getMetrics")["metrics"]
    session.detach()
    found = {COUNTED[each["name"]]: each["value"] for each in metrics if each["name"] in COUNTED}
    found["heap MB"] = round(found["heap MB"] / 2**20, 2)
    found[INTERPRETER] = round(interpreter / 2**20, 2)
    return found


def interpreter_bytes(page: Page, number: int) -> int:
    """Length of the interpreter's memory; ``number`` is another with each call."""
    edits = json.dumps({PRINTED_BY: f"{PRINTS}# {number}\n"})
    answer = page.evaluate(ASK, [edits])
    if answer["problem"]:
        raise RuntimeError(f"the interpreter printed nothing: {answer['problem']}")
    return int(answer["printed"])


def grown(parts: Sequence[Held]) -> Iterator[str]:
    """What is more after the last part than at half, by more than it may be."""
    half, last = parts[len(parts) // 2 - 1], parts[-1]
    for name, most in MOST_GROWTH.items():
        growth = last[name] / half[name] - 1
        if growth > most:
            yield f"{name}: {half[name]:g} to {last[name]:g}, {growth:.1%}; at most {most:.0%}"


def drawn(page: Page, address: str, url: str) -> Iterator[tuple[str, Held]]:
    page.goto(address + url)
    figure, drag = figure_at_rest(page, SCENE), hand_script(page)
    for part in range(1, PARTS + 1):
        hand = {"name": CONTROL, "frames": FRAMES // PARTS}
        page.evaluate(EXERCISE, [drag, figure, hand])
        yield f"{part * FRAMES // PARTS} frames", held(page, part)


def turned(page: Page, address: str, urls: list[str]) -> Iterator[tuple[str, Held]]:
    """The same chapter after each part: others have figures of their own size."""
    for turn in range(1, TURNS + 1):
        url = address + urls[turn % len(urls) if turn % (TURNS // PARTS) else 0]
        page.evaluate(TURN, url)
        page.wait_for_function("url => location.href === url", arg=url)
        if turn % (TURNS // PARTS) == 0:
            figure_at_rest(page, SCENE).dispose()  # a handle to a figure keeps its page in memory
            yield f"{turn} chapters", held(page, FRAMES + turn)


def main() -> None:
    urls = [each["url"] for each in read_book()["chapters"] if each["simulations"]]
    urls.sort(key=lambda url: not url.startswith(SCENE))
    costs: dict[str, Held] = {}
    with open_book() as (page, address):
        for name, parts in (
            ("frames", drawn(page, address, urls[0])),
            ("chapters", turned(page, address, urls)),
        ):
            kept = []
            for what, found in parts:
                print(
                    f"{what:24}", *(f"{one} {value:g}" for one, value in found.items()), flush=True
                )
                kept.append(found)
            more = [*grown(kept)]
            print(*more or ["nothing piles up"], sep="\n")
            costs[name] = as_cost(kept) | {"grown": len(more)}
    keep("memory", costs)


def as_cost(parts: Sequence[Held]) -> dict[str, float]:
    """What is held in the end, and how much more that is than at half."""
    half, last = parts[len(parts) // 2 - 1], parts[-1]
    megabytes = {
        name.replace(" MB", "_mb"): round(held * 2**20 / 1e6, 1)
        for name, held in last.items()
        if name.endswith(" MB")
    }
    growth = max(last[name] / half[name] for name in MOST_GROWTH) - 1
    return {**megabytes, "growth": round(growth, 3)}


if __name__ == "__main__":
    main()
