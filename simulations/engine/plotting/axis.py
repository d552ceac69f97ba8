"""One axis: from values to view box units and back."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from simulations.engine.plotting.ticks import log_ticks, round_ticks

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

type Values = ArrayLike
type Coordinates = NDArray[np.floating]


@dataclass(frozen=True, slots=True)
class Axis:
    """Values from ``low`` to ``high``, drawn from ``start`` to ``end``; on a logarithmic scale if
    ``log``."""

    low: float
    high: float
    start: float
    end: float
    log: bool = False

    def __post_init__(self) -> None:
        if not (math.isfinite(self.low) and math.isfinite(self.high) and self.low != self.high):
            raise ValueError(f"axis from {self.low!r} to {self.high!r}: two finite ends are needed")
        if self.log and min(self.low, self.high) <= 0:
            raise ValueError(f"logarithmic axis from {self.low:g} to {self.high:g}: not above 0")

    def position(self, values: Values) -> Coordinates:
        """View box coordinates of values (...); NaN if the logarithm is undefined."""
        scaled, low, high = np.asarray(values, float), self.low, self.high
        if self.log:
            with np.errstate(divide="ignore", invalid="ignore"):
                scaled = np.log(np.where(scaled > 0, scaled, np.nan))
            low, high = math.log(low), math.log(high)
        return np.asarray(self.start + (scaled - low) / (high - low) * (self.end - self.start))

    def place(self, value: float) -> float:
        """The view box coordinate of a value, also beyond the ends."""
        low, high = self.low, self.high
        if self.log:
            if value <= 0:
                raise ValueError(f"{value:g} has no place on a logarithmic axis")
            value, low, high = math.log(value), math.log(low), math.log(high)
        return self.start + (value - low) / (high - low) * (self.end - self.start)

    def clamped(self, value: float) -> float:
        """The view box coordinate of a value, clamped to the ends."""
        low, high = sorted((self.low, self.high))
        return self.place(min(max(value, low), high))

    def value(self, place: float) -> float:
        """The value at a view box coordinate, also beyond the ends."""
        share = (place - self.start) / (self.end - self.start)
        if self.log:
            return self.low * (self.high / self.low) ** share
        return self.low + share * (self.high - self.low)

    def ticks(self, most: int = 6) -> Iterable[tuple[float, str]]:
        """At most ``most`` round values between the ends, each with its text."""
        low, high = sorted((self.low, self.high))
        return log_ticks(low, high, most) if self.log else round_ticks(low, high, most)
