"""From results to ``content/measurements.json``; what it holds is described in
``site_builder/benchmarks/measurements.py``, which reads it."""

import json
import math
import os
import platform
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from simulations.engine.ladder import Ladder, TierResult
from site_builder.benchmarks.measurements import COMMAND

RELATIVE = 0.01
"""How far one error may differ between two machines."""
SMALL, FACTOR = 1e-3, 3.0
"""Errors this small, in the units of any metric, come from rounding. They depend on the order in
which a library adds, and on the last place of its powers and sines: up to this factor."""
NOTHING = 1e-9
"""Errors below this are alike, zero included."""
WIDTH = 100
"""Most characters in a line of the recorded files."""


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


def ladder_record(ladder: Ladder, results: Sequence[Sequence[Sequence[TierResult]]]) -> Any:
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


def finite(value: float | None) -> float | None:
    """Six digits; null for an infinite ratio of signal to noise, that is: no error at all."""
    if value is None or math.isinf(value):
        return None
    if math.isnan(value):
        raise ValueError("an error is NaN; legal: a number, or infinity where there is no error")
    return significant(value, 6)


def disagreements(ladder: Ladder, results: Sequence[Sequence[Sequence[TierResult]]]) -> list[str]:
    """Errors on which CPython and the browser do not agree: then one of them is not understood."""
    found = []
    for tier, (native, browser) in zip(ladder.tiers, results, strict=True):
        for name, value in native[0].errors.items():
            ours, theirs = finite(value), finite(browser[0].errors[name])
            if not close(ours, theirs):
                place = f"{ladder.id} {tier.id} {name}"
                found.append(f"{place}: {ours} in CPython, {theirs} in the browser")
    return found


def close(one: float | None, other: float | None) -> bool:
    """Whether two machines found the same error."""
    if one is None or other is None:
        return one is other
    low, high = sorted((abs(one), abs(other)))
    if high < SMALL:
        return high < NOTHING or high < FACTOR * low
    return math.isclose(one, other, rel_tol=RELATIVE)


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
    """An object stands on one line where it fits; otherwise each of its values begins a line."""
    file.write_text(_laid_out(data) + "\n", encoding="utf-8")


def _laid_out(value: Any, depth: int = 0, before: int = 0) -> str:
    """``value`` as JSON, ``depth`` objects deep, behind ``before`` characters of its line."""
    flat = json.dumps(value, ensure_ascii=False, allow_nan=False)
    if not isinstance(value, Mapping) or before + len(flat) < WIDTH:
        return flat
    lines = []
    for name, inner in value.items():
        key = f"{' ' * (depth + 1)}{json.dumps(name, ensure_ascii=False)}: "
        lines.append(key + _laid_out(inner, depth + 1, len(key)))
    return "{\n" + ",\n".join(lines) + f"\n{' ' * depth}}}"
