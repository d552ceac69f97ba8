"""A speed/accuracy ladder: the ways to compute one phenomenon, from cheap to dear.

A ladder states its tiers, a workload, a reference that comes by a route of its own, and
metrics with units. Measuring one takes a clock from outside, so that this module stays pure
and the same code measures in CPython and in the reader's browser.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

type Clock = Callable[[], float]
"""Seconds, from any origin."""


@dataclass(frozen=True, slots=True)
class Tier:
    """One way to compute the phenomenon."""

    id: str
    label: str
    cost: str
    """Work that does not depend on the machine: taps a pixel, iterations, rays."""
    run: Callable[[Any], Any]
    """From the prepared workload to a result that the metrics can compare."""


@dataclass(frozen=True, slots=True)
class Metric:
    """A distance between a tier's result and the reference's."""

    id: str
    label: str
    unit: str
    measure: Callable[[Any, Any, Any], float]
    """Called with result, reference result and workload."""
    higher_is_better: bool = False


@dataclass(frozen=True, slots=True)
class Ladder:
    """The tiers of one phenomenon and how to judge them."""

    id: str
    title: str
    workload: str
    """What is computed, with its size, in words."""
    prepare: Callable[[], Any]
    """Builds the workload; never timed."""
    tiers: tuple[Tier, ...]
    """Cheap to dear."""
    reference: Callable[[Any], Any]
    reference_label: str
    """Where the truth comes from, in words."""
    metrics: tuple[Metric, ...]
    """The first is the one that charts show and that decides the Pareto front."""
    default_tier: str
    """What scenes settle in."""
    items: int = 0
    """How many pixels or points the workload has; 0 where that says nothing."""
    item: str = "pixel"
    """What they are."""
    sampled: tuple[str, ...] = ()
    """Tiers whose error is the noise of a finite sample, which more work averages out. The first is
    the unit of their efficiency."""

    def __post_init__(self) -> None:
        ids = [tier.id for tier in self.tiers]
        if len(set(ids)) != len(ids) or self.default_tier not in ids:
            raise ValueError(
                f"ladder {self.id!r}: tiers {ids}, default {self.default_tier!r}; "
                "legal: ids that differ, and a default among them"
            )

    def tier(self, tier_id: str) -> Tier:
        for tier in self.tiers:
            if tier.id == tier_id:
                return tier
        legal = ", ".join(tier.id for tier in self.tiers)
        raise ValueError(f"ladder {self.id!r} has no tier {tier_id!r}; legal: {legal}")


@dataclass(frozen=True, slots=True)
class TierResult:
    """One measured tier."""

    tier: str
    milliseconds: float
    """Median over the repeats."""
    low_ms: float
    """Lower quartile."""
    high_ms: float
    """Upper quartile."""
    repeats: int
    """Samples taken."""
    errors: Mapping[str, float]
    """Metric id to value."""


def measure_tier(
    ladder: Ladder,
    tier_id: str,
    workload: Any,
    reference: Any,
    clock: Clock,
    *,
    budget_s: float = 0.4,
    sample_s: float = 0.004,
    at_least: int = 5,
    at_most: int = 200,
) -> TierResult:
    """Time and judge one tier: one warm-up run, then samples until the budget is spent.

    A sample is at least ``sample_s`` long, several runs where one is quicker: the clock of a
    browser ticks in tenths of a millisecond.
    """
    tier = ladder.tier(tier_id)
    result = tier.run(workload)
    errors = {
        metric.id: float(metric.measure(result, reference, workload)) for metric in ladder.metrics
    }
    runs = _runs_in_a_sample(tier, workload, clock, sample_s)
    samples: list[float] = []
    begun = clock()
    while len(samples) < at_most and (len(samples) < at_least or clock() - begun < budget_s):
        samples.append(_time_runs(tier, workload, clock, runs) / runs * 1e3)
    import statistics  # long, and rarely needed

    low, _, high = statistics.quantiles(samples, n=4, method="inclusive")
    return TierResult(tier_id, statistics.median(samples), low, high, len(samples), errors)


def _time_runs(tier: Tier, workload: Any, clock: Clock, runs: int) -> float:
    start = clock()
    for _ in range(runs):
        tier.run(workload)
    return clock() - start


def _runs_in_a_sample(tier: Tier, workload: Any, clock: Clock, sample_s: float) -> int:
    """The smallest power of two whose runs together last long enough; 4096 at most."""
    runs = 1
    while runs < 4096 and _time_runs(tier, workload, clock, runs) < sample_s:
        runs *= 2
    return runs


def pareto_front(points: Sequence[tuple[float, float]]) -> tuple[bool, ...]:
    """Which (cost, loss) points no other point beats: none is as good in both and better in one."""
    return tuple(
        not any(
            other[0] <= point[0] and other[1] <= point[1] and other != point for other in points
        )
        for point in points
    )
