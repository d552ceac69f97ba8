"""Handles of the aliasing figure: the frequency and Nyquist's on their axis, a crest of
the wave, the stripes, and the ring of the zone plate that reaches Nyquist."""

import math
from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.aliasing import row, spectrum
from simulations.scenes.aliasing.pattern import Pattern, pattern_of
from simulations.scenes.aliasing.settings import Settings

UNITS_PER_PIXEL = row.WIDTH / 64
"""Size of the picture of the stripes in pixels, at every rate."""


def _pattern(settings: Settings) -> Pattern:
    return pattern_of(settings.pattern, settings.frequency, settings.phase, settings.rate)


def _frequency(settings: Settings, _outputs: Outputs) -> Point:
    return spectrum.wave_at(settings.frequency)


def _frequency_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"frequency": spectrum.frequency_at(place)}


def _nyquist(settings: Settings, _outputs: Outputs) -> Point:
    return spectrum.fold_at(0.5 * settings.rate)


def _nyquist_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"rate": 2.0 * spectrum.frequency_at(place)}


def _crest(settings: Settings, outputs: Outputs) -> Point | None:
    return None if outputs["photograph"] else row.crest(_pattern(settings))


def _crest_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    pixels = row.pixels_at(place)
    turns = row.crest_turns(math.radians(settings.phase))
    return {"frequency": turns / pixels if pixels > 0 else math.inf}


def _stripes(settings: Settings, outputs: Outputs) -> Point | None:
    """A zero crossing of the wave, which moves left as the phase grows."""
    if outputs["photograph"] or settings.pattern != "stripes" or settings.frequency == 0:
        return None
    return (-settings.phase / 360 / settings.frequency * UNITS_PER_PIXEL, 0.0)


def _stripes_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    phase = -360 * settings.frequency * place[0] / UNITS_PER_PIXEL
    return {"phase": phase if -1e-6 <= phase <= 360 + 1e-6 else phase % 360}


def _ring(settings: Settings, outputs: Outputs) -> Point | None:
    """The leftmost point of the ring, if it is in the picture."""
    if outputs["photograph"] or settings.pattern != "zone_plate":
        return None
    return row.ring(_pattern(settings))


def _ring_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"frequency": row.frequency_of_ring(place, settings.rate)}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "frequency",
        "spectrum",
        "Frequency",
        ("frequency",),
        _frequency,
        _frequency_pulled,
        "press",
        "world",
    ),
    Handle(
        "crest",
        "row",
        "Crest of the wave",
        ("frequency",),
        _crest,
        _crest_pulled,
        role="world",
        reversed=("frequency",),
    ),
    Handle(
        "stripes",
        "picture",
        "Stripes",
        ("phase",),
        _stripes,
        _stripes_pulled,
        "drag",
        reversed=("phase",),
    ),
    Handle(
        "ring", "picture", "Ring at Nyquist", ("frequency",), _ring, _ring_pulled, role="camera"
    ),
    Handle(
        "nyquist",
        "spectrum",
        "Limit at Nyquist",
        ("rate",),
        _nyquist,
        _nyquist_pulled,
        role="camera",
    ),
)
