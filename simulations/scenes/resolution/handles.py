"""Handles of the resolution figure: both limits in the star, the spot's edge, and the frequency on
the curve."""

from collections.abc import Mapping
from dataclasses import replace

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.resolution import curves, sensor
from simulations.scenes.resolution.settings import Settings
from simulations.scenes.resolution.stages import micrometres

PITCHES = tuple(pitch / 10 for pitch in range(10, 101))
"""Those of the slider, in micrometres."""


def _spot(settings: Settings, _outputs: Outputs) -> Point:
    return sensor.spot_mark(settings)


def _spot_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"aperture": sensor.f_number_of(place, settings)}


def _wave(settings: Settings, outputs: Outputs) -> Point:
    x, y = curves.wave_at(settings, outputs["lens"])
    return float(x), float(y)


def _wave_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"frequency": curves.frequency_of(place)}


def _nyquist(settings: Settings, _outputs: Outputs) -> Point:
    return sensor.nyquist_mark(settings)


def _nyquist_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The picture holds whole pixels, so its scale changes a little with the pitch: all are
    tried."""
    return {
        "pitch": min(
            PITCHES,
            key=lambda pitch: abs(
                sensor.nyquist_mark(replace(settings, pitch=pitch))[0] - place[0]
            ),
        )
    }


def _cutoff(settings: Settings, _outputs: Outputs) -> Point:
    return sensor.cutoff_mark(settings)


def _cutoff_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    frequency = sensor.frequency_of_ring(place[0] - sensor.MIDDLE[0], settings)
    return {"aperture": 1000.0 / micrometres(settings.wavelength) / frequency}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "nyquist",
        "picture",
        "Circle of Nyquist",
        ("pitch",),
        _nyquist,
        _nyquist_pulled,
        role="camera",
        reversed=("pitch",),
    ),
    Handle(
        "cutoff",
        "picture",
        "Circle of the cut-off",
        ("aperture",),
        _cutoff,
        _cutoff_pulled,
        role="ray",
    ),
    Handle("spot", "spot", "Edge of the spot", ("aperture",), _spot, _spot_pulled, role="ray"),
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
)
