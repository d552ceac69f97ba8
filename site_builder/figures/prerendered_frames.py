"""Frames of a figure's main control, drawn by the build for use before Python has started."""

import json
from dataclasses import dataclass

import numpy as np

from simulations.engine.controls import Action, Choice, Control, Slider, Toggle, Value
from simulations.engine.frame import to_json
from simulations.engine.settings import values_of
from site_builder.document.blocks import Simulation
from site_builder.figures.frames import small_frames


def main_control(figure: Simulation) -> Control | None:
    """The first whose values can be shown side by side. A menu that chooses a picture shows
    less than a slider."""
    controls = figure.scene.controls
    ordered = [*(c for c in controls if isinstance(c, Slider)), *controls]
    if controls and isinstance(controls[0], Choice):
        ordered.insert(0, controls[0])
    return next((c for c in ordered if not isinstance(c, Action | Toggle)), None)


FRAMES = 11
"""Number of frames of a slider, from end to end."""


@dataclass(frozen=True, slots=True)
class PrerenderedFrames:
    """Frames of one control, all others as the figure starts."""

    file: str
    data: bytes
    """JSON: the control, and of each frame its value, its panels' pictures and what the worker
    would send with them."""


def prerender(page: str, figure: Simulation) -> PrerenderedFrames | None:
    """The frames of a figure; None where it has no control that can be shown so.

    Raises whatever the scene does, and `LimitError`."""
    control = main_control(figure)
    if control is None:
        return None
    start = values_of(figure.scene.check(figure.values))
    values = shown_values(control, start[control.name])
    settings = tuple({**start, control.name: value} for value in values)
    frames = [
        {"value": value, "pictures": dict(small.pictures), **json.loads(to_json(small.frame))}
        for value, small in zip(
            values, small_frames(figure.scene, settings, figure.tier), strict=True
        )
    ]
    data = {"control": control.name, "frames": frames}
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"))
    return PrerenderedFrames(f"{page}--{figure.id}.json", text.encode())


def shown_values(control: Control, start: Value) -> tuple[Value, ...]:
    """Values of ``control`` from end to end, ``start`` among them."""
    if not isinstance(control, Slider):
        return tuple(control.options) if isinstance(control, Choice) else (start,)
    places = np.linspace(control.minimum, control.maximum, FRAMES)
    return tuple(sorted({float(start), *(control.nearest(float(place)) for place in places)}))
