"""On or off."""

from collections.abc import Callable
from dataclasses import dataclass

from simulations.engine.controls.control import ControlError, Value, setting


@dataclass(frozen=True, slots=True, kw_only=True)
class Toggle:
    """On or off (``input[type=checkbox]``)."""

    name: str
    label: str
    default: bool = False

    kind = "toggle"
    types = (bool,)
    legal = "true, false"

    def check(self, raw: object) -> bool:
        if isinstance(raw, bool):
            return raw
        if isinstance(raw, str) and raw.lower() in ("true", "false"):
            return raw.lower() == "true"
        raise ControlError(f"{self.name}: {raw!r} is not a switch position; legal: {self.legal}")

    clamp = check

    def details(self) -> dict[str, object]:
        return {}

    def text(self, _value: Value, _numeral: Callable[[str], str] = str) -> tuple[str, str]:
        return "", ""

    def extremes(self) -> tuple[Value, ...]:
        return False, True

    def span(self, _value: Value) -> tuple[float, float, float]:
        return 0, 0, 0


def toggle(label: str, default: bool = False) -> bool:
    """On or off."""
    return setting(default, Toggle, label=label, default=default)
