"""A curve that the reader is asked to sketch: an expression in ``x`` and two axes."""

from site_builder.markdown.calculation import number
from site_builder.markdown.directive import DirectiveCall
from site_builder.markdown.parse_context import ParseContext
from site_builder.page_model.questions import Axis, Curve

SAMPLES = 97
"""Points of a true curve: twelve for each step between the nine places of a sketch."""


def read_curve(call: DirectiveCall, context: ParseContext) -> Curve | None:
    """The curve, worked out along its axis; None and a diagnostic where something is amiss."""
    x, y = (_read_axis(call, name, context) for name in ("x", "y"))
    option = call.options.get("curve")
    if option is None or not option.text:
        expected = "a line ':curve: expression in x'"
        context.problem(call.line, f"predict {call.argument!r} has no curve; legal: {expected}")
        return None
    if x is None or y is None:
        return None
    samples: list[tuple[float, float]] = []
    for step in range(SAMPLES):
        place = x.start + (x.end - x.start) * step / (SAMPLES - 1)
        value = number(option.text, option.line, context, x=place)
        if value is None:
            return None
        samples.append((place, value))
    outside = [value for _, value in samples if not y.start <= value <= y.end]
    if outside:
        expected = f"{y.start:g} to {y.end:g}, the axis ':y:'"
        context.problem(option.line, f"the curve reaches {outside[0]:g}; legal: {expected}")
    return Curve(x, y, tuple(samples))


def _read_axis(call: DirectiveCall, name: str, context: ParseContext) -> Axis | None:
    """``0 90 Angle of the light (°)``."""
    option = call.options.get(name)
    text = option.text if option else ""
    start, _, rest = text.partition(" ")
    end, _, label = rest.partition(" ")
    try:
        axis = Axis(float(start), float(end), label.strip())
    except ValueError:
        axis = Axis(0.0, 0.0, "")
    if axis.start < axis.end and axis.label:
        return axis
    expected = f"a line ':{name}: 0 90 Angle of the light (°)'"
    line = option.line if option else call.line
    context.problem(
        line, f"axis {name} of predict {call.argument!r} is {text!r}; legal: {expected}"
    )
    return None
