"""A scene's settings: what the reader may change, as the fields of a frozen dataclass.

    @dataclass(frozen=True, slots=True)
    class Settings:
        depth: float = slider("Depth (Z)", 5.0, -2, 20, 0.1, unit="m")
        view: str = choice("View", {"top": "From above", "side": "From the side"})
        grid: bool = toggle("Show the grid")
        take: int = action("Take another photo", "Take another photo")

Controls, defaults, validation, documentation and types of a setting all come from its field.
"""

from collections.abc import Callable, Mapping
from dataclasses import Field, fields
from functools import lru_cache
from typing import Any, cast

from simulations.engine.controls import KINDS, Control, ControlError, Slider, Value, suggestion
from simulations.engine.controls.action.kind import action as action
from simulations.engine.controls.choice.kind import choice as choice
from simulations.engine.controls.points.kind import points as points
from simulations.engine.controls.slider.kind import slider as slider
from simulations.engine.controls.toggle.kind import toggle as toggle


def controls_of(settings: type) -> tuple[Control, ...]:
    """The controls of a dataclass of settings, in the order of its fields.

    Raises `TypeError` for a field without a control, or annotated with a type that its control's
    values do not have, and `ControlError` for an inconsistent control.
    """
    return _controls(settings)


@lru_cache
def _controls(settings: type) -> tuple[Control, ...]:
    made: Any = getattr(settings, "__dataclass_params__", None)
    if made is None or not made.frozen:
        legal = "@dataclass(frozen=True, slots=True)"
        raise TypeError(f"settings {settings.__name__} can be changed; legal: {legal}")
    return tuple(_control(entry) for entry in fields(settings))


def _control(entry: Field[Any]) -> Control:
    make = entry.metadata.get("control")
    if make is None:
        raise TypeError(f"setting {entry.name!r} has no control; legal: {', '.join(KINDS)}")
    control: Control = make(name=entry.name)
    legal: tuple[type, ...] = control.types
    if entry.type not in legal:
        names = " or ".join(kind.__name__ for kind in legal)
        raise TypeError(f"setting {entry.name!r}: a {control.kind} is {names}, not {entry.type}")
    return control


def check_settings[S](settings: type[S], given: Mapping[str, object]) -> S:
    """Defaults overridden by an author's values.

    Raises `ControlError` for anything illegal, also for a fraction where the setting is whole.
    """
    integers = {entry.name for entry in fields(cast(Any, settings)) if entry.type is int}

    def check(control: Control, raw: object) -> Value:
        value = control.check(raw)
        if (
            control.name in integers
            and isinstance(control, Slider)
            and value != round(float(value))
        ):
            steps = f"{control.minimum:g} and steps of {control.step:g}"
            message = f"{control.name}: {value:g} is between two steps; legal: {steps}"
            raise ControlError(message)
        return value

    return _resolve(settings, given, check)


def clamp_settings[S](settings: type[S], given: Mapping[str, object]) -> S:
    """Defaults overridden by a reader's values; numbers out of range are clamped."""
    return _resolve(settings, given, lambda control, raw: control.clamp(raw))


def _resolve[S](
    settings: type[S], given: Mapping[str, object], legal: Callable[[Control, object], Value]
) -> S:
    controls = {control.name: control for control in controls_of(settings)}
    for name in given:
        if name not in controls:
            raise ControlError(
                f"unknown parameter {name!r}; legal: {', '.join(controls)}"
                f"{suggestion(name, controls)}"
            )
    types = {entry.name: entry.type for entry in fields(cast(Any, settings))}
    values = {name: legal(controls[name], raw) for name, raw in given.items()}
    typed = {
        name: round(value) if types[name] is int and isinstance(value, float) else value
        for name, value in values.items()
    }
    return settings(**typed)


def values_of(settings: object) -> dict[str, Value]:
    """The settings by name."""
    return {entry.name: getattr(settings, entry.name) for entry in fields(cast(Any, settings))}
