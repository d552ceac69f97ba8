"""A speed/accuracy ladder: the ways to compute one phenomenon, from cheap to expensive.

A ladder has tiers, a workload, a reference computed independently, and metrics with units. The
caller passes the clock for a measurement, so that the same code measures in CPython and in the
reader's browser.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

type Clock = Callable[[], float]
"""Seconds, from any origin."""

DRAWS = 64
"""Workloads over which a ladder's errors are compared: 16 seeds in each of 4 pictures, angles or
settings, or 64 of both at once."""


@dataclass(frozen=True, slots=True)
class Tier:
    """One way to compute the phenomenon."""

    id: str
    label: str
    cost: str
    """Work, independent of the machine: taps per pixel, iterations, rays."""
    run: Callable[[Any], Any]
    """Computes the result from the prepared workload."""


@dataclass(frozen=True, slots=True)
class Metric:
    """A distance between the results of a tier and of the reference."""

    id: str
    label: str
    unit: str
    measure: Callable[[Any, Any, Any], float]
    """Called with result, reference result and workload."""
    higher_is_better: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Ladder:
    """The tiers of one phenomenon, and how to measure them."""

    id: str
    title: str
    workload: str
    """Description of the workload and its size."""
    prepare: Callable[[], Any]
    """Makes the workload; not timed."""
    tiers: tuple[Tier, ...]
    """The tiers, from cheap to expensive."""
    reference: Callable[[Any], Any]
    reference_label: str
    """Description of the reference."""
    metrics: tuple[Metric, ...]
    """The first metric is shown in charts and decides the Pareto front."""
    default_tier: str
    """The tier that scenes use by default."""
    items: int = 0
    """Count of pixels or points of the workload; 0 if that is meaningless."""
    item: str = "pixel"
    """What is counted."""
    draw: Callable[[int], Any] | None = None
    """Makes a workload of the same kind with another seed, and another picture, angle or setting.
    Statements about the errors have to hold over `DRAWS` of them."""
    sampled: tuple[str, ...] = ()
    """Tiers whose error is the noise of a finite sample, which more work averages out. Their
    efficiency is relative to the first."""

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


@dataclass(frozen=True, slots=True, kw_only=True)
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
    """Measure the time and error of a tier: a warm-up run, then samples until the budget is spent.

    A sample lasts at least ``sample_s``, if need be over several runs: a browser's clock has a
    resolution of tenths of a millisecond.
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
    import statistics  # a large module, rarely needed

    low, _, high = statistics.quantiles(samples, n=4, method="inclusive")
    return TierResult(
        tier=tier_id,
        milliseconds=statistics.median(samples),
        low_ms=low,
        high_ms=high,
        repeats=len(samples),
        errors=errors,
    )


def errors_of_draws(
    ladder: Ladder, draw: Callable[[int], Any], count: int = DRAWS
) -> dict[str, dict[str, list[float]]]:
    """The errors of all tiers on ``count`` workloads, by metric and tier."""
    found: dict[str, dict[str, list[float]]] = {
        metric.id: {tier.id: [] for tier in ladder.tiers} for metric in ladder.metrics
    }
    for index in range(count):
        workload = draw(index)
        reference = ladder.reference(workload)
        for tier in ladder.tiers:
            result = tier.run(workload)
            for metric in ladder.metrics:
                error = float(metric.measure(result, reference, workload))
                found[metric.id][tier.id].append(error)
    return found


def _time_runs(tier: Tier, workload: Any, clock: Clock, runs: int) -> float:
    start = clock()
    for _ in range(runs):
        tier.run(workload)
    return clock() - start


def _runs_in_a_sample(tier: Tier, workload: Any, clock: Clock, sample_s: float) -> int:
    """Runs per sample: the smallest power of two that lasts long enough, at most 4096."""
    runs = 1
    while runs < 4096 and _time_runs(tier, workload, clock, runs) < sample_s:
        runs *= 2
    return runs


def pareto_front(points: Sequence[tuple[float, float]]) -> tuple[bool, ...]:
    """The Pareto front: whether no other (cost, loss) point is as good in both and better in
    one."""
    return tuple(
        not any(
            other[0] <= point[0] and other[1] <= point[1] and other != point for other in points
        )
        for point in points
    )
