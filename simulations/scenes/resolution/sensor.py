"""The first and the third panel: the spot on the pixels, and the limits in the star."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import Point, circle, dot, line, path, rectangle, text
from simulations.models.lens.diffraction import FIRST_ZERO, spot_diameter_um
from simulations.models.sensor.resolution import nyquist_per_mm
from simulations.scenes.resolution.curves import cutoff
from simulations.scenes.resolution.settings import Settings
from simulations.scenes.resolution.stages import (
    CLOSE_UM,
    columns,
    frequency_at,
    micrometres,
    radius_um,
)

WIDTH, HEIGHT = 400.0, 300.0
MIDDLE = (WIDTH / 2, HEIGHT / 2)
PER_UM = WIDTH / CLOSE_UM[0]
"""Units of the first panel."""


def close_overlay(settings: Settings) -> str:
    """The grid of pixels, the middle one, and the first dark ring."""
    return "".join((*_grid(settings.pitch), *_ring(settings), *_scale(10.0 * PER_UM, "10 µm")))


def spot_mark(settings: Settings) -> tuple[float, float]:
    """The handle on the right of the first dark ring."""
    return MIDDLE[0] + PER_UM * _spot_radius(settings), MIDDLE[1]


def f_number_of(place: Point, settings: Settings) -> float:
    """The setting whose ring passes through a place."""
    radius = max(float(place[0]) - MIDDLE[0], 0.0) / PER_UM
    return radius / FIRST_ZERO / micrometres(settings.wavelength)


def corner_mark(settings: Settings) -> tuple[float, float]:
    """The lower right corner of the middle pixel."""
    half = PER_UM * settings.pitch / 2.0
    return MIDDLE[0] + half, MIDDLE[1] + half


def pitch_of(place: Point) -> float:
    """The setting whose corner is nearest to a place."""
    return (float(place[0]) - MIDDLE[0] + float(place[1]) - MIDDLE[1]) / PER_UM


def star_overlay(settings: Settings) -> str:
    """Circles in the star of the marked frequency, of Nyquist's, and of the cut-off."""
    per_um = _star_scale(settings)
    rings = (
        ("Nyquist", nyquist_per_mm(settings.pitch), "camera dashed"),
        ("cut-off", cutoff(settings), "ray dashed"),
        ("", settings.frequency, "world"),
    )
    parts = []
    for name, frequency, style in rings:
        radius = per_um * radius_um(frequency)
        if radius < math.hypot(*MIDDLE):
            parts += [circle(MIDDLE, radius, "casing"), circle(MIDDLE, radius, style)]
        if name and 16.0 < radius < HEIGHT / 2 - 4:
            above = (
                MIDDLE[0],
                MIDDLE[1] - radius - 4 if name == "Nyquist" else MIDDLE[1] + radius + 13,
            )
            parts.append(text(above, name, f"{style.split()[0]} small halo", "middle"))
    mark = ring_mark(settings)
    return "".join((*parts, dot(mark, "world", 5) if mark else "", *_scale(100 * per_um, "0.1 mm")))


def ring_mark(settings: Settings) -> tuple[float, float] | None:
    """The place on the left of the star's middle with the marked frequency."""
    radius = _star_scale(settings) * radius_um(settings.frequency)
    return (MIDDLE[0] - radius, MIDDLE[1]) if radius < MIDDLE[0] else None


def frequency_of_ring(place: Point, settings: Settings) -> float:
    return frequency_at((MIDDLE[0] - float(place[0])) / _star_scale(settings))


def _star_scale(settings: Settings) -> float:
    """Units per micrometre, for which whole pixels fill the panel."""
    return WIDTH / (columns(settings.pitch) * settings.pitch)


def _spot_radius(settings: Settings) -> float:
    return spot_diameter_um(micrometres(settings.wavelength), settings.aperture) / 2.0


def _grid(pitch: float) -> Iterator[str]:
    step = PER_UM * pitch
    lines = []
    for middle, across in zip(MIDDLE, (True, False), strict=True):
        count = math.floor(middle / step - 0.5)
        for at in (middle + step * (np.arange(-count - 1, count + 1) + 0.5)).tolist():
            if 0 <= at <= 2 * middle:
                lines.append([(at, 0), (at, HEIGHT)] if across else [(0, at), (WIDTH, at)])
    yield path(lines, "camera thin faint")
    corner = (MIDDLE[0] - step / 2, MIDDLE[1] - step / 2)
    yield rectangle(corner, step, step, "casing")
    yield rectangle(corner, step, step, "camera")


def _ring(settings: Settings) -> Iterator[str]:
    radius = PER_UM * _spot_radius(settings)
    yield circle(MIDDLE, radius, "casing")
    yield circle(MIDDLE, radius, "ray dashed")
    yield dot(spot_mark(settings), "ray", 5)
    yield dot(corner_mark(settings), "camera", 5)
    row = max(MIDDLE[1] - radius - 8, 16.0)
    yield text((MIDDLE[0], row), "2.44 λN", "ray halo", "middle")


def _scale(units: float, label: str) -> Iterator[str]:
    left, row = 12.0, HEIGHT - 12
    yield line((left, row), (left + units, row), "casing")
    yield line((left, row), (left + units, row), "bold")
    yield text((left, row - 8), label, "small halo")
