"""A curve, and the field in which it is drawn."""

from dataclasses import dataclass

from simulations.engine.drawing import coordinate

LEFT, RIGHT, TOP, BOTTOM = 52.0, 384.0, 32.0, 206.0
"""The field inside the axes, in a view box of 400 by 250."""
PLACES = 9
"""Points that the reader moves."""
STEPS = 100
"""Of each point, from the foot of the axis to its top."""


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


@dataclass(frozen=True, slots=True)
class Tick:
    """A number on an axis, and where."""

    place: str
    text: str


@dataclass(frozen=True, slots=True)
class SketchView:
    """The field in which a curve is drawn, ready for ``kind.html``."""

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
        places=tuple(_short(x) for x, _ in marked_points(curve)),
        middle=f"{(curve.y.start + curve.y.end) / 2:g}",
        step=f"{(curve.y.end - curve.y.start) / STEPS:g}",
    )


def marked_points(curve: Curve) -> tuple[tuple[float, float], ...]:
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
