"""Handles of the pinhole: the rim of the hole."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.pinhole.drawing import hole_at, rim
from simulations.scenes.pinhole.settings import Settings


def _rim(settings: Settings, _outputs: Outputs) -> Point:
    return rim(settings.hole)


def _rim_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"hole": hole_at(place)}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("rim", "section", "Rim of the hole", ("hole",), _rim, _rim_pulled, role="camera"),
)
