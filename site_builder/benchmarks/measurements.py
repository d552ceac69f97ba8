"""What the ladders were measured to cost and to get wrong: ``content/measurements.json``.

``python -m site_builder bench`` writes the file::

    {"machine": {"processor", "cores", "system", "python", "numpy", "browser", "pyodide"},
     "ladders": {LADDER: {
        "sources": str,    their hash when it was measured
        "workload": str,   as the ladder states it
        "metrics": {METRIC: unit},
        "tiers": {TIER: {
           "errors": {METRIC: number or null},   null: no error that the metric could see
           "native": {"ms", "low", "high", "samples"},    median and quartiles of
           "browser": {"ms", "low", "high", "samples"}}},    the quietest round
        "draws": {METRIC: {TIER: [number or null, …]}}}}}    on other workloads of the same kind

Every number about speed or accuracy in the book is read through this module. What
no longer fits the ladders' code is refused when a page asks for it; a warning names ladders whose
sources have changed.
"""

import json
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.engine.ladder import Ladder, Metric, Tier, pareto_front
from simulations.registry import LADDER_MODULES, load_ladder
from site_builder.cache.hashing import book_hash
from site_builder.diagnostics.blame import CodeError
from site_builder.diagnostics.diagnostic import cause
from site_builder.files.text import Sources
from site_builder.pool.loading import loaded

DATA = "content/measurements.json"
COMMAND = "python -m site_builder bench"
"""The command that writes it."""
SIDES = ("native", "browser")
ROUNDING = 1e-12
"""Errors below this, in the units of any metric, are rounding: none is better than another."""
EQUAL, EQUAL_DB = 0.01, 0.1
"""Errors that differ by less than this share, or by so many decibels, are equally good."""
NINE_OF_TEN = 0.9


def in_nine_of_ten(draws: ArrayLike) -> bool:
    """Whether a condition holds in so many of its draws that the book states it."""
    return float(np.mean(np.asarray(draws, bool))) >= NINE_OF_TEN


class MeasurementError(CodeError):
    """A ladder is unknown, not measured, or has changed since; the message says what to do."""


@dataclass(frozen=True, slots=True)
class Timing:
    """How long a tier takes on one side, in milliseconds."""

    ms: float
    """Median."""
    low: float
    """Lower quartile."""
    high: float
    """Upper quartile."""
    samples: int


@dataclass(frozen=True, slots=True)
class MeasuredTier:
    tier: Tier
    errors: Mapping[str, float | None]
    """By metric; None where the metric sees no error at all."""
    times: Mapping[str, Timing]
    """By side: ``native`` is CPython, ``browser`` the book's own Python in a browser."""
    draws: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)
    """(DRAWS,) errors on other workloads, by metric; empty where the ladder has no others."""

    def spread(self, metric_id: str) -> tuple[float, float] | None:
        """The errors between which nine of ten draws lie; None where there are no draws."""
        if not len(errors := self.draws.get(metric_id, ())):
            return None
        low, high = np.quantile(errors, (0.05, 0.95), method="nearest")
        return float(low), float(high)


@dataclass(frozen=True, slots=True)
class MeasuredLadder:
    """A ladder as one page shows it, judged by one of its metrics."""

    ladder: Ladder
    tiers: tuple[MeasuredTier, ...]
    """Cheap to dear, as declared."""
    metric: Metric
    """The one that the chart shows and that decides what is beaten."""
    machine: Mapping[str, object] = field(default_factory=dict)
    """What is timed."""

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled by the names of its tiers, whose functions may be lambdas."""
        tiers = [(item.tier.id, item.errors, item.times, item.draws) for item in self.tiers]
        return _restored, (self.ladder, tiers, self.metric.id, self.machine)

    def __getitem__(self, tier_id: str) -> MeasuredTier:
        return next(item for item in self.tiers if item.tier.id == self.ladder.tier(tier_id).id)

    @property
    def default(self) -> MeasuredTier:
        """The tier in which figures settle."""
        return self[self.ladder.default_tier]

    def beaten(self, side: str) -> list[MeasuredTier]:
        """Tiers that another beats."""
        return [item for item in self.tiers if self.beaten_by(item, side)]

    def loss(self, item: MeasuredTier) -> float:
        """The metric turned so that smaller is better; the least possible where it is None."""
        value = item.errors[self.metric.id]
        if value is None:
            return float("-inf") if self.metric.higher_is_better else 0.0
        return -value if self.metric.higher_is_better else value

    def front(self, side: str) -> tuple[MeasuredTier, ...]:
        """Tiers that no other matches in both time and error and beats in one, quickest first."""
        points = [(item.times[side].ms, self.loss(item)) for item in self.tiers]
        chosen = zip(self.tiers, pareto_front(points), strict=True)
        return tuple(sorted((i for i, on in chosen if on), key=lambda i: i.times[side].ms))

    def beaten_by(self, item: MeasuredTier, side: str) -> MeasuredTier | None:
        """The quickest tier that is no worse and clearly faster, or None.

        Clearly: three quarters of its runs take less time than three quarters of this one's. No
        worse: in nine of ten draws, where the ladder has draws.
        """
        winners = [
            other
            for other in self.tiers
            if other.times[side].high < item.times[side].low and self._no_worse(other, item)
        ]
        return min(winners, key=lambda other: other.times[side].ms, default=None)

    def _no_worse(self, one: MeasuredTier, other: MeasuredTier) -> bool:
        sign = -1.0 if self.metric.higher_is_better else 1.0
        ours, theirs = (
            sign * item.draws.get(self.metric.id, np.array([sign * self.loss(item)]))
            for item in (one, other)
        )
        alike = np.abs(theirs) * EQUAL if self.metric.unit != "dB" else EQUAL_DB
        no_worse = ours <= theirs + alike
        if not self.metric.higher_is_better:
            no_worse |= np.maximum(ours, theirs) < ROUNDING
        return in_nine_of_ten(no_worse)


@dataclass(frozen=True, slots=True)
class Measurements:
    """The file's content, compared with the ladders' code when a page uses it."""

    machine: Mapping[str, object] = field(default_factory=dict)
    ladders: Mapping[str, Any] = field(default_factory=dict)
    """Raw entries by ladder."""
    load_ladder: Callable[[str], Ladder] = load_ladder

    def find(self, ladder_id: str, metric_id: str = "") -> MeasuredLadder:
        """The measured ladder, judged by ``metric_id`` or its first metric.

        Raises `MeasurementError` if it is unknown, not measured or no longer as it was.
        """
        ladder = loaded("ladder", ladder_id, self.load_ladder, MeasurementError)
        again = f"run `{COMMAND} --ladder {ladder_id}`"
        entry = self.ladders.get(ladder_id)
        if entry is None:
            raise MeasurementError(f"ladder {ladder_id!r} is not in {DATA}; {again}")
        metric = _find_metric(ladder, metric_id)
        try:
            for what, declared, measured in _declarations(ladder, entry):
                if declared != measured:
                    raise MeasurementError(
                        f"{DATA} is out of date: the {what} of ladder {ladder_id!r} "
                        f"changed from {measured} to {declared}; {again}"
                    )
            tiers = tuple(_read_tier(ladder, tier, entry) for tier in ladder.tiers)
        except (KeyError, TypeError) as error:
            raise MeasurementError(
                f"{DATA}: ladder {ladder_id!r} is not as `{COMMAND}` writes it "
                f"({cause(error)}); {again}"
            ) from error
        return MeasuredLadder(ladder, tiers, metric, self.machine)

    def changed(self) -> Iterator[str]:
        """Ladders whose sources, or those of a model that they import, are others now."""
        for ladder_id, entry in self.ladders.items():
            recorded = entry.get("sources") if isinstance(entry, Mapping) else None
            module = LADDER_MODULES.get(ladder_id)
            if module and recorded and recorded != book_hash(module):
                yield ladder_id

    def all(self) -> tuple[MeasuredLadder, ...]:
        """Every ladder of the file, in its order."""
        return tuple(self.find(ladder_id) for ladder_id in self.ladders)


def read_measurements(
    sources: Sources, load: Callable[[str], Ladder] = load_ladder
) -> Measurements:
    """The measurements in the file; none where there is no such file. Mistakes are reported."""
    if not sources.has(DATA):
        return Measurements(load_ladder=load)
    try:
        data = json.loads(sources.text(DATA))
        found = Measurements(data["machine"], data["ladders"], load)
        if changed := [repr(name) for name in found.changed()]:
            message = f"measured with other sources: {', '.join(changed)}; better: run `{COMMAND}`"
            sources.problems.warn(DATA, 1, message)
        return found
    except (ValueError, RecursionError) as error:
        line, said = getattr(error, "lineno", 1), getattr(error, "msg", error)
        sources.problems.add(DATA, line, f"malformed JSON: {said}; run `{COMMAND}`")
    except (AttributeError, KeyError, TypeError):
        sources.problems.add(DATA, 1, f"no 'machine' or no 'ladders'; run `{COMMAND}`")
    return Measurements(load_ladder=load)


def _declarations(
    ladder: Ladder, entry: Mapping[str, Any]
) -> tuple[tuple[str, object, object], ...]:
    """What is compared: its name, its value in the code, its value in the file."""
    return (
        ("workload", ladder.workload, entry["workload"]),
        ("metrics", {metric.id: metric.unit for metric in ladder.metrics}, entry["metrics"]),
        ("tiers", sorted(tier.id for tier in ladder.tiers), sorted(entry["tiers"])),
    )


def _read_tier(ladder: Ladder, tier: Tier, entry: Mapping[str, Any]) -> MeasuredTier:
    found, metrics = entry["tiers"][tier.id], [metric.id for metric in ladder.metrics]
    errors = {metric: found["errors"][metric] for metric in metrics}
    times = {side: Timing(**found[side]) for side in SIDES}
    recorded = {metric: entry["draws"][metric][tier.id] for metric in metrics if ladder.draw}
    return MeasuredTier(tier, errors, times, {name: _numbers(d) for name, d in recorded.items()})


def _numbers(draws: Iterable[float | None]) -> NDArray[np.float64]:
    """The file has null for infinity."""
    return np.array([math.inf if value is None else value for value in draws])


def _restored(
    ladder: Ladder,
    tiers: Iterable[
        tuple[
            str, Mapping[str, float | None], Mapping[str, Timing], Mapping[str, NDArray[np.float64]]
        ]
    ],
    metric_id: str,
    machine: Mapping[str, object],
) -> MeasuredLadder:
    measured = tuple(
        MeasuredTier(ladder.tier(tier), errors, times, draws)
        for tier, errors, times, draws in tiers
    )
    return MeasuredLadder(ladder, measured, _find_metric(ladder, metric_id), machine)


def _find_metric(ladder: Ladder, metric_id: str) -> Metric:
    for metric in ladder.metrics:
        if metric.id == metric_id or not metric_id:
            return metric
    expected = ", ".join(metric.id for metric in ladder.metrics)
    raise MeasurementError(f"unknown metric {metric_id!r} of {ladder.id!r}; legal: {expected}")
