"""Measure every ladder in CPython and in Chromium, or with ``--ladder ID`` one of them.

The two sides take turns, tier by tier and round by round, so that a busy minute of the machine
falls on both. What is found goes into ``content/measurements.json``, from which all numbers,
tables and charts of the book are made. A default that is no longer on the browser's front is
named at the end.
"""

import sys
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

from simulations.engine.ladder import Ladder, TierResult, measure_tier
from simulations.registry import LADDER_MODULES, load_ladder
from site_builder.bench.browser_side import browser_meter
from site_builder.bench.record import describe_machine, disagreements, ladder_record, merge, write
from site_builder.benchmarks.judgements import off_the_front
from site_builder.benchmarks.measurements import DATA, read_measurements
from site_builder.diagnostics import Diagnostics

ROUNDS = 5
BUDGET_S = 0.08
"""Time for the samples of one tier, on one side, in one round."""

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


def bench(root: Path, chosen: Sequence[str]) -> int:
    """Measure the ladders ``chosen`` of the book at ``root``, or all; 1 where something is to be
    said of what was found, else 0. Raises `MissingChromiumError`."""
    chosen = chosen or list(LADDER_MODULES)
    began, ladders, differing = time.perf_counter(), {}, []
    with browser_meter(root) as side:
        machine = describe_machine(side.browser, side.pyodide)
        for ladder in map(load_ladder, chosen):
            started = time.perf_counter()
            results = measure_ladder(ladder, (native_meter(ladder), side.measure))
            ladders[ladder.id] = ladder_record(ladder, results)
            differing += disagreements(ladder, results)
            print(f"{ladder.id:24} {time.perf_counter() - started:6.1f} s", flush=True)
    write(merge(root / DATA, machine, ladders, LADDER_MODULES), root / DATA)
    print(f"{DATA} written after {time.perf_counter() - began:.0f} s")
    complaints = differing + misplaced_defaults(root, chosen)
    print("\n".join(complaints), end="\n" if complaints else "", file=sys.stderr)
    return 1 if complaints else 0


def misplaced_defaults(root: Path, ladder_ids: Sequence[str]) -> list[str]:
    """What the new measurements say against the ladders' defaults."""
    measured = read_measurements(root, Diagnostics())
    return [said for name in ladder_ids if (said := off_the_front(measured.find(name)))]
