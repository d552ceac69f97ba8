"""Ladders for tests: runs of the book's, and a toy whose measurements can be checked by eye."""

from functools import cache, cached_property
from importlib import import_module
from typing import Any

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.registry import LADDER_MODULES, UnknownIdError, load_ladder
from site_builder.benchmarks.measurements import Measurements

FILE = "content/measurements.json"
ERRORS = {"rough": 3.0, "fine": 0.02, "waste": 0.5, "exact": 0.0}
NATIVE_MS = {"rough": 0.5, "fine": 2.0, "waste": 4.0, "exact": 9.0}


def toy_ladder(ladder_id: str = "toy") -> Ladder:
    if ladder_id == "broken":
        raise ImportError("no module")
    if ladder_id != "toy":
        raise UnknownIdError(f"unknown ladder {ladder_id!r}; legal: toy")
    return Ladder(
        id="toy",
        title="Toy",
        workload="a number",
        prepare=lambda: 1.0,
        tiers=tuple(Tier(name, name.capitalize(), "1 step", lambda work: work) for name in ERRORS),
        reference=lambda workload: workload,
        reference_label="arithmetic",
        metrics=(
            Metric("rms", "RMS error", "px", lambda r, ref, _w: abs(r - ref)),
            Metric("psnr", "PSNR", "dB", lambda _r, _ref, _w: 30.0, higher_is_better=True),
        ),
        default_tier="fine",
    )


def timing(ms: float) -> dict[str, float]:
    return {"ms": ms, "low": 0.9 * ms, "high": 1.1 * ms, "samples": 9}


def toy_data() -> dict[str, Any]:
    return {
        "machine": {"processor": "abacus", "cores": 1, "browser": "Netscape 4"},
        "ladders": {
            "toy": {
                "workload": "a number",
                "metrics": {"rms": "px", "psnr": "dB"},
                "tiers": {
                    name: {
                        "errors": {"rms": error, "psnr": 30.0 - error if error else None},
                        "native": timing(NATIVE_MS[name]),
                        "browser": timing(3 * NATIVE_MS[name]),
                    }
                    for name, error in ERRORS.items()
                },
            }
        },
    }


def toy_measurements(**changes: Any) -> Measurements:
    data = toy_data()
    data["ladders"]["toy"] |= changes
    return Measurements(data["machine"], data["ladders"], toy_ladder)


class LadderRun:
    """A ladder's workload, its reference, and the result of each tier by its id."""

    def __init__(self, ladder_id: str) -> None:
        self.ladder = load_ladder(ladder_id)
        self.module: Any = import_module(LADDER_MODULES[ladder_id])
        self.metrics = {metric.id: metric.measure for metric in self.ladder.metrics}
        self.results: dict[str, Any] = {}

    @cached_property
    def work(self) -> Any:
        return self.ladder.prepare()

    @cached_property
    def truth(self) -> Any:
        return self.ladder.reference(self.work)

    def result(self, tier: str) -> Any:
        if tier not in self.results:
            self.results[tier] = self.ladder.tier(tier).run(self.work)
        return self.results[tier]

    def error(self, metric: str, tier: str) -> float:
        return self.metrics[metric](self.result(tier), self.truth, self.work)


run_of = cache(LadderRun)
