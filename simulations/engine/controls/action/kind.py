"""A button."""

from collections.abc import Callable
from dataclasses import dataclass

from simulations.engine.controls.control import ControlError, Value, setting


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
    """``play`` (sweep that slider to its end; press again to pause), ``step``, or ``set``: other
    controls get the values of `Scene.sets`."""
    seconds: float = 8.0
    """Duration of ``play`` from the slider's minimum to its maximum."""
    arrival: bool = False
    """Whether ``play`` begins by itself when the figure first comes into view."""

    kind = "action"
    types = (int,)
    default = 0

    def __post_init__(self) -> None:
        if bool(self.drives) != (self.effect in ("play", "step")):
            raise ControlError(
                f"{self.name}: effect {self.effect!r} on {self.drives!r}; "
                "legal: play or step together with a slider's name"
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

    def details(self) -> dict[str, object]:
        return {
            "labels": list(self.labels),
            "drives": self.drives,
            "effect": self.effect,
            "seconds": self.seconds,
            "arrival": self.arrival,
        }

    def text(self, value: Value, _numeral: Callable[[str], str] = str) -> tuple[str, str]:
        return self.labels[int(value)], ""

    def extremes(self) -> tuple[Value, ...]:
        return tuple(range(len(self.labels)))

    def span(self, _value: Value) -> tuple[float, float, float]:
        return 0, 0, 0


def action(
    *labels: str, drives: str = "", effect: str = "", seconds: float = 8.0, arrival: bool = False
) -> int:
    """A button, whose value is the number of presses modulo the number of labels."""
    motion = {"drives": drives, "effect": effect, "seconds": seconds, "arrival": arrival}
    return setting(0, Action, labels=labels, **motion)
