"""A number in a closed range."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from simulations.engine.controls.control import ControlError, Value, setting
from simulations.engine.frame import format_number


@dataclass(frozen=True, slots=True, kw_only=True)
class Slider:
    """A number in a closed range (``input[type=range]``)."""

    name: str
    """The parameter's name: an identifier, unique in the scene."""
    label: str
    """Label shown to the reader."""
    default: float
    minimum: float
    maximum: float
    step: float
    unit: str = ""
    """Printed after the value: ``mm``, ``°``, ``px``."""
    prefix: str = ""
    """Printed before the value, as in ``f/2.8``."""
    arrival: float | None = None
    """Where it moves and comes back from, once, when its figure is first seen."""

    kind = "slider"
    types = (float, int)
    """Legal annotations of its field."""

    def __post_init__(self) -> None:
        if self.minimum >= self.maximum:
            legal = "the smaller number first"
            raise ControlError(f"{self.name}: the range {self.legal}; legal: {legal}")
        if not self.minimum <= self.default <= self.maximum:
            raise ControlError(f"{self.name}: default {self.default} outside {self.legal}")
        if not 0 < self.step <= self.maximum - self.minimum:
            raise ControlError(f"{self.name}: step {self.step} does not fit {self.legal}")
        if not self.reaches(self.default):
            raise ControlError(f"{self.name}: no step of {self.step} leads to {self.default}")

    @property
    def legal(self) -> str:
        return f"{self.minimum:g} to {self.maximum:g}"

    @property
    def decimals(self) -> int:
        """Decimals of the step."""
        text = f"{self.step:.10f}".rstrip("0")
        return len(text.partition(".")[2])

    def reaches(self, number: float) -> bool:
        """Whether ``number`` is a whole number of steps from the minimum, as browsers require."""
        steps = (number - self.minimum) / self.step
        return abs(steps - round(steps)) < 1e-6

    def nearest(self, number: float) -> float:
        """The value on a step nearest to ``number``, which may be infinite."""
        inside = min(max(number, self.minimum), self.maximum)
        steps = round((inside - self.minimum) / self.step)
        if self.minimum + steps * self.step > self.maximum + 1e-6 * self.step:
            steps -= 1
        return round(self.minimum + steps * self.step, self._fine_decimals) + 0.0

    @property
    def _fine_decimals(self) -> int:
        """The larger number of decimals of the minimum and the step."""
        texts = (f"{number:.10f}".rstrip("0") for number in (self.minimum, self.step))
        return max(len(text.partition(".")[2]) for text in texts)

    def parse(self, raw: object) -> float:
        """``raw`` as a finite number, not clamped to the range."""
        if isinstance(raw, bool) or not isinstance(raw, int | float | str):
            raise ControlError(f"{self.name}: {raw!r} is not a number; legal: {self.legal}")
        try:
            number = float(raw)
        except (ValueError, OverflowError):
            raise ControlError(
                f"{self.name}: {raw!r} is not a number; legal: {self.legal}"
            ) from None
        if not math.isfinite(number):
            raise ControlError(f"{self.name}: {raw!r} is not finite; legal: {self.legal}")
        return number + 0.0  # −0 would be written with its sign

    def check(self, raw: object) -> float:
        """``raw`` as a number in range, for authors; raises `ControlError` otherwise."""
        number = self.parse(raw)
        if not self.minimum <= number <= self.maximum:
            raise ControlError(f"{self.name}: {number:g} is out of range; legal: {self.legal}")
        return number

    def clamp(self, raw: object) -> float:
        """``raw`` as a number, clamped to the range, for readers."""
        return min(max(self.parse(raw), self.minimum), self.maximum)

    def details(self) -> dict[str, object]:
        """The data for the page besides name, kind, label and default."""
        return {
            "min": self.minimum,
            "max": self.maximum,
            "step": self.step,
            "unit": self.unit,
            "prefix": self.prefix,
            "decimals": self.decimals,
            **({} if self.arrival is None else {"arrival": self.arrival}),
        }

    def text(self, value: Value, numeral: Callable[[str], str] = str) -> tuple[str, str]:
        """The value and its unit as the figure shows them: ``f/2.8``, ``5.0`` and ``m``."""
        return f"{self.prefix}{numeral(format_number(float(value), self.decimals))}", self.unit

    def extremes(self) -> tuple[Value, ...]:
        """The ends of the range; every state for other kinds of controls."""
        return self.minimum, self.maximum

    def span(self, value: Value) -> tuple[float, float, float]:
        """Least, present and greatest value, for a handle that drives it."""
        return self.minimum, float(value), self.maximum


def slider[N: (int, float)](
    label: str,
    default: N,
    minimum: N,
    maximum: N,
    step: N,
    *,
    unit: str = "",
    prefix: str = "",
    arrival: float | None = None,
) -> N:
    """A number in a closed range; an ``int`` if the field is annotated as one. Where `arrival` is
    given and the page sets no value, it moves there and back when its figure is first seen."""
    numbers = {"default": default, "minimum": minimum, "maximum": maximum, "step": step}
    affixes = {"unit": unit, "prefix": prefix}
    return setting(default, Slider, label=label, **numbers, **affixes, arrival=arrival)
