"""The run of a ladder, computed when a test first needs it and not when tests are collected."""

from collections.abc import Callable
from functools import cached_property
from typing import Any

from simulations.engine.ladder import Ladder


class LadderRun:
    """A ladder's workload, its reference, and the result of each tier by its id."""

    def __init__(self, ladder: Ladder) -> None:
        self.ladder = ladder

    @cached_property
    def work(self) -> Any:
        return self.ladder.prepare()

    @cached_property
    def truth(self) -> Any:
        return self.ladder.reference(self.work)

    @cached_property
    def results(self) -> dict[str, Any]:
        return {tier.id: tier.run(self.work) for tier in self.ladder.tiers}

    def measured(self, metric: Callable[[Any, Any, Any], float]) -> dict[str, float]:
        """What a metric says of each tier, by the tier's id."""
        return {name: metric(got, self.truth, self.work) for name, got in self.results.items()}
