"""The time until a figure is live, compared with plain Pyodide drawing the same frame.

``PYTHONPATH=tests python -m bench.start``, with a built book in ``build/site``. The book and the
plain page are measured alternately, so that other work on the machine affects both. Each run starts
in a fresh browser profile (cold); the page is opened again in that profile (warm) and turned to the
next chapter, where a slider is moved at once. The plain page follows Pyodide's documentation: it
loads Pyodide, numpy and the modules, imports them, and draws. It has the files of Pyodide's
release, from the same server.

Medians and ratios go into ``content/costs.json``, which the book prints.
"""

import json
import shutil
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any

from bench.costs import SITE, store_section
from playwright.sync_api import BrowserContext, BrowserType, sync_playwright
from support.chromium import HOW_TO, find_chromium, launch_arguments
from support.places import ROOT
from support.reader import DESK
from support.static_server import serving

from simulations.registry import scene_module
from site_builder.benchmarks.measuring import significant
from site_builder.runtime.downloads import fetch_runtime
from site_builder.runtime.imports import imports_of, reach
from site_builder.runtime.pack import book_modules, chunk_archive
from site_builder.runtime.store import LOCK_INFO, NUMPY_WHEEL, VERSIONS

SCENE = "lens-distortion"
REST_MS = 4000
"""The pause before a page is turned, in which the book may prepare the next one."""
LONGEST_MS = 60_000
ROUNDS = 5
PLAIN = "plain/"
STORED = "navigator.serviceWorker.controller !== null"
"""True once the browser has stored the whole book."""

type Run = dict[str, float]
"""Milliseconds, by the name of the measurement."""
type Start = Callable[..., AbstractContextManager[BrowserContext]]

RECORD_TIMES = """(() => {
  const Plain = globalThis.Worker;
  globalThis.Worker = class extends Plain {
    constructor(...given) {
      globalThis.workerBegun ??= performance.now();
      super(...given);
    }
  };
  new MutationObserver((changes) => {
    if (changes.some(({target}) => target.dataset?.state === 'live')) {
      globalThis.lived ??= performance.now();
    }
  }).observe(document, {subtree: true, attributeFilter: ['data-state']});
})()"""
"""In every page: records when its worker begins and when its first figure is live."""

TURN = """() => {
  const begun = performance.now();
  globalThis.lived = undefined;
  new MutationObserver((_, observer) => {
    if (!globalThis.lived) return;
    observer.disconnect();
    globalThis.turned = globalThis.lived - begun;
    const figure = document.querySelector('simulation-figure[data-state=live]');
    const slider = figure.querySelector('input[type=range]');
    const touched = performance.now();
    new MutationObserver(() => { globalThis.touched = performance.now() - touched; })
      .observe(figure, {attributeFilter: ['data-frames']});
    slider.stepUp();
    slider.dispatchEvent(new Event('input', {bubbles: true}));
  }).observe(document, {subtree: true, attributeFilter: ['data-state']});
  document.querySelector('.pager a[rel=next]').click();
}"""
"""Turn the page, and move a slider of its first live figure at once."""

PLAIN_PAGE = """<!DOCTYPE html>
<meta charset="utf-8"><title>Plain</title><link rel="icon" href="data:,">
<script type="module">
  import {loadPyodide} from './pyodide.mjs';
  const pyodide = await loadPyodide({packages: ['numpy']});
  pyodide.unpackArchive(await (await fetch('simulations.zip')).arrayBuffer(), 'zip');
  const frame = pyodide.runPython(`
from simulations.engine.stages import StageCache
from MODULE import SCENE
cache = StageCache()
def frame(name=None, value=None):
    accuracy, values = SCENE.accuracy, {} if name is None else {name: value}
    tier = accuracy.default if name is None else accuracy.cheapest
    return SCENE.render(SCENE.check(values), tier, cache)
frame`);
  const show = ({panels}) => {
    document.body.replaceChildren();
    for (const panel of panels) {
      const box = document.createElement('div');
      box.innerHTML = `<svg viewBox="0 0 ${panel.width} ${panel.height}">${panel.overlay}</svg>`;
      if (panel.raster) {
        const {data, shape: [height, width]} = panel.raster.getBuffer('u8clamped');
        const canvas = Object.assign(document.createElement('canvas'), {width, height});
        canvas.getContext('2d').putImageData(new ImageData(data.slice(), width, height), 0, 0);
        box.prepend(canvas);
      }
      document.body.append(box);
    }
  };
  show(frame());
  globalThis.draw = (name, value) => show(frame(name, value));
  globalThis.lived = performance.now();
</script>
"""
"""The plain page."""


def main() -> None:
    with profiles() as (start, address):
        record = measure(start, address, ROUNDS)
    print(json.dumps(record, indent=1))
    store_section("start", record)


@contextmanager
def profiles(*arguments: str, **device: Any) -> Iterator[tuple[Start, str]]:
    """A function that starts a browser with a fresh profile, and the address of the book."""
    executable = find_chromium()
    if executable is None:
        raise SystemExit(HOW_TO)
    with sync_playwright() as playwright, serve_with_plain_page() as address:
        yield partial(profile, playwright.chromium, str(executable), *arguments, **device), address


def measure(start: Start, address: str, rounds: int) -> dict[str, Any]:
    """Measure the book and the plain page alternately."""
    runs: list[Run] = []
    for _ in range(rounds):
        runs.append({**measure_book(start, address), **measure_plain(start, address)})
        print(" ".join(f"{name} {value:.0f}" for name, value in runs[-1].items()), flush=True)
    return summary(runs)


def summary(runs: Sequence[Run]) -> dict[str, Any]:
    """Medians, and the ratios of the book's starts to plain Pyodide's."""
    found = {name: median(run[name] for run in runs) for name in runs[0]}
    starts = {
        kind: {
            "ms": significant(found[kind], 3),
            "plain_ms": significant(found[f"plain {kind}"], 3),
            "ratio": significant(found[kind] / found[f"plain {kind}"], 3),
        }
        for kind in ("cold", "warm")
    }
    rest = {f"{name}_ms": significant(found[name], 3) for name in ("worker", "turned", "touched")}
    return {**starts, **rest}


def measure_book(start: Start, address: str) -> Run:
    """Both starts of a chapter, the turn to the next one, and the first move of a slider there."""
    chapter = address + "lens-distortion/"
    with start() as browser:
        cold = time_to_live(browser, chapter)
        page = browser.pages[-1]
        begun = page.evaluate("globalThis.workerBegun")
        page.wait_for_timeout(REST_MS)
        page.wait_for_function(STORED, polling=1000)
        page.wait_for_timeout(REST_MS)
        warm = time_to_live(browser, chapter)
        page.wait_for_timeout(REST_MS)
        page.evaluate(TURN)
        page.wait_for_function("globalThis.touched")
        turned, touched = page.evaluate("[globalThis.turned, globalThis.touched]")
        return {"worker": begun, "cold": cold, "warm": warm, "turned": turned, "touched": touched}


def measure_plain(start: Start, address: str) -> Run:
    """Both starts of the plain page."""
    with start() as browser:
        cold = time_to_live(browser, address + PLAIN)
        browser.pages[-1].wait_for_timeout(REST_MS)
        return {"plain cold": cold, "plain warm": time_to_live(browser, address + PLAIN)}


def time_to_live(browser: BrowserContext, address: str) -> float:
    """Milliseconds until the first figure of the browser's only page is live."""
    page = browser.pages[0]
    page.goto("about:blank")
    page.goto(address)
    page.wait_for_function("globalThis.lived")
    return float(page.evaluate("globalThis.lived"))


@contextmanager
def profile(
    chromium: BrowserType, executable: str, *arguments: str, **device: Any
) -> Iterator[BrowserContext]:
    """A browser with a fresh profile, which stores files as a reader's does."""
    given = [*launch_arguments(), *arguments]
    with tempfile.TemporaryDirectory() as folder:
        context = chromium.launch_persistent_context(
            folder, executable_path=executable, args=given, **{"viewport": DESK, **device}
        )
        try:
            context.set_default_timeout(LONGEST_MS)
            context.add_init_script(RECORD_TIMES)
            yield context
        finally:
            context.close()


@contextmanager
def serve_with_plain_page() -> Iterator[str]:
    """The address of the built book, with the plain page beside it."""
    with tempfile.TemporaryDirectory() as folder:
        served = Path(folder) / "site"
        shutil.copytree(SITE, served)
        write_plain_page(served / PLAIN)
        with serving(served) as server:
            yield server.url


def write_plain_page(folder: Path) -> None:
    """Write the plain page with Pyodide's release, the scene's modules and a table of packages."""
    folder.mkdir()
    fetched = fetch_runtime()
    for file in fetched.values():
        shutil.copyfile(file, folder / file.name)
    numpy = {
        "name": "numpy", "version": VERSIONS.numpy, "file_name": NUMPY_WHEEL.name,
        "sha256": NUMPY_WHEEL.sha256, "install_dir": "site", "package_type": "package",
        "imports": ["numpy"], "depends": [],
    }  # fmt: skip
    lock = {"info": LOCK_INFO, "packages": {"numpy": numpy}}
    (folder / "pyodide-lock.json").write_text(json.dumps(lock), encoding="utf-8")
    modules = book_modules(ROOT / "simulations")
    used = reach(imports_of(modules), scene_module(SCENE))
    (folder / "simulations.zip").write_bytes(chunk_archive(modules, used))
    page = PLAIN_PAGE.replace("MODULE", scene_module(SCENE))
    (folder / "index.html").write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
