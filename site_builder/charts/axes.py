"""Axes of a chart, those of the plots in figures: how far they reach, a place for no error."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.ticks import Tick


@dataclass(frozen=True, slots=True)
class ChartAxis:
    """One axis. Values off its ends are put on them."""

    scale: Axis
    none: float | None = None
    """View box coordinate that stands for no error at all; None where nothing is free of error."""

    def position(self, value: float) -> float:
        """View box coordinate of a value."""
        if self.none is not None and (value <= 0.0 if self.scale.log else math.isinf(value)):
            return self.none
        return self.scale.clamped(value)

    def ticks(self) -> tuple[Tick, ...]:
        """Values and their labels."""
        return tuple(self.scale.ticks())


def log_axis(
    values: Iterable[float], start: float, end: float, none: float | None = None
) -> ChartAxis:
    """An axis over all ``values`` above 0, with room at both ends, no shorter than a decade."""
    logs = [math.log10(value) for value in values if value > 0.0] or [0.0]
    low, high = min(logs) - 0.2, max(logs) + 0.2
    missing = max(0.0, 1.0 - (high - low)) / 2
    ends = 10.0 ** (low - missing), 10.0 ** (high + missing)
    return ChartAxis(Axis(*ends, start, end, log=True), none)


def linear_axis(
    values: Iterable[float], start: float, end: float, none: float | None = None
) -> ChartAxis:
    """An axis over all finite ``values``, with room at both ends."""
    finite = [value for value in values if math.isfinite(value)] or [0.0]
    margin = max(0.12 * (max(finite) - min(finite)), 0.5)
    return ChartAxis(Axis(min(finite) - margin, max(finite) + margin, start, end), none)
