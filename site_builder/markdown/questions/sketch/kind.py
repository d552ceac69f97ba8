"""A curve to draw: an expression in ``x``, and the two axes that it is drawn on."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from markdown_it.token import Token

from simulations.engine.drawing import coordinate
from site_builder.document.blocks import Question
from site_builder.markdown.calculation import number
from site_builder.markdown.directive import DirectiveCall, OptionLine
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.questions.answers import read_answers
from site_builder.markdown.questions.kind import QuestionBody, QuestionKind

LEFT, RIGHT, TOP, BOTTOM = 52.0, 384.0, 32.0, 206.0
"""The field inside the axes, in a view box of 400 by 250."""
PLACES = 9
"""Points that the reader moves."""
STEPS = 100
"""Height of each point, from the foot of the axis to its top."""


@dataclass(frozen=True, slots=True)
class Axis:
    """From where to where, and what of."""

    start: float
    end: float
    label: str


@dataclass(frozen=True, slots=True)
class Curve:
    """A curve to be sketched, and the axes that it is sketched on."""

    x: Axis
    y: Axis
    samples: tuple[tuple[float, float], ...]
    """Along the axis, from its start to its end."""


def view_sketch(curve: Curve) -> dict[str, object]:
    """The field in which a curve is drawn, as ``kind.html`` shows it: the axes with the places and
    texts of their ticks, the true curve as the data of a path, and along the axis, in its unit,
    where the points are; where each begins, and the step by which it moves."""
    x, y = curve.x, curve.y
    across = (coordinate(_along(x, at, LEFT, RIGHT)) for at, _ in curve.samples)
    up = (coordinate(_along(y, at, BOTTOM, TOP)) for _, at in curve.samples)
    return {
        "x": x,
        "y": y,
        "x_ticks": _ticks(x, LEFT, RIGHT),
        "y_ticks": _ticks(y, BOTTOM, TOP),
        "truth": "M" + "L".join(map(" ".join, zip(across, up, strict=True))),
        "places": [_short(at) for at, _ in marked_points(curve)],
        "middle": f"{(y.start + y.end) / 2:g}",
        "step": f"{(y.end - y.start) / STEPS:g}",
    }


def marked_points(curve: Curve) -> tuple[tuple[float, float], ...]:
    """The samples at which the reader has a point to move."""
    return curve.samples[:: (len(curve.samples) - 1) // (PLACES - 1)]


def _along(axis: Axis, value: float, start: float, end: float) -> float:
    return start + (end - start) * (value - axis.start) / (axis.end - axis.start)


def _ticks(axis: Axis, start: float, end: float) -> list[tuple[str, str]]:
    values = [axis.start + (axis.end - axis.start) * part / 4 for part in range(5)]
    return [(coordinate(_along(axis, value, start, end)), _short(value)) for value in values]


def _short(value: float) -> str:
    return f"{value:.4g}".replace("-", "\u2212")


SAMPLES = 97
"""Points of a true curve: twelve for each step between the nine places of a sketch."""


def read_sketch(
    call: DirectiveCall, body: Sequence[Token], context: ParseContext
) -> QuestionBody | None:
    read_answers(call, body, context, kind="no")  # there is a question
    curve = _read_curve(call, context)
    if curve is None:
        return None
    return QuestionBody(tuple(body), details=curve, decides=(curve.x, curve.y))


def _read_curve(call: DirectiveCall, context: ParseContext) -> Curve | None:
    """The curve, computed along its axis; None, and a report, where that is not possible."""
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


def _page_data(question: Question) -> Mapping[str, object]:
    curve: Curve = question.details
    sketch = {
        "field": {"left": LEFT, "right": RIGHT, "top": TOP, "bottom": BOTTOM},
        "x": [curve.x.start, curve.x.end],
        "y": [curve.y.start, curve.y.end],
        "truth": [value for _, value in marked_points(curve)],
    }
    return {"sketch": sketch}


SKETCH = QuestionKind(
    folder="sketch",
    doc="a curve to draw, compared with the computed one",
    read=read_sketch,
    predict=("sketch",),
    options=(
        OptionLine(name="curve", doc="what is to be sketched, an expression in `x`"),
        OptionLine(name="x", doc="an axis, `0 90 Angle (°)`"),
        OptionLine(name="y", doc="the other axis"),
    ),
    page_data=_page_data,
    view=lambda question, _figures: view_sketch(question.details),
    drawn=True,
)
