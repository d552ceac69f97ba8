"""Controls of a figure: ranges, defaults and labels."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

type Value = float | int | str | bool


class ControlError(ValueError):
    """An illegal value of a control. The message states the value and what is legal."""


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

    kind = "slider"

    def __post_init__(self) -> None:
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """One of several named options (``select``)."""

    name: str
    label: str
    default: str
    options: Mapping[str, str]
    """Value to label, in the order shown."""

    kind = "choice"

    def __post_init__(self) -> None:
        self.check(self.default)

    @property
    def legal(self) -> str:
        return ", ".join(self.options)

    def check(self, raw: object) -> str:
        if not isinstance(raw, str) or raw not in self.options:
            raise ControlError(
                f"{self.name}: {raw!r} is not an option; legal: {self.legal}"
                f"{suggestion(raw, self.options)}"
            )
        return raw

    clamp = check


@dataclass(frozen=True, slots=True, kw_only=True)
class Toggle:
    """On or off (``input[type=checkbox]``)."""

    name: str
    label: str
    default: bool = False

    kind = "toggle"
    legal = "true, false"

    def check(self, raw: object) -> bool:
        if isinstance(raw, bool):
            return raw
        if isinstance(raw, str) and raw.lower() in ("true", "false"):
            return raw.lower() == "true"
        raise ControlError(f"{self.name}: {raw!r} is not a switch position; legal: {self.legal}")

    clamp = check


@dataclass(frozen=True, slots=True, kw_only=True)
class Action:
    """A button. Its value is the number of presses modulo the number of labels.

    A button with one label either moves another control (``drives``) or only repaints; one with two
    labels is a switch whose label names the effect of the next press. A button that draws new noise
    repeats its label once per draw: its value seeds the noise.
    """

    name: str
    labels: tuple[str, ...]
    """The button's text in each state; the state is the index."""
    drives: str = ""
    """Name of the slider that the button moves in the browser, if any."""
    effect: str = ""
    """``play`` (sweep that slider to its end; press again to pause), ``step`` or ``reset``."""
    seconds: float = 8.0
    """Duration of ``play`` from the slider's minimum to its maximum."""

    kind = "action"
    default = 0

    def __post_init__(self) -> None:
        if bool(self.drives) != (self.effect in ("play", "step", "reset")):
            raise ControlError(
                f"{self.name}: effect {self.effect!r} on {self.drives!r}; "
                "legal: play, step or reset together with a slider's name"
            )

    @property
    def label(self) -> str:
        return self.labels[0]

    @property
    def legal(self) -> str:
        return f"0 to {len(self.labels) - 1}"

    def check(self, raw: object) -> int:
        try:
            state = int(raw) if isinstance(raw, int | float | str) else -1
        except (ValueError, OverflowError):
            state = -1
        if not 0 <= state < len(self.labels):
            raise ControlError(f"{self.name}: {raw!r} is not a state; legal: {self.legal}")
        return state

    clamp = check


type Control = Slider | Choice | Toggle | Action


def suggestion(given: object, legal: Mapping[str, object]) -> str:
    """``; did you mean 'x'?`` if a legal name is similar, else empty."""
    import difflib  # a large module, rarely needed

    near = difflib.get_close_matches(str(given), list(legal), n=1)
    return f"; did you mean {near[0]!r}?" if near else ""


def describe(control: Control) -> dict[str, object]:
    """The control as plain data: the entry of ``book.json`` and of the page."""
    entry: dict[str, object] = {
        "name": control.name,
        "kind": control.kind,
        "label": control.label,
        "default": control.default,
    }
    match control:
        case Slider():
            entry |= {
                "min": control.minimum,
                "max": control.maximum,
                "step": control.step,
                "unit": control.unit,
                "prefix": control.prefix,
                "decimals": control.decimals,
            }
        case Choice():
            entry |= {"options": list(control.options), "labels": list(control.options.values())}
        case Action():
            entry |= {
                "labels": list(control.labels),
                "drives": control.drives,
                "effect": control.effect,
                "seconds": control.seconds,
            }
        case Toggle():
            pass
    return entry
