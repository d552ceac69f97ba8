"""The run of a ladder, computed when a test first needs it and shared by all tests."""

from functools import cache, cached_property
from importlib import import_module
from typing import Any

from simulations.registry import LADDER_MODULES, load_ladder


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
