"""The drawings over both pictures: the limits in the star, and the spot on the pixels."""

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
ROOM_FOR_NAME = 32.0
"""Radius from which on a circle of the star holds its name, in units."""
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


def star_overlay(settings: Settings) -> str:
    """Circles in the star of Nyquist's frequency and of the cut-off, and their handles. The name
    of the inner one is inside it, or else below both."""
    per_um = _star_scale(settings)
    rings = [
        (per_um * radius_um(nyquist_per_mm(settings.pitch)), "Nyquist", "camera"),
        (per_um * radius_um(cutoff(settings)), "cut-off", "ray"),
    ]
    parts = []
    for radius, _, role in rings:
        parts += [circle(MIDDLE, radius, "casing"), circle(MIDDLE, radius, f"{role} dashed")]
    (inner, *inside), (outer, *around) = sorted(rings)
    if inner > ROOM_FOR_NAME:
        rows = (MIDDLE[1] + 5, inside), (MIDDLE[1] - outer - 7, around)
    else:
        rows = (MIDDLE[1] + outer + 16, inside), (MIDDLE[1] - outer - 7, around)
    for row, (name, role) in rows:
        if 12.0 < row < HEIGHT - 4:
            aside = 5 if name == "Nyquist" else -5  # away from its handle
            parts.append(text((MIDDLE[0] + aside, row), name, f"{role} small ground", "middle"))
    parts += [dot(nyquist_mark(settings), "camera", 5), dot(cutoff_mark(settings), "ray", 5)]
    return "".join((*parts, *_scale(100 * per_um, "0.1 mm")))


def nyquist_mark(settings: Settings) -> tuple[float, float]:
    """The place on the left of the star's middle with the Nyquist frequency."""
    radius = _star_scale(settings) * radius_um(nyquist_per_mm(settings.pitch))
    return MIDDLE[0] - radius, MIDDLE[1]


def cutoff_mark(settings: Settings) -> tuple[float, float]:
    """The place on the right of the star's middle with the frequency of the cut-off."""
    return MIDDLE[0] + _star_scale(settings) * radius_um(cutoff(settings)), MIDDLE[1]


def frequency_of_ring(radius: float, settings: Settings) -> float:
    """In cycles/mm, at a distance from the star's middle in view box units."""
    return frequency_at(radius / _star_scale(settings))


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


def _scale(units: float, label: str) -> Iterator[str]:
    left, row = 12.0, HEIGHT - 12
    yield rectangle((left - 6, row - 27), units + 12, 34, "casing solid")
    yield line((left, row), (left + units, row), "bold")
    yield text((left, row - 10), label, "small")
