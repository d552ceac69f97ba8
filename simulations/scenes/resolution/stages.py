"""The stages of the resolution figure: the lens's transfer function, its spot, and a star.

The star is a picture of cos(nφ): locally a plane wave, finer towards the middle. Each link
multiplies it by its factor for the wave at that place. This ignores that the wave bends and narrows
within the reach of the blur.
"""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.lens.diffraction import cutoff_per_mm, lens_transfer, spot
from simulations.models.pixel_grid import centred
from simulations.models.sensor.resolution import pixel_transfer, plate_transfer

FIELD_UM = 400.0
"""Width of the part of the sensor in the picture, to the nearest four pixels."""
CYCLES = 48
"""Periods of the star around a circle."""
CLOSE_UM = (40.0, 30.0)
"""Size of the part of the sensor in the first panel."""
CLOSE_PX = (200, 150)
SPOT_TO_UM = 33.0
"""Distance from the middle of that part to its corners, plus half of a pixel's diagonal."""
SHARES = np.linspace(0.0, 1.0, 385)
RADII_UM = np.linspace(0.0, SPOT_TO_UM, 441)


@dataclass(frozen=True, slots=True)
class Lens:
    """The transfer function of a lens, as a table."""

    frequencies: Floats
    """(n,) in cycles/mm, from 0 to the cut-off."""
    factors: Floats
    """(n,)."""

    def at(self, frequency_per_mm: Floats) -> Floats:
        """Factor (...) at frequencies (...): beyond the cut-off, 0."""
        return np.interp(frequency_per_mm, self.frequencies, self.factors)


@dataclass(frozen=True, slots=True)
class Star:
    """The lower right quarter of the star at each pixel, before the lens; the others mirror it."""

    wave: Floats
    """(h, w) wave from −1 to 1, attenuated by pixel and plate."""
    frequency: Floats
    """(h, w) in cycles/mm."""


def micrometres(nanometres: float) -> float:
    return nanometres / 1000.0


def columns(pitch: float) -> int:
    """Width of the picture in pixels: a multiple of four, as it is 4 : 3."""
    return 4 * round(FIELD_UM / 4.0 / pitch)


def frequency_at(radius_um: float) -> float:
    """Frequency of the star, in cycles/mm, at a distance from its middle."""
    return 1000.0 * CYCLES / (2.0 * math.pi * radius_um) if radius_um > 0 else math.inf


def radius_um(frequency_per_mm: float) -> float:
    """The inverse of `frequency_at`."""
    return 1000.0 * CYCLES / (2.0 * math.pi * frequency_per_mm)


def _lens(aperture: float, wavelength: float, defocus: float) -> Lens:
    frequencies = SHARES * cutoff_per_mm(micrometres(wavelength), aperture)
    factors = lens_transfer(frequencies, micrometres(wavelength), aperture, defocus)
    return Lens(frequencies, factors)


def _spot(aperture: float, wavelength: float, defocus: float) -> Floats:
    """(n,) light at `RADII_UM`."""
    return spot(RADII_UM, micrometres(wavelength), aperture, defocus)


def _close(profile: Floats, pitch: float, plate: bool) -> Raster:
    """The spot, or its four copies by the plate; the brightest place is white."""
    (width, height), (columns, rows) = CLOSE_UM, CLOSE_PX
    x = centred(columns) * (width / columns)
    y = centred(rows) * (height / rows)
    off = pitch / 2.0 if plate else 0.0
    # Four copies at ±½ pixel: each is the mirror image of another.
    one = np.interp(np.hypot(x + off, y[:, None] + off), RADII_UM, profile)
    light = one + one[:, ::-1] + one[::-1] + one[::-1, ::-1] if plate else one
    return to_rgba8(encode_srgb(light / light.max()))


def _star(pitch: float, plate: bool) -> Star:
    """The star at the centres of the pixels; its own centre is between two columns."""
    count = columns(pitch)
    x, y = np.meshgrid(_half(count) * pitch, _half(3 * count // 4) * pitch)
    per_um = CYCLES / (2.0 * np.pi) / (x * x + y * y)
    across, down = 1000.0 * per_um * y, 1000.0 * per_um * x
    wave = np.cos(CYCLES * np.arctan2(y, x))
    wave *= pixel_transfer(across, pitch) * pixel_transfer(down, pitch)
    if plate:
        wave *= plate_transfer(across, pitch) * plate_transfer(down, pitch)
    return Star(wave, np.hypot(across, down))


def _half(count: int) -> Floats:
    """Centres of the pixels from the middle on."""
    return centred(count)[count // 2 :]


def light_of(lens: Lens, star: Star) -> Floats:
    """(h, w) measured picture of a star from 0 to 1."""
    return 0.5 + 0.5 * lens.at(star.frequency) * star.wave


def _picture(lens: Lens, star: Star, pitch: float) -> Raster:
    across, down = (
        np.abs(centred(count)).astype(int) for count in (columns(pitch), 3 * columns(pitch) // 4)
    )
    quarter = to_rgba8(encode_srgb(light_of(lens, star)))
    return np.ascontiguousarray(quarter[down][:, across])


STAGES = (
    Stage("lens", _lens),
    Stage("spot", _spot),
    Stage("close", _close, ("spot",)),
    Stage("star", _star),
    Stage("picture", _picture, ("lens", "star")),
)
