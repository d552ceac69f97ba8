"""Axes of a chart: values to view box coordinates, and where the ticks stand."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from simulations.engine.frame import format_number, power_of_ten
from site_builder.measured.quantities import quantity


@dataclass(frozen=True, slots=True)
class Axis:
    """One axis. Values off its ends are put on them."""

    low: float
    """First value, as a logarithm to base 10 where ``log``."""
    high: float
    start: float
    """View box coordinate of ``low``."""
    end: float
    log: bool
    none: float | None = None
    """View box coordinate that stands for no error at all; None where nothing is free of error."""

    def position(self, value: float) -> float:
        if self.none is not None and (value <= 0.0 if self.log else math.isinf(value)):
            return self.none
        scaled = math.log10(value) if self.log and value > 0.0 else value
        share = (min(max(scaled, self.low), self.high) - self.low) / (self.high - self.low)
        return self.start + share * (self.end - self.start)

    def ticks(self) -> tuple[tuple[float, str], ...]:
        """Values and their labels."""
        return _log_ticks(self) if self.log else _linear_ticks(self)


def log_axis(values: Iterable[float], start: float, end: float, none: float | None = None) -> Axis:
    """An axis over all ``values`` above 0, with room at both ends, no shorter than a decade."""
    logs = [math.log10(value) for value in values if value > 0.0] or [0.0]
    low, high = min(logs) - 0.2, max(logs) + 0.2
    missing = max(0.0, 1.0 - (high - low)) / 2
    return Axis(low - missing, high + missing, start, end, log=True, none=none)


def linear_axis(
    values: Iterable[float], start: float, end: float, none: float | None = None
) -> Axis:
    """An axis over all finite ``values``, with room at both ends."""
    finite = [value for value in values if math.isfinite(value)] or [0.0]
    margin = max(0.12 * (max(finite) - min(finite)), 0.5)
    return Axis(min(finite) - margin, max(finite) + margin, start, end, log=False, none=none)


def _log_ticks(axis: Axis) -> tuple[tuple[float, str], ...]:
    decades = range(math.ceil(axis.low), math.floor(axis.high) + 1)
    if axis.high - axis.low > 2.5:
        step = math.ceil((axis.high - axis.low) / 6)
        powers = [power for power in decades if power % step == 0]
        plain = all(-3 <= power <= 4 for power in powers)
        return tuple((10.0**p, quantity(10.0**p, 1) if plain else power_of_ten(p)) for p in powers)
    steps = (1, 2, 5)
    first = math.floor(axis.low)
    values = (s * 10.0**p for p in range(first, math.ceil(axis.high)) for s in steps)
    return tuple(
        (value, quantity(value, 1))
        for value in values
        if axis.low <= math.log10(value) <= axis.high
    )


def _linear_ticks(axis: Axis) -> tuple[tuple[float, str], ...]:
    rough = (axis.high - axis.low) / 5
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(s * power for s in (1, 2, 5, 10) if s * power >= rough)
    first, last = math.ceil(axis.low / step), math.floor(axis.high / step)
    decimals = max(0, -math.floor(math.log10(step)))
    return tuple((n * step, format_number(n * step, decimals)) for n in range(first, last + 1))
