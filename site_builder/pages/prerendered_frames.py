"""What a figure can show of its main control before Python has started: frames drawn beforehand."""

import json
from dataclasses import dataclass

import numpy as np

from simulations.engine.controls import Choice, Control, Slider, Value
from simulations.engine.frame import to_json
from simulations.engine.settings import values_of
from site_builder.drawing.frames import sketches_at
from site_builder.page_model.blocks import Simulation
from site_builder.pages.main_control import main_control

FRAMES = 11
"""Of a slider, from end to end."""


@dataclass(frozen=True, slots=True)
class Strip:
    """Frames of one control, all others as the figure starts."""

    file: str
    data: bytes
    """JSON: the control, and of each frame its value, its panels' pictures and what the worker
    would send with them."""


def render_strip(page: str, figure: Simulation) -> Strip | None:
    """The strip of a figure; None where it has no control that can be shown so. Raises whatever
    the scene does, and `LimitError`."""
    control = main_control(figure)
    if control is None:
        return None
    start = values_of(figure.scene.check(figure.values))
    values = shown_values(control, start[control.name])
    settings = tuple({**start, control.name: value} for value in values)
    frames = [
        {"value": value, "pictures": dict(sketch.pictures), **json.loads(to_json(sketch.frame))}
        for value, sketch in zip(
            values, sketches_at(figure.scene, settings, figure.tier), strict=True
        )
    ]
    told = {"control": control.name, "frames": frames}
    text = json.dumps(told, ensure_ascii=False, separators=(",", ":"))
    return Strip(f"{page}--{figure.id}.json", text.encode())


def shown_values(control: Control, start: Value) -> tuple[Value, ...]:
    """Values of ``control`` from end to end, ``start`` among them."""
    if not isinstance(control, Slider):
        return tuple(control.options) if isinstance(control, Choice) else (start,)
    places = np.linspace(control.minimum, control.maximum, FRAMES)
    return tuple(sorted({float(start), *(control.nearest(float(place)) for place in places)}))
