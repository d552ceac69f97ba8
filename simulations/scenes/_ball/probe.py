"""The probed point on the ball, and the angle of a place, for the handles of both figures."""

import math
from collections.abc import Mapping
from typing import Any, Protocol

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes._ball.marks import angle_of_normal, on_equator


class Probed(Protocol):
    """Settings of a figure with a probed point."""

    @property
    def probe(self) -> float: ...


def _probe(settings: Probed, _outputs: Outputs) -> Point:
    return on_equator(math.radians(settings.probe))


def _probe_pulled(_settings: Probed, place: Point) -> Mapping[str, Value]:
    return {"probe": angle_of_normal(place)}


def probe_on_ball(role: str) -> Handle[Any]:
    """The probed point in the camera's picture."""
    return Handle("probe", "camera", "Probed point", ("probe",), _probe, _probe_pulled, role=role)


def bearing_deg(across: float, along: float, present_deg: float) -> float:
    """The angle of a vector from the direction ``along``; the present angle for a zero vector."""
    return math.degrees(math.atan2(across, along)) if across or along else present_deg
