"""Handles of the wagon wheel: the marked spoke, the speed on its dial, and the time."""

import math
from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.wagon_wheel.drawing import (
    UNITS_PER_FRAME,
    angle_at,
    marked_spoke,
    on_dial,
    speed_at,
)
from simulations.scenes.wagon_wheel.settings import FRAMES, Settings


def _turn_per_frame(settings: Settings) -> float:
    return 2 * math.pi * settings.speed / settings.frame_rate


def _spoke(settings: Settings, _outputs: Outputs) -> Point | None:
    """None for a wheel that does not turn, which time does not move."""
    if settings.speed == 0:
        return None
    return marked_spoke(_turn_per_frame(settings) * settings.time)


def _spoke_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    turn = _turn_per_frame(settings)
    return {"time": _reached(place, turn, 0.0, settings.time, FRAMES)} if turn else {}


def _reached(place: Point, turn: float, start: float, now: float, end: float) -> float:
    """Frames from ``start``, 0 to ``end``, after which a spoke points to a place.

    Of all turns that nearest to ``now``; otherwise the end that is closest.
    """
    ahead = _half_turn(angle_at(place) - turn * (start + now)) / turn
    around = 2 * math.pi / abs(turn)
    times = [now + ahead + rounds * around for rounds in (-1, 0, 1)]
    within = [when for when in times if -1e-9 <= when <= end + 1e-9]
    if within:
        return min(within, key=lambda when: abs(when - now))
    return min(
        (0.0, end), key=lambda when: abs(_half_turn(turn * (start + when) - angle_at(place)))
    )


def _half_turn(angle: float) -> float:
    """The angle, reduced to -π to π."""
    return math.remainder(angle, 2 * math.pi)


def _speed(settings: Settings, _outputs: Outputs) -> Point:
    return on_dial(settings.speed)


def _speed_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"speed": speed_at(place)}


def _time(settings: Settings, _outputs: Outputs) -> Point:
    """Place of frame 0, in a plot without a left end."""
    return (-settings.time * UNITS_PER_FRAME, 0.0)


def _time_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"time": -place[0] / UNITS_PER_FRAME}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("speed", "wheel", "Speed", ("speed",), _speed, _speed_pulled, role="world"),
    Handle("spoke", "wheel", "Marked spoke", ("time",), _spoke, _spoke_pulled, role="ray"),
    Handle(
        "time", "track", "Row of frames", ("time",), _time, _time_pulled, "drag", reversed=("time",)
    ),
)
