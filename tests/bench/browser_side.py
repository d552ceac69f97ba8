"""Chromium's half: the book's own worker on an empty page, without the book around it.

So the ladders can be measured while the book itself cannot be built for want of measurements.
"""

import json
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import Page
from support.chromium import open_chromium
from support.scripts import write_scripts
from support.static_server import serving

from simulations.engine.ladder import TierResult
from site_builder.runtime.pack import pack_runtime

PAGE = '<!DOCTYPE html><meta charset="utf-8"><title>Bench</title><link rel="icon" href="data:,">'
MEASURE = """async (payload) => {
  const {Runtime} = await import(new URL('js/runtime/runtime.js', location.href).href);
  window.runtime ??= new Runtime(new URL('runtime/', location.href).href);
  return (await window.runtime.call('measure', payload)).result;
}"""


@dataclass(frozen=True, slots=True)
class BrowserSide:
    """A page with the interpreter in it."""

    page: Page
    browser: str
    """Name and major version."""
    pyodide: str

    def measure(self, ladder_id: str, tier_id: str, budget_s: float) -> TierResult:
        payload = {"ladder": ladder_id, "tier": tier_id, "budget": budget_s}
        return TierResult(**json.loads(self.page.evaluate(MEASURE, payload)))


@contextmanager
def browser_meter(root: Path) -> Iterator[BrowserSide]:
    with tempfile.TemporaryDirectory() as folder, open_chromium() as browser:
        pyodide = _lay_out(root, Path(folder))
        with serving(Path(folder)) as server:
            page = browser.new_page()
            page.set_default_timeout(0)
            page.goto(server.url)
            yield BrowserSide(page, f"Chromium {browser.version.split('.')[0]}", pyodide)


def _lay_out(root: Path, site: Path) -> str:
    """An empty page with the runtime beside it. Returns Pyodide's version."""
    bundle = pack_runtime(root / "simulations")
    (site / "runtime").mkdir()
    for name, file in bundle.files.items():
        shutil.copyfile(file, site / "runtime" / name)
    write_scripts(root, site, ["runtime/runtime"])
    (site / "index.html").write_text(PAGE, encoding="utf-8")
    return bundle.versions.pyodide
