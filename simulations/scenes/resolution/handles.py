"""Handles of the resolution figure: the spot's edge, a pixel's corner, the frequency
on the curve and in the star, and both limits on the axis."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.models.sensor.resolution import nyquist_per_mm
from simulations.scenes.resolution import curves, sensor
from simulations.scenes.resolution.settings import Settings
from simulations.scenes.resolution.stages import micrometres


def _spot(settings: Settings, _outputs: Outputs) -> Point:
    return sensor.spot_mark(settings)


def _spot_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"aperture": sensor.f_number_of(place, settings)}


def _corner(settings: Settings, _outputs: Outputs) -> Point:
    return sensor.corner_mark(settings)


def _corner_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"pitch": sensor.pitch_of(place)}


def _wave(settings: Settings, outputs: Outputs) -> Point:
    x, y = curves.wave_at(settings, outputs["lens"])
    return float(x), float(y)


def _wave_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"frequency": curves.frequency_of(place)}


def _nyquist(settings: Settings, _outputs: Outputs) -> Point | None:
    return curves.on_axis(nyquist_per_mm(settings.pitch))


def _nyquist_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    frequency = curves.frequency_of(place)
    return {"pitch": 500.0 / max(frequency, 1.0)}


def _cutoff(settings: Settings, _outputs: Outputs) -> Point | None:
    return curves.on_axis(curves.cutoff(settings))


def _cutoff_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    frequency = max(curves.frequency_of(place), 1.0)
    return {"aperture": 1000.0 / micrometres(settings.wavelength) / frequency}


def _ring(settings: Settings, _outputs: Outputs) -> Point | None:
    return sensor.ring_mark(settings)


def _ring_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"frequency": sensor.frequency_of_ring(place, settings)}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("spot", "spot", "Edge of the spot", ("aperture",), _spot, _spot_pulled, role="ray"),
    Handle(
        "corner", "spot", "Corner of a pixel", ("pitch",), _corner, _corner_pulled, role="camera"
    ),
    Handle(
        "wave",
        "curves",
        "Frequency of the wave",
        ("frequency",),
        _wave,
        _wave_pulled,
        "press",
        "world",
    ),
    Handle(
        "nyquist",
        "curves",
        "Nyquist frequency",
        ("pitch",),
        _nyquist,
        _nyquist_pulled,
        role="camera",
        reversed=("pitch",),
    ),
    Handle(
        "cutoff",
        "curves",
        "Cut-off of the lens",
        ("aperture",),
        _cutoff,
        _cutoff_pulled,
        role="ray",
        reversed=("aperture",),
    ),
    Handle(
        "ring",
        "picture",
        "Frequency in the star",
        ("frequency",),
        _ring,
        _ring_pulled,
        role="world",
    ),
)
