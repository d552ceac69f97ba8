"""A prediction as its page shows it: what its script must know, and the axes of a sketch."""

from dataclasses import dataclass

from jinja2 import pass_context
from jinja2.runtime import Context
from markupsafe import Markup

from simulations.engine.drawing import coordinate
from site_builder.page_model.questions import Axis, Curve, Prediction
from site_builder.pages.embedding import json_for_html
from site_builder.pages.views.quiz import option_data

WIDTH, HEIGHT = 400.0, 250.0
LEFT, RIGHT, TOP, BOTTOM = 52.0, 384.0, 32.0, 206.0
"""The view box of a sketch, and the field inside its axes."""
PLACES = 9
"""Points that the reader moves."""
STEPS = 100
"""Of each point, from the foot of the axis to its top."""


@dataclass(frozen=True, slots=True)
class Tick:
    """A number on an axis, and where."""

    place: str
    text: str


@dataclass(frozen=True, slots=True)
class SketchView:
    """The field in which a curve is drawn, ready for ``blocks/sketch.html``."""

    x: Axis
    y: Axis
    x_ticks: tuple[Tick, ...]
    y_ticks: tuple[Tick, ...]
    truth: str
    """The true curve, as the data of a path."""
    places: tuple[str, ...]
    """Along the axis, in its unit, in words: where the points are."""
    middle: str
    """Where each point begins."""
    step: str


@pass_context
def predict_data(context: Context, prediction: Prediction) -> Markup:
    """JSON that is safe inside a script element."""
    data: dict[str, object] = {
        "id": prediction.id,
        "kind": prediction.kind,
        "edition": prediction.edition,
        "options": option_data(prediction.options, context["renderer"]),
    }
    if prediction.kind == "number":
        data |= {"tolerance": prediction.tolerance, "truth": truth_text(prediction)}
    if prediction.curve:
        curve = prediction.curve
        data["sketch"] = {
            "field": {"left": LEFT, "right": RIGHT, "top": TOP, "bottom": BOTTOM},
            "x": [curve.x.start, curve.x.end],
            "y": [curve.y.start, curve.y.end],
            "truth": [value for _, value in _points(curve)],
        }
    return json_for_html(data)


def truth_text(prediction: Prediction) -> str:
    """The right answer in words."""
    return next((option.text for option in prediction.options if option.correct), "")


def view_sketch(curve: Curve) -> SketchView:
    across = (coordinate(_along(curve.x, x, LEFT, RIGHT)) for x, _ in curve.samples)
    up = (coordinate(_along(curve.y, y, BOTTOM, TOP)) for _, y in curve.samples)
    points = (f"{x} {y}" for x, y in zip(across, up, strict=True))
    return SketchView(
        x=curve.x,
        y=curve.y,
        x_ticks=_ticks(curve.x, LEFT, RIGHT),
        y_ticks=_ticks(curve.y, BOTTOM, TOP),
        truth="M" + "L".join(points),
        places=tuple(_short(x) for x, _ in _points(curve)),
        middle=f"{(curve.y.start + curve.y.end) / 2:g}",
        step=f"{(curve.y.end - curve.y.start) / STEPS:g}",
    )


def _points(curve: Curve) -> tuple[tuple[float, float], ...]:
    """The samples at which the reader has a point to move."""
    return curve.samples[:: (len(curve.samples) - 1) // (PLACES - 1)]


def _along(axis: Axis, value: float, start: float, end: float) -> float:
    return start + (end - start) * (value - axis.start) / (axis.end - axis.start)


def _ticks(axis: Axis, start: float, end: float) -> tuple[Tick, ...]:
    values = [axis.start + (axis.end - axis.start) * part / 4 for part in range(5)]
    return tuple(
        Tick(coordinate(_along(axis, value, start, end)), _short(value)) for value in values
    )


def _short(value: float) -> str:
    return f"{value:.4g}".replace("-", "\u2212")
