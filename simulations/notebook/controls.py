"""Widgets of ipywidgets for the controls of a scene."""

from collections.abc import Callable
from math import floor
from typing import Any

import ipywidgets as widgets

from simulations.engine.controls import Action, Choice, Control, Slider, Toggle, Value

STEPS_PER_SECOND = 10
"""Speed of a slider that a button sweeps."""

type Widget = Any
"""ipywidgets has no types."""
type Changed = Callable[[Value], None]


def widget_of(control: Control, start: Value, changed: Changed) -> Widget | None:
    """The widget, which calls ``changed`` with each new value; None for points, which are moved in
    pictures only, and for a button that moves a slider, which `mover` makes."""
    match control:
        case Slider():
            made = _slider(control, start)
            made.observe(lambda change: changed(control.nearest(change["new"])), "value")
        case Choice():
            options = [(label, value) for value, label in control.options.items()]
            made = widgets.Dropdown(value=start, options=options, **label_options(control.label))
            made.observe(lambda change: changed(change["new"]), "value")
        case Toggle():
            made = widgets.Checkbox(value=start, **label_options(control.label))
            made.observe(lambda change: changed(change["new"]), "value")
        case Action(drives=""):
            made = _button(control, int(start), changed)
        case _:
            return None
    return made


def mover(action: Action, control: Slider, slider: Widget) -> Widget:
    """Moves ``slider``, the widget of ``control``: to its end in some seconds, or to the next whole
    number."""
    if action.effect == "step":
        made = widgets.Button(description=action.label)
        made.on_click(lambda _: setattr(slider, "value", _next(control, slider.value)))
        return made
    steps = max(1, round(action.seconds * STEPS_PER_SECOND))
    play = widgets.Play(max=steps, interval=1000 // STEPS_PER_SECOND)

    def move(change: dict[str, int]) -> None:
        span = control.maximum - control.minimum
        slider.value = control.nearest(control.minimum + span * change["new"] / steps)

    play.observe(move, "value")
    return widgets.HBox([widgets.Label(action.label), play])


def _slider(control: Slider, start: Value) -> Widget:
    unit = f" ({control.unit})" if control.unit else ""
    return widgets.FloatSlider(
        value=start,
        min=control.minimum,
        max=control.maximum,
        step=control.step,
        readout_format=f".{control.decimals}f",
        **label_options(control.label + unit),
    )


def label_options(label: str) -> dict[str, object]:
    """Options of all widgets with a label."""
    return {
        "description": label,
        "style": {"description_width": "40%"},
        "layout": {"width": "auto"},
    }


def _button(action: Action, start: int, changed: Changed) -> Widget:
    """A button whose value is the number of presses modulo the number of labels."""
    state = start
    made = widgets.Button(description=action.labels[state], layout={"width": "auto"})

    def press(_button: Widget) -> None:
        nonlocal state
        state = (state + 1) % len(action.labels)
        made.description = action.labels[state]
        changed(state)

    made.on_click(press)
    return made


def _next(control: Slider, value: float) -> float:
    """Past the end it starts over, as in the page (``static/js/figure/motion.ts``)."""
    if value >= control.maximum:
        return control.minimum
    return min(control.minimum + floor(value - control.minimum + 1e-9) + 1, control.maximum)
