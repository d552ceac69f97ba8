"""One of several named options."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from simulations.engine.controls.control import ControlError, Value, setting, suggestion


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """One of several named options (``select``)."""

    name: str
    label: str
    default: str
    options: Mapping[str, str]
    """Value to label, in the order shown."""

    kind = "choice"
    types = (str,)

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

    def details(self) -> dict[str, object]:
        return {"options": list(self.options), "labels": list(self.options.values())}

    def text(self, value: Value, _numeral: Callable[[str], str] = str) -> tuple[str, str]:
        return self.options[str(value)], ""

    def extremes(self) -> tuple[Value, ...]:
        return tuple(self.options)

    def span(self, value: Value) -> tuple[float, float, float]:
        """Places in the menu."""
        options = list(self.options)
        return 0, options.index(str(value)), len(options) - 1


def choice(label: str, options: Mapping[str, str], default: str = "") -> str:
    """One of several named options, value to label. The default is the first unless another is
    named."""
    start = default or next(iter(options))
    return setting(start, Choice, label=label, default=start, options=options)
