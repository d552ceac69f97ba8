"""Handles: marks in a picture that can be grabbed and dragged.

    def point_at(settings: Settings, _outputs: Outputs) -> Point:
        return (20 * settings.x, 30)

    Handle("point", "plane", "Point P", drives=("x",), at=point_at, role="world")

``at`` is the place of the handle at the given settings. The engine searches the one setting that
a handle drives for the value that brings it nearest to the pointer. ``pull`` replaces the search
where it would not do: for two settings, for angles that wrap, and where ``at`` depends on a stage
that takes long. It returns the settings that would bring the handle to a place, as if there were no
limits; the engine clamps and rounds them to the steps of the controls. The page, the keyboard and
the tests all use these functions.
"""

import inspect
import math
from collections.abc import Callable, Mapping
from dataclasses import KW_ONLY, dataclass, replace
from numbers import Real
from typing import Any, Literal

from simulations.engine.controls import Choice, Control, Slider, Value
from simulations.engine.frame import Panel, Place, is_role
from simulations.engine.stages import Outputs

COARSE, FINE = 64, 17
"""Places of a slider that a search compares at first, and in each smaller part."""

type Point = tuple[float, float]
"""A place in view box units of the panel: x right, y down."""


@dataclass(frozen=True, slots=True)
class Handle[S]:
    """A mark in a panel that can be grabbed. ``S`` is the dataclass of the scene's settings."""

    name: str
    """Identifier, unique in the scene."""
    panel: str
    """Name of its panel."""
    label: str
    """Its name for readers who cannot see it: ``Lamp``."""
    drives: tuple[str, ...]
    """Names of the one or two settings that a pull changes. The arrow keys right and left step the
    first; up and down step the second, or the first if there is only one. Points are moved by all
    four keys."""
    at: Callable[[S, Outputs], Point | None]
    """Returns its place, or ``None`` if it cannot be grabbed at these settings."""
    pull: Callable[..., Mapping[str, Value]] | None = None
    """Takes settings, a place and, if it has parameters of these names, the current ``tier`` and
    the reader's ``photograph``. Returns the settings that put the handle at that place; settings
    left out stay as they are. ``None`` for a search, if the handle drives one slider or menu."""
    _: KW_ONLY
    reach: Literal["mark", "press", "drag", "aim"] = "mark"
    """How it is grabbed: at its mark; also by pressing anywhere in the panel, which brings it
    there; without a mark by dragging from anywhere, which moves it by the same distance; or by
    pressing at a place."""
    role: str = ""
    """One of `simulations.engine.frame.ROLES`, or a colour that the book defines: the colour of its
    mark."""
    reversed: tuple[str, ...] = ()
    """Settings that move it left or down as they increase: their arrow keys are reversed."""
    step: Callable[[S, Outputs], float] | None = None
    """How far an arrow key moves a handle of points, in view box units."""


def places(
    handles: tuple[Handle[Any], ...], settings: object, outputs: Outputs, panels: tuple[Panel, ...]
) -> tuple[Place, ...]:
    """The places of the handles of a frame; marks are clamped to their panels.

    Raises `ValueError` for a handle whose panel is not in the frame.
    """
    sizes = {panel.name: (panel.width, panel.height) for panel in panels}
    found = []
    for handle in handles:
        if handle.panel not in sizes:
            legal = ", ".join(sizes)
            raise ValueError(f"handle {handle.name!r}: panel {handle.panel!r}; legal: {legal}")
        place = handle.at(settings, outputs)
        if place is None:
            continue
        pair = isinstance(place, tuple) and len(place) == 2
        if not pair or not all(isinstance(value, Real) for value in place):
            raise TypeError(f"handle {handle.name!r}: at returns {place!r}; legal: (x, y) or None")
        if not all(map(math.isfinite, place)):
            continue
        x, y = (float(value) for value in place)
        if handle.reach in ("mark", "press"):
            width, height = sizes[handle.panel]
            x, y = min(max(x, 0.0), width), min(max(y, 0.0), height)
        step = handle.step(settings, outputs) if handle.step else 0.0
        found.append(Place(handle.name, x, y, step))
    return tuple(found)


def values_at_place(
    handle: Handle[Any],
    settings: object,
    place: Point,
    controls: tuple[Control, ...],
    context: Mapping[str, object],
    outputs_at: Callable[[Any], Outputs],
) -> dict[str, Value]:
    """The values that bring ``handle`` as near to ``place`` as the controls allow.

    ``context`` holds further arguments of a pull by name: see `Handle.pull`. ``outputs_at``
    computes the outputs of the stages at other settings, for the search. A setting stays as it is
    if its new value is NaN or infinite. Raises `ValueError` for a place that is not finite, and for
    a pull that changes settings other than ``drives``.
    """
    if not all(map(math.isfinite, place)):
        raise ValueError(f"handle {handle.name!r}: place {place}; legal: finite numbers")
    by_name = {control.name: control for control in controls}
    if handle.pull is None:
        control = by_name[handle.drives[0]]
        return {control.name: _nearest_value(handle, settings, place, control, outputs_at)}
    values: dict[str, Value] = {}
    parameters = inspect.signature(handle.pull).parameters
    extra = {name: value for name, value in context.items() if name in parameters}
    pulled = handle.pull(settings, place, **extra)
    if not isinstance(pulled, Mapping):
        legal = ", ".join(f"{name!r}: …" for name in handle.drives)
        raise TypeError(f"handle {handle.name!r}: pull returns {pulled!r}; legal: {{{legal}}}")
    for name, value in pulled.items():
        if name not in handle.drives:
            legal = ", ".join(handle.drives)
            raise ValueError(f"handle {handle.name!r}: a pull changes {name!r}; legal: {legal}")
        control = by_name[name]
        if not isinstance(control, Slider):
            values[name] = control.clamp(value)
        elif not math.isnan(float(value)):
            values[name] = control.nearest(float(value))
    return values


def _nearest_value(
    handle: Handle[Any],
    settings: Any,
    place: Point,
    control: Control,
    outputs_at: Callable[[Any], Outputs],
) -> Value:
    """The value of ``control`` that brings the handle nearest to ``place``.

    Of a menu all options are compared; of a slider `COARSE` places of its range, then ever smaller
    parts around the nearest. Of values equally near, the one closest to the present value is taken.
    """
    here = getattr(settings, control.name)
    distances: dict[Value, float] = {}

    def rank(value: Value) -> tuple[float, float]:
        if value not in distances:
            is_int = isinstance(here, int) and isinstance(value, float) and value.is_integer()
            other = replace(settings, **{control.name: int(value) if is_int else value})
            at = handle.at(other, outputs_at(other))
            near = at is not None and all(map(math.isfinite, at))
            distances[value] = round(math.dist(at, place), 6) if at and near else math.inf
        change = abs(value - here) if isinstance(value, float) else float(value != here)
        return distances[value], change

    if isinstance(control, Choice):
        return min(control.options, key=rank)
    assert isinstance(control, Slider)
    low, high, count = 0, round((control.maximum - control.minimum) / control.step), COARSE
    while True:
        spots = {round(low + (high - low) * index / (count - 1)) for index in range(count)}
        values = {control.nearest(control.minimum + spot * control.step): spot for spot in spots}
        best = min(values, key=rank)
        if high - low < count:
            return best if math.isfinite(distances[best]) else here
        gap = math.ceil((high - low) / (count - 1))
        low, high, count = max(values[best] - gap, low), min(values[best] + gap, high), FINE


def mistakes(handles: tuple[Handle[Any], ...], controls: tuple[Control, ...]) -> list[str]:
    """Messages about mistakes in the handles of a scene."""
    names = [handle.name for handle in handles]
    grabbed = [handle.panel for handle in handles if handle.reach != "mark"]
    found = [f"two handles named {name!r}" for name in names if names.count(name) > 1]
    found += [
        f"two handles that the whole of panel {panel!r} moves; legal: one"
        for panel in grabbed
        if grabbed.count(panel) > 1
    ]
    legal = [control.name for control in controls if control.kind in ("slider", "choice", "points")]
    lists = [control.name for control in controls if control.kind == "points"]
    for handle in handles:
        who = f"handle {handle.name!r}"
        if len(handle.drives) not in (1, 2):
            found.append(f"{who} drives {handle.drives}; legal: one or two settings")
        if handle.pull is None and (len(handle.drives) > 1 or set(handle.drives) & set(lists)):
            found.append(f"{who} has no pull; legal where it drives one slider or menu")
        found += [
            f"{who} drives {name!r}; legal: {', '.join(legal) or 'none'}"
            for name in handle.drives
            if name not in legal
        ]
        found += [
            f"{who} reverses {name!r}; legal: {', '.join(handle.drives)}"
            for name in handle.reversed
            if name not in handle.drives
        ]
        if not is_role(handle.role):
            found.append(f"{who}: role {handle.role!r}; legal: small letters")
    return found
