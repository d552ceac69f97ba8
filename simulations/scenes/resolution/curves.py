"""The plot of the transfer functions of all links, and their product."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simulations.engine.drawing import Point, dot, line, text
from simulations.engine.letters import width_of
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats
from simulations.models.lens.diffraction import cutoff_per_mm
from simulations.models.sampling.first_fall import first_fall
from simulations.models.sensor.resolution import (
    nyquist_per_mm,
    pixel_transfer,
    plate_transfer,
)
from simulations.scenes.resolution.settings import Settings
from simulations.scenes.resolution.stages import Lens, micrometres

WIDTH = 400.0
HIGHEST = 500.0
PLOT = Plot(Axis(0.0, HIGHEST, 34.0, 388.0), Axis(0.0, 1.0, 214.0, 40.0))
"""Cycles per mm, and contrast."""
ACROSS = Scale("frequency", "cycles per mm", (0, 250, 500), style="small", tick_style="muted small")
UP = Scale(ticks=(0, 0.5, 1), grid=(0.5, 1), tick_style="muted small")
LIMITS = 28.0
"""Row of the names of the limits."""
FREQUENCIES = np.linspace(0.0, HIGHEST, 501)
FINE = np.linspace(0.0, 1000.0, 2001)
"""Range of the axis: to the zero of the smallest pixel's transfer function."""


@dataclass(frozen=True, slots=True)
class Links:
    """The transfer factors of the links for waves along a row of pixels, each (...), with signs."""

    lens: Floats
    pixel: Floats
    plate: Floats

    @property
    def together(self) -> Floats:
        return self.lens * self.pixel * self.plate


def links(settings: Settings, lens: Lens, frequency_per_mm: Floats) -> Links:
    separation = settings.pitch if settings.plate else 0.0
    return Links(
        lens.at(frequency_per_mm),
        pixel_transfer(frequency_per_mm, settings.pitch),
        plate_transfer(frequency_per_mm, separation),
    )


def cutoff(settings: Settings) -> float:
    return cutoff_per_mm(micrometres(settings.wavelength), settings.aperture)


def mtf50(settings: Settings, lens: Lens) -> float:
    """In cycles/mm."""
    return first_fall(FINE, np.abs(links(settings, lens, FINE).together), 0.5)


def draw(settings: Settings, lens: Lens) -> str:
    nyquist = nyquist_per_mm(settings.pitch)
    return "".join(
        (
            PLOT.region(x=(min(nyquist, HIGHEST), HIGHEST)),
            PLOT.frame(ACROSS, UP),
            *_curves(settings, lens, nyquist),
            *_limits(settings, nyquist),
            *_marked(settings, lens),
            _legend(settings),
        )
    )


def wave_at(settings: Settings, lens: Lens) -> Point:
    """The handle on the curve of all links, at the marked frequency."""
    left = links(settings, lens, np.asarray(settings.frequency)).together
    return PLOT.at(settings.frequency, abs(float(left)))


def frequency_of(place: Point) -> float:
    """In cycles/mm."""
    return PLOT.values(place)[0]


def _curves(settings: Settings, lens: Lens, nyquist: float) -> Iterator[str]:
    each = links(settings, lens, FREQUENCIES)
    together, resolved = np.abs(each.together), nyquist >= FREQUENCIES
    if settings.plate:
        yield PLOT.curve(FREQUENCIES, np.abs(each.plate), "muted")
    yield PLOT.curve(FREQUENCIES, np.abs(each.pixel), "camera")
    yield PLOT.curve(FREQUENCIES, np.abs(each.lens), "ray dashed")
    yield PLOT.curve(FREQUENCIES[resolved], together[resolved], "image bold")
    yield PLOT.curve(FREQUENCIES[~resolved], together[~resolved], "error bold")


def _limits(settings: Settings, nyquist: float) -> Iterator[str]:
    """The Nyquist frequency and the cut-off: the lower one is named left of its line, the other
    right of it, or above it where that is at the border."""
    ends = [("Nyquist", nyquist, "camera"), ("cut-off", cutoff(settings), "ray")]
    ends.sort(key=lambda end: end[1])
    for (name, frequency, role), side in zip(ends, ("end", "start"), strict=True):
        if frequency > HIGHEST:
            yield text((PLOT.x.end, 12.0), f"{name} →", f"{role} small", "end")
            continue
        x = PLOT.x.place(frequency)
        yield line((x, PLOT.y.start), (x, LIMITS), f"{role} thin dashed")
        if side == "start" and x + 6 + width_of(name, "small") > WIDTH:
            yield text((PLOT.x.end, 12.0), name, f"{role} small", "end")
        else:
            yield text((x + (6 if side == "start" else -6), LIMITS), name, f"{role} small", side)


def _marked(settings: Settings, lens: Lens) -> Iterator[str]:
    yield PLOT.upright(settings.frequency, "world thin")
    x, late = PLOT.x.place(settings.frequency), settings.frequency > 0.9 * HIGHEST
    name = (x - 6 if late else x + 6, PLOT.y.start - 7)
    yield text(name, "f", "world small ground", "end" if late else "start")
    yield dot(wave_at(settings, lens), "world", 5)


def _legend(settings: Settings) -> str:
    entries = [
        Entry("lens", "ray dashed"),
        Entry("pixel", "camera"),
        Entry("together", "image bold"),
        Entry("false", "error bold"),
        Entry("plate", "muted", shown=settings.plate),
    ]
    return legend((PLOT.x.start, 282), entries, "small", PLOT.x.end - PLOT.x.start)
