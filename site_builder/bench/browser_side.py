"""Chromium's half: the book's own worker on an empty page, without the book around it.

So the ladders can be measured while the book itself cannot be built for want of measurements.
"""

import json
import shutil
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import TYPE_CHECKING

from simulations.engine.ladder import TierResult
from site_builder.bench.scripts import write_scripts
from site_builder.editions.chromium import launch_arguments, require_chromium
from site_builder.runtime.pack import pack_runtime

if TYPE_CHECKING:
    from playwright.sync_api import Page

PAGE = '<!DOCTYPE html><meta charset="utf-8"><title>Bench</title><link rel="icon" href="data:,">'
MEASURE = """async (payload) => {
  const {Runtime} = await import(new URL('js/runtime/runtime.js', location.href).href);
  window.runtime ??= new Runtime(new URL('runtime/', location.href).href);
  return (await window.runtime.call('measure', payload)).result;
}"""


@dataclass(frozen=True, slots=True)
class BrowserSide:
    """A page with the interpreter in it."""

    page: "Page"
    browser: str
    """Name and major version."""
    pyodide: str

    def measure(self, ladder_id: str, tier_id: str, budget_s: float) -> TierResult:
        payload = {"ladder": ladder_id, "tier": tier_id, "budget": budget_s}
        return TierResult(**json.loads(self.page.evaluate(MEASURE, payload)))


@contextmanager
def browser_meter(root: Path) -> Iterator[BrowserSide]:
    found = require_chromium("the bench")
    from playwright.sync_api import sync_playwright

    with (
        tempfile.TemporaryDirectory() as folder,
        sync_playwright() as playwright,
        playwright.chromium.launch(executable_path=found, args=launch_arguments()) as browser,
    ):
        pyodide = _lay_out(root, Path(folder))
        with _serving(folder) as address:
            page = browser.new_page()
            page.set_default_timeout(0)
            page.goto(address)
            yield BrowserSide(page, f"Chromium {browser.version.split('.')[0]}", pyodide)


class _Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *_: object) -> None:
        """Nothing."""


@contextmanager
def _serving(folder: str) -> Iterator[str]:
    """The address at which the folder is served."""
    handler = partial(_Quiet, directory=folder)
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            yield f"http://localhost:{server.server_port}/"
        finally:
            server.shutdown()


def _lay_out(root: Path, site: Path) -> str:
    """An empty page with the runtime beside it. Returns Pyodide's version."""
    bundle = pack_runtime(root / "simulations")
    (site / "runtime").mkdir()
    for name, file in bundle.files.items():
        shutil.copyfile(file, site / "runtime" / name)
    write_scripts(root, site, ["runtime/runtime"])
    (site / "index.html").write_text(PAGE, encoding="utf-8")
    return bundle.versions.pyodide
