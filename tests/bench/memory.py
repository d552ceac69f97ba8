"""Memory leaks: ``PYTHONPATH=tests python -m bench.memory``.

One figure draws two thousand frames, and a hundred chapters are turned. After each quarter the
garbage is collected and the rest counted: the heap of the scripts, nodes of the page, listeners,
and the memory of the interpreter, which never shrinks and grows by a fifth at a time. The first
half fills the caches; growth in the second half beyond the limits is printed. The final numbers go
into ``content/costs.json``, which the book prints.
"""

import json
from collections.abc import Iterator, Sequence

from bench.costs import store_section
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
"""Pages that were left are freed step by step: one collection lets the next one free more."""
COUNTED = {"JSHeapUsedSize": "heap MB", "Nodes": "nodes", "JSEventListeners": "listeners"}
INTERPRETER = "interpreter MB"
MOST_GROWTH = {"heap MB": 0.05, "nodes": 0.01, "listeners": 0.0, INTERPRETER: 0.02}
"""Allowed growth in the second half, as a share; compiled code and the collector cause some."""
PRINTED_BY = "simulations.scenes.lens_distortion.stages:_encoded"
PRINTS = """def _encoded(photo):
    return to_rgba8(encode_srgb_table(photo.linear))

import pyodide_js
print(pyodide_js._module.HEAPU8.length)
"""
"""Prints while the edited module is executed, once for each new source."""
RUN_EDITED = """async ([edits]) => {
  const {internals} = await customElements.whenDefined('simulation-figure');
  const runtime = internals.sharedRuntime();
  const frame = {figure: 'memory', scene: 'lens-distortion', values: '{}', tier: '', edits};
  return await runtime.call('render_edited', frame);
}"""

type Usage = dict[str, float]


def usage(page: Page, number: int) -> Usage:
    """Memory of the page and its worker after garbage collection."""
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
    """Length of the interpreter's memory; ``number`` must differ between calls."""
    edits = json.dumps({PRINTED_BY: f"{PRINTS}# {number}\n"})
    answer = page.evaluate(RUN_EDITED, [edits])
    if answer["problem"]:
        raise RuntimeError(f"the interpreter printed nothing: {answer['problem']}")
    return int(answer["printed"])


def growth_over_limit(parts: Sequence[Usage]) -> Iterator[str]:
    """A line for each number that grew too much from the half to the last part."""
    half, last = parts[len(parts) // 2 - 1], parts[-1]
    for name, most in MOST_GROWTH.items():
        growth = last[name] / half[name] - 1
        if growth > most:
            yield f"{name}: {half[name]:g} to {last[name]:g}, {growth:.1%}; at most {most:.0%}"


def usage_after_frames(page: Page, address: str, url: str) -> Iterator[tuple[str, Usage]]:
    page.goto(address + url)
    figure, drag = figure_at_rest(page, SCENE), hand_script(page)
    for part in range(1, PARTS + 1):
        hand = {"name": CONTROL, "frames": FRAMES // PARTS}
        page.evaluate(EXERCISE, [drag, figure, hand])
        yield f"{part * FRAMES // PARTS} frames", usage(page, part)


def usage_after_turns(page: Page, address: str, urls: list[str]) -> Iterator[tuple[str, Usage]]:
    """Measured on the same chapter each time, since figures differ in size."""
    for turn in range(1, TURNS + 1):
        url = address + urls[turn % len(urls) if turn % (TURNS // PARTS) else 0]
        page.evaluate(TURN, url)
        page.wait_for_function("url => location.href === url", arg=url)
        if turn % (TURNS // PARTS) == 0:
            figure_at_rest(page, SCENE).dispose()  # a handle to a figure keeps its page in memory
            yield f"{turn} chapters", usage(page, FRAMES + turn)


def main() -> None:
    urls = [each["url"] for each in read_book()["chapters"] if each["simulations"]]
    urls.sort(key=lambda url: not url.startswith(SCENE))
    costs: dict[str, Usage] = {}
    with open_book() as (page, address):
        for name, parts in (
            ("frames", usage_after_frames(page, address, urls[0])),
            ("chapters", usage_after_turns(page, address, urls)),
        ):
            measured = []
            for label, found in parts:
                print(f"{label:24}", *(f"{n} {value:g}" for n, value in found.items()), flush=True)
                measured.append(found)
            grown = [*growth_over_limit(measured)]
            print(*grown or ["no memory leak"], sep="\n")
            costs[name] = as_cost(measured) | {"grown": len(grown)}
    store_section("memory", costs)


def as_cost(parts: Sequence[Usage]) -> dict[str, float]:
    """The final numbers in megabytes, and the largest growth since the half."""
    half, last = parts[len(parts) // 2 - 1], parts[-1]
    megabytes = {
        name.replace(" MB", "_mb"): round(value * 2**20 / 1e6, 1)
        for name, value in last.items()
        if name.endswith(" MB")
    }
    growth = max(last[name] / half[name] for name in MOST_GROWTH) - 1
    return {**megabytes, "growth": round(growth, 3)}


if __name__ == "__main__":
    main()
