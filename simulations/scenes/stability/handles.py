"""Handles of the stability figure: the distance that is marked."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.stability import plot
from simulations.scenes.stability.errors import DISTANCES
from simulations.scenes.stability.settings import Settings


def _place(settings: Settings, outputs: Outputs) -> Point:
    found = plot.mark(settings, outputs["errors"])
    if found is None:
        return plot.PLOT.at(float(DISTANCES[plot.place_of(settings)]), 1.0)
    return float(found[0]), float(found[1])


def _place_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"power": plot.power_at(place)}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "place",
        "plot",
        "Mark on the curve",
        ("power",),
        _place,
        _place_pulled,
        "press",
        "world",
    ),
)
