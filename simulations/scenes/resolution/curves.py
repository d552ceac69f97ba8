"""The second panel: what each link leaves of a wave's contrast, by frequency, and all together."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simulations.engine.drawing import Point, dot, line, path, polygon, polyline, text
from simulations.models.arrays import Floats
from simulations.models.lens.diffraction import cutoff_per_mm
from simulations.models.sensor.resolution import (
    first_fall,
    nyquist_per_mm,
    pixel_transfer,
    plate_transfer,
)
from simulations.scenes.resolution.settings import Settings
from simulations.scenes.resolution.stages import Lens, micrometres

LEFT, RIGHT, FLOOR, FULL = 34.0, 388.0, 214.0, 40.0
"""Edges of the plot, its zero line, and the row of contrast 1."""
HIGHEST = 500.0
FREQUENCIES = np.linspace(0.0, HIGHEST, 501)
FINE = np.linspace(0.0, 1000.0, 2001)
"""From its beginning to where the smallest pixel leaves nothing."""


@dataclass(frozen=True, slots=True)
class Links:
    """What is left of the contrast of waves along a row of pixels, each (...); signs are kept."""

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
            *_axes(nyquist),
            *_curves(settings, lens, nyquist),
            *_limits(settings, nyquist),
            *_marked(settings, lens),
            *_legend(settings),
        )
    )


def wave_at(settings: Settings, lens: Lens) -> Point:
    """On the curve of all links, at the frequency that is marked."""
    left = links(settings, lens, np.asarray(settings.frequency)).together
    return _at(settings.frequency, abs(float(left)))


def on_axis(frequency_per_mm: float) -> tuple[float, float] | None:
    """Where a limit meets the axis; None beyond its end."""
    return _at(frequency_per_mm, 0.0) if frequency_per_mm <= HIGHEST else None


def frequency_of(place: Point) -> float:
    """In cycles/mm."""
    return HIGHEST * (float(place[0]) - LEFT) / (RIGHT - LEFT)


def _axes(nyquist: float) -> Iterator[str]:
    start = min(nyquist, HIGHEST)
    beyond = [_at(start, 0), _at(HIGHEST, 0), _at(HIGHEST, 1), _at(start, 1)]
    yield polygon(beyond, "muted fill faint")
    yield path([[_at(0, 1.05), _at(0, 0), _at(HIGHEST, 0)]], "muted")
    yield path([[_at(0, share), _at(HIGHEST, share)] for share in (0.5, 1.0)], "muted thin faint")
    for tick in range(0, 501, 100):
        x, y = _at(tick, 0)
        yield line((x, y), (x, y + 5), "muted thin")
        yield text((x, y + 21), f"{tick}", "muted small", "middle")
    for share in (0.0, 0.5, 1.0):
        x, y = _at(0, share)
        yield text((x - 6, y + 4), f"{share:g}", "muted small", "end")
    yield text((RIGHT, FLOOR + 42), "frequency, cycles per mm", "small", "end")


def _curves(settings: Settings, lens: Lens, nyquist: float) -> Iterator[str]:
    each = links(settings, lens, FREQUENCIES)
    if settings.plate:
        yield polyline(_curve(each.plate), "muted")
    yield polyline(_curve(each.pixel), "camera")
    yield polyline(_curve(each.lens), "ray dashed")
    together, held = _curve(each.together), nyquist >= FREQUENCIES
    yield polyline(
        [point for point, seen in zip(together, held, strict=True) if seen], "image bold"
    )
    false = [point for point, seen in zip(together, held, strict=True) if not seen]
    if false:
        yield polyline(false, "error bold")


def _curve(factors: Floats) -> list[tuple[float, float]]:
    sizes = np.abs(factors).tolist()
    return [_at(f, size) for f, size in zip(FREQUENCIES.tolist(), sizes, strict=True)]


def _limits(settings: Settings, nyquist: float) -> Iterator[str]:
    """Nyquist's frequency and the cut-off; their names stay apart where the lines are close."""
    ends = (("Nyquist", nyquist, "camera", 12.0), ("cut-off 1/λN", cutoff(settings), "ray", 28.0))
    for name, frequency, role, row in ends:
        place = on_axis(frequency)
        if place is None:
            yield text((RIGHT, row), f"{name} →", f"{role} small", "end")
            continue
        x = place[0]
        yield line((x, FLOOR), (x, row + 4), f"{role} thin dashed")
        yield dot(place, role, 5)
        reach = 3.2 * len(name) + 4
        yield text((min(max(x, reach), 400 - reach), row), name, f"{role} small halo", "middle")


def _marked(settings: Settings, lens: Lens) -> Iterator[str]:
    place = wave_at(settings, lens)
    yield line(_at(settings.frequency, 0), _at(settings.frequency, 1), "world thin")
    yield dot(place, "world", 5)


def _legend(settings: Settings) -> Iterator[str]:
    entries = [("lens", "ray dashed"), ("pixel", "camera"), ("together", "image bold")]
    if settings.plate:
        entries.insert(2, ("plate", "muted"))
    for index, (name, style) in enumerate(entries):
        x = LEFT + 88.0 * index
        yield line((x, 278), (x + 20, 278), style)
        yield text((x + 25, 282), name, f"{style.split()[0]} small")


def _at(frequency: float, contrast: float) -> tuple[float, float]:
    return (LEFT + (RIGHT - LEFT) * frequency / HIGHEST, FLOOR - (FLOOR - FULL) * contrast)
