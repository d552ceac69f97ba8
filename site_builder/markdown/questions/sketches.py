"""A curve that the reader is asked to sketch: an expression in ``x`` and two axes."""

from site_builder.markdown.directive import Use
from site_builder.markdown.questions.computed import names_for, number
from site_builder.markdown.reading import Reading
from site_builder.page_model.questions import Axis, Curve

SAMPLES = 97
"""Points of a true curve: twelve for each step between the nine places of a sketch."""


def read_curve(use: Use, reading: Reading) -> Curve | None:
    """The curve, worked out along its axis; None and a diagnostic where something is amiss."""
    x, y = (_read_axis(use, name, reading) for name in ("x", "y"))
    option = use.options.get("curve")
    if option is None or not option.text:
        legal = "a line ':curve: expression in x'"
        reading.problem(use.line, f"predict {use.argument!r} has no curve; legal: {legal}")
        return None
    if x is None or y is None:
        return None
    names = names_for(use, reading)
    samples: list[tuple[float, float]] = []
    for step in range(SAMPLES):
        place = x.start + (x.end - x.start) * step / (SAMPLES - 1)
        value = number(option.text, {**names, "x": place}, option.line, reading)
        if value is None:
            return None
        samples.append((place, value))
    outside = [value for _, value in samples if not y.start <= value <= y.end]
    if outside:
        legal = f"{y.start:g} to {y.end:g}, the axis ':y:'"
        reading.problem(option.line, f"the curve reaches {outside[0]:g}; legal: {legal}")
    return Curve(x, y, tuple(samples))


def _read_axis(use: Use, name: str, reading: Reading) -> Axis | None:
    """``0 90 Angle of the light (°)``."""
    option = use.options.get(name)
    text = option.text if option else ""
    start, _, rest = text.partition(" ")
    end, _, label = rest.partition(" ")
    try:
        axis = Axis(float(start), float(end), label.strip())
    except ValueError:
        axis = Axis(0.0, 0.0, "")
    if axis.start < axis.end and axis.label:
        return axis
    legal = f"a line ':{name}: 0 90 Angle of the light (°)'"
    line = option.line if option else use.line
    reading.problem(line, f"axis {name} of predict {use.argument!r} is {text!r}; legal: {legal}")
    return None
