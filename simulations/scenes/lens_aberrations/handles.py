"""Handles of the lens-aberrations figure, in the lens from the side: the stop, the edge of its
opening, and the rim."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.lens_aberrations.section import (
    millimetres,
    opening_mark,
    rim_mark,
    stop_mark,
)
from simulations.scenes.lens_aberrations.settings import Settings
from simulations.scenes.lens_aberrations.stages import FOCAL_MM


def _stop(settings: Settings, _outputs: Outputs) -> Point:
    return stop_mark(settings.stop)


def _stop_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"stop": -millimetres(place)[0]}


def _opening(settings: Settings, _outputs: Outputs) -> Point:
    return opening_mark(settings.stop, settings.aperture)


def _opening_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    radius = max(-millimetres(place)[1], 1e-3)
    return {"aperture": FOCAL_MM / 2.0 / radius}


def _rim(settings: Settings, _outputs: Outputs) -> Point:
    return rim_mark(settings.stop, settings.rim)


def _rim_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"rim": -millimetres(place)[0] - settings.stop}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("stop", "lens", "Aperture stop", ("stop",), _stop, _stop_pulled, reversed=("stop",)),
    Handle(
        "opening",
        "lens",
        "Edge of the opening",
        ("aperture",),
        _opening,
        _opening_pulled,
    ),
    Handle("rim", "lens", "Rim", ("rim",), _rim, _rim_pulled, role="camera", reversed=("rim",)),
)
