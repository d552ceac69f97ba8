"""Measure all ladders in CPython and in Chromium, or one with ``--ladder ID``.

Chromium's half is the book's own worker on an empty page, so that the ladders can be measured
while the book itself cannot be built for want of measurements.

The two sides take turns, tier by tier and round by round, so that a busy minute of the machine
falls on both. The errors on other draws of the workload are computed in CPython alone; with
``--errors`` only these and those of the workload are computed, and the times are kept. What is
found goes into ``content/measurements.json``, from which all numbers, tables and charts of the book
are made; ``measurements.py``, which reads it, describes it. A default that is no longer on the
browser's front is named at the end.
"""

import json
import math
import os
import platform
import shutil
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from simulations.engine.ladder import Ladder, TierResult, errors_of_draws, measure_tier
from simulations.registry import LADDER_MODULES, load_ladder
from site_builder.benchmarks.judgements import off_the_front
from site_builder.benchmarks.measurements import COMMAND, DATA, read_measurements
from site_builder.cache.hashing import book_hash
from site_builder.files.folders import replace_file
from site_builder.files.text import Sources
from site_builder.programs.chromium import launch_arguments, require_chromium
from site_builder.runtime.pack import pack_runtime

if TYPE_CHECKING:
    from playwright.sync_api import Page

RELATIVE = 0.01
"""How far one error may differ between two machines."""
SMALL, FACTOR = 1e-3, 3.0
"""Errors this small, in the units of any metric, come from rounding. They depend on the order in
which a library adds, and on the last place of its powers and sines: up to this factor."""
NOTHING = 1e-9
"""Errors below this are alike, zero included."""
WIDTH = 100
"""Most characters in a line of the recorded files."""
ONE_LINE = ("draws", "levels")
"""Names of many numbers that nobody reads."""

type Draws = Mapping[str, Mapping[str, Sequence[float]]]
"""Errors by metric, tier and draw."""


def describe_machine(browser: str, pyodide: str) -> dict[str, object]:
    """What the numbers were measured on, in general terms: no names, no paths."""
    return {
        "processor": platform.machine(),
        "cores": os.cpu_count() or 1,
        "system": platform.system(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "browser": browser,
        "pyodide": pyodide,
    }


def ladder_record(
    ladder: Ladder, results: Sequence[Sequence[Sequence[TierResult]]], draws: Draws
) -> Any:
    """One ladder's entry. ``results`` goes by tier, side (native, browser) and round."""
    return {
        "workload": ladder.workload,
        "metrics": {metric.id: metric.unit for metric in ladder.metrics},
        "tiers": {
            tier.id: {
                "errors": {name: finite(value) for name, value in native[0].errors.items()},
                "native": timing(native),
                "browser": timing(browser),
            }
            for tier, (native, browser) in zip(ladder.tiers, results, strict=True)
        },
        "draws": draws_record(draws),
    }


def draws_record(draws: Draws) -> Any:
    """Errors of all draws, to four digits."""
    return {
        metric: {tier: [finite(value, 4) for value in values] for tier, values in tiers.items()}
        for metric, tiers in draws.items()
    }


def timing(rounds: Sequence[TierResult]) -> dict[str, float]:
    """Median and quartiles of the quietest round: whatever else the machine had to do in the
    others says nothing about the tier."""
    quietest = min(rounds, key=lambda one: one.milliseconds)
    return {
        "ms": significant(quietest.milliseconds, 3),
        "low": significant(quietest.low_ms, 3),
        "high": significant(quietest.high_ms, 3),
        "samples": quietest.repeats,
    }


def significant(value: float, digits: int) -> float:
    return float(f"{value:.{digits}g}")


def finite(value: float | None, digits: int = 6) -> float | None:
    """So many digits; null for an infinite ratio of signal to noise, that is: no error at all."""
    if value is None or math.isinf(value):
        return None
    if math.isnan(value):
        raise ValueError("an error is NaN; legal: a number, or infinity where there is no error")
    return significant(value, digits)


def disagreements(ladder: Ladder, results: Sequence[Sequence[Sequence[TierResult]]]) -> list[str]:
    """Errors that differ between CPython and the browser, as messages."""
    found = []
    for tier, (native, browser) in zip(ladder.tiers, results, strict=True):
        for name, value in native[0].errors.items():
            ours, theirs = finite(value), finite(browser[0].errors[name])
            if not close(ours, theirs):
                place = f"{ladder.id} {tier.id} {name}"
                found.append(f"{place}: {ours} in CPython, {theirs} in the browser")
    return found


def close(one: float | None, other: float | None, relative: float = RELATIVE) -> bool:
    """Whether two machines, or two programs for the same method, found the same error."""
    if one is None or other is None:
        return one is other
    low, high = sorted((abs(one), abs(other)))
    if high < SMALL:
        return high < NOTHING or high < FACTOR * low
    return math.isclose(one, other, rel_tol=relative)


def merge(
    file: Path, machine: Mapping[str, object], ladders: Mapping[str, Any], known: Collection[str]
) -> dict[str, Any]:
    """New measurements over old ones, which keep their places in the file; new ladders come behind
    them. The old must be of the same machine; those of ladders that are not ``known`` are dropped.
    """
    old = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    kept = old.get("ladders", {})
    if kept and not set(known) <= set(ladders) and old["machine"] != machine:
        raise SystemExit(f"{file.name} was measured on another machine: run `{COMMAND}` for all")
    found = {**kept, **ladders}
    return {
        "machine": dict(machine),
        "ladders": {name: entry for name, entry in found.items() if name in known},
    }


def write(data: Mapping[str, Any], file: Path) -> None:
    """An object stands on one line where it fits; otherwise each of its values begins a line, but
    for those in `ONE_LINE`."""
    replace_file(file, f"{_laid_out(data)}\n".encode())


def _laid_out(value: Any, depth: int = 0, before: int = 0) -> str:
    """``value`` as JSON, ``depth`` objects deep, behind ``before`` characters of its line."""
    flat = json.dumps(value, ensure_ascii=False, allow_nan=False)
    if not isinstance(value, Mapping) or before + len(flat) < WIDTH:
        return flat
    lines = []
    for name, inner in value.items():
        key = f"{' ' * (depth + 1)}{json.dumps(name, ensure_ascii=False)}: "
        flat = json.dumps(inner, ensure_ascii=False, allow_nan=False)
        lines.append(key + (flat if name in ONE_LINE else _laid_out(inner, depth + 1, len(key))))
    return "{\n" + ",\n".join(lines) + f"\n{' ' * depth}}}"


ROUNDS = 5
BUDGET_S = 0.08
"""Time for the samples of one tier, on one side, in one round."""

PAGE = '<!DOCTYPE html><meta charset="utf-8"><title>Bench</title><link rel="icon" href="data:,">'
MEASURE = """async (payload) => {
  const {Runtime} = await import(new URL('js/runtime/runtime.js', location.href).href);
  window.runtime ??= new Runtime(new URL('runtime/', location.href).href, () => []);
  return (await window.runtime.call('measure', payload)).result;
}"""

type WriteScripts = Callable[[Path, Path, Iterable[str]], None]
"""Writes scripts of the book at one folder, such as ``page/text``, into a site at another."""
type Meter = Callable[[str, str, float], TierResult]
"""Measures one tier of one ladder within a budget in seconds."""


def native_meter(ladder: Ladder) -> Meter:
    workload: Any = ladder.prepare()
    reference = ladder.reference(workload)
    return lambda _ladder_id, tier_id, budget_s: measure_tier(
        ladder, tier_id, workload, reference, time.perf_counter, budget_s=budget_s
    )


def measure_ladder(ladder: Ladder, meters: Sequence[Meter]) -> list[list[list[TierResult]]]:
    """Results by tier, meter and round; every other round goes from dear to cheap."""
    results: list[list[list[TierResult]]] = [[[] for _ in meters] for _ in ladder.tiers]
    indices = range(len(ladder.tiers))
    for round_number in range(ROUNDS):
        order: Iterable[int] = reversed(indices) if round_number % 2 else indices
        for index in order:
            for meter, found in zip(meters, results[index], strict=True):
                found.append(meter(ladder.id, ladder.tiers[index].id, BUDGET_S))
    return results


def measure_errors(root: Path, chosen: Sequence[str]) -> int:
    """Compute the errors of the ladders ``chosen`` anew, or of all, and keep their times. Returns 1
    where a default is off the front, else 0."""
    chosen = chosen or list(LADDER_MODULES)
    data = json.loads((root / DATA).read_text(encoding="utf-8"))
    for ladder in map(load_ladder, chosen):
        entry, meter = data["ladders"][ladder.id], native_meter(ladder)
        entry["tiers"] = {tier.id: entry["tiers"][tier.id] for tier in ladder.tiers}
        for tier_id, tier in entry["tiers"].items():
            errors = meter(ladder.id, tier_id, 0.0).errors
            tier["errors"] = {name: finite(value) for name, value in errors.items()}
        entry["draws"] = draws_record(_draws(ladder))
        entry["sources"] = book_hash(LADDER_MODULES[ladder.id])
        print(ladder.id, flush=True)
    write(data, root / DATA)
    return _report(misplaced_defaults(root, chosen))


def _draws(ladder: Ladder) -> dict[str, dict[str, list[float]]]:
    return errors_of_draws(ladder, ladder.draw) if ladder.draw else {}


def _report(complaints: Sequence[str]) -> int:
    print("\n".join(complaints), end="\n" if complaints else "", file=sys.stderr)
    return 1 if complaints else 0


def bench(root: Path, chosen: Sequence[str], write_scripts: WriteScripts) -> int:
    """Measure the ladders ``chosen`` of the book at ``root``, or all. Returns 1 where the two sides
    disagree or a default is off the front, else 0. Raises `MissingChromiumError`."""
    chosen = chosen or list(LADDER_MODULES)
    began, ladders, differing = time.perf_counter(), {}, []
    with browser_meter(root, write_scripts) as side:
        machine = describe_machine(side.browser, side.pyodide)
        for ladder in map(load_ladder, chosen):
            started = time.perf_counter()
            results = measure_ladder(ladder, (native_meter(ladder), side.measure))
            ladders[ladder.id] = {
                "sources": book_hash(LADDER_MODULES[ladder.id]),
                **ladder_record(ladder, results, _draws(ladder)),
            }
            differing += disagreements(ladder, results)
            print(f"{ladder.id:24} {time.perf_counter() - started:6.1f} s", flush=True)
    write(merge(root / DATA, machine, ladders, LADDER_MODULES), root / DATA)
    print(f"{DATA} written after {time.perf_counter() - began:.0f} s")
    return _report(differing + misplaced_defaults(root, chosen))


def misplaced_defaults(root: Path, ladder_ids: Sequence[str]) -> list[str]:
    """What the new measurements say against the ladders' defaults."""
    measured = read_measurements(Sources(root))
    return [said for name in ladder_ids if (said := off_the_front(measured.find(name)))]


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
def browser_meter(root: Path, write_scripts: WriteScripts) -> Iterator[BrowserSide]:
    found = require_chromium("the bench")
    from playwright.sync_api import sync_playwright

    with (
        tempfile.TemporaryDirectory() as folder,
        sync_playwright() as playwright,
        playwright.chromium.launch(executable_path=found, args=launch_arguments()) as browser,
    ):
        pyodide = _lay_out(root, Path(folder))
        write_scripts(root, Path(folder), ["runtime/runtime"])
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
    (site / "index.html").write_text(PAGE, encoding="utf-8")
    return bundle.versions.pyodide
