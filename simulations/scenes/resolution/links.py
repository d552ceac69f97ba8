"""The links from a scene to a picture: lens, low-pass plate and pixels; and a star through all.

The star is a picture of cos(nφ): locally a plane wave, finer towards the middle. Each link
multiplies it by its factor for the wave at that place. This ignores that the wave bends and narrows
within the reach of the blur.
"""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import Raster
from simulations.engine.raster import of_planes, opaque
from simulations.engine.settings import slider, toggle
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats, centred
from simulations.models.color.srgb import encode_srgb_codes
from simulations.models.lens import diffraction
from simulations.models.sampling.first_fall import first_fall
from simulations.models.sensor.resolution import nyquist_per_mm, pixel_transfer, plate_transfer
from simulations.scenes._cat import blurred

FIELD_UM = 400.0  # width of the part of the sensor in the picture, to the nearest four pixels
WAVES_PER_MM = 1000.0 * 240 / FIELD_UM  # of one cycle per pixel of the subject, as wide
CYCLES = 48  # periods of the star around a circle
CLOSE_UM = (40.0, 30.0)  # size of the part of the sensor around the spot
CLOSE_PX = (200, 150)
SHARES = np.linspace(0.0, 1.0, 385)
# To the corners of that part, plus half of a pixel's diagonal.
RADII_UM = np.linspace(0.0, 33.0, 441)
FINE = np.linspace(0.0, 1000.0, 2001)  # cycles/mm, to the zero of the smallest pixel's transfer


@dataclass(frozen=True, slots=True)
class Settings:
    aperture: float = slider("Aperture", 8, 1.4, 22, 0.1, prefix="f/")
    pitch: float = slider("Pixel pitch p", 4, 1, 10, 0.1, unit="µm")
    frequency: float = slider("Frequency f", 75, 10, 500, 5, unit="/mm")
    defocus: float = slider("Defocus", 0, 0, 70, 1, unit="µm")
    plate: bool = toggle("Low-pass plate")
    wavelength: float = slider("Wavelength λ", 550, 400, 700, 10, unit="nm")

    @property
    def nyquist(self) -> float:
        """Nyquist frequency of the pixels, cycles/mm."""
        return nyquist_per_mm(self.pitch)

    @property
    def cutoff(self) -> float:
        """Cut-off frequency of the lens, cycles/mm."""
        return diffraction.cutoff_per_mm(self.wavelength / 1000.0, self.aperture)

    @property
    def spot_um(self) -> float:
        """Diameter of the first dark ring."""
        return diffraction.spot_diameter_um(self.wavelength / 1000.0, self.aperture)


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
class Links:
    """The transfer factors of the links for waves along a row of pixels, each (...), with signs."""

    lens: Floats
    pixel: Floats
    plate: Floats

    @property
    def together(self) -> Floats:
        return self.lens * self.pixel * self.plate


def links(settings: Settings, lens: Lens, frequency_per_mm: Floats | float) -> Links:
    frequency = np.asarray(frequency_per_mm)
    separation = settings.pitch if settings.plate else 0.0
    pixel = pixel_transfer(frequency, settings.pitch)
    return Links(lens.at(frequency), pixel, plate_transfer(frequency, separation))


def mtf50(settings: Settings, lens: Lens) -> float:
    """Frequency at which half of the contrast is left, cycles/mm."""
    return first_fall(FINE, np.abs(links(settings, lens, FINE).together), 0.5)


@dataclass(frozen=True, slots=True)
class Star:
    """The lower right quarter of the star at each pixel, before the lens; the others mirror it."""

    wave: Floats
    """(h, w) wave from −1 to 1, attenuated by pixel and plate."""
    frequency: Floats
    """(h, w) in cycles/mm."""


def columns(pitch: float) -> int:
    """Width of the picture in pixels: a multiple of four, as it is 4 : 3."""
    return 4 * round(FIELD_UM / 4.0 / pitch)


def radius_um(frequency_per_mm: float) -> float:
    """Distance from the star's middle at which it has a frequency."""
    return 1000.0 * CYCLES / (2.0 * math.pi * frequency_per_mm)


def lens(aperture: float, wavelength: float, defocus: float) -> Lens:
    frequencies = SHARES * diffraction.cutoff_per_mm(wavelength / 1000.0, aperture)
    factors = diffraction.lens_transfer(frequencies, wavelength / 1000.0, aperture, defocus)
    return Lens(frequencies, factors)


def spot(aperture: float, wavelength: float, defocus: float) -> Floats:
    """(n,) light at `RADII_UM`."""
    return diffraction.spot(RADII_UM, wavelength / 1000.0, aperture, defocus)


def close(profile: Floats, pitch: float, plate: bool) -> Raster:
    """The spot, or its four copies by the plate; the brightest place is white."""
    x, y = (centred(px) * (um / px) for um, px in zip(CLOSE_UM, CLOSE_PX, strict=True))
    off = pitch / 2.0 if plate else 0.0
    # Four copies at ±½ pixel: each is the mirror image of another.
    one = np.interp(np.hypot(x + off, y[:, None] + off), RADII_UM, profile)
    light = one + one[:, ::-1] + one[::-1] + one[::-1, ::-1] if plate else one
    return opaque(encode_srgb_codes(light / light.max()))


def star(pitch: float, plate: bool) -> Star:
    """The star at the centres of the pixels; its own centre is between two columns."""
    count = columns(pitch)
    x, y = np.meshgrid(*(centred(n)[n // 2 :] * pitch for n in (count, 3 * count // 4)))
    per_um = CYCLES / (2.0 * np.pi) / (x * x + y * y)
    across, down = 1000.0 * per_um * y, 1000.0 * per_um * x
    wave = np.cos(CYCLES * np.arctan2(y, x))
    wave *= pixel_transfer(across, pitch) * pixel_transfer(down, pitch)
    if plate:
        wave *= plate_transfer(across, pitch) * plate_transfer(down, pitch)
    return Star(wave, np.hypot(across, down))


def light_of(lens: Lens, star: Star) -> Floats:
    """(h, w) measured picture of a star from 0 to 1."""
    return 0.5 + 0.5 * lens.at(star.frequency) * star.wave


def picture(lens: Lens, star: Star, pitch: float) -> Raster:
    count = columns(pitch)
    across, down = (np.abs(centred(n)).astype(int) for n in (count, 3 * count // 4))
    quarter = opaque(encode_srgb_codes(light_of(lens, star)))
    return np.ascontiguousarray(quarter[down][:, across])


def subject(lens: Lens, pitch: float, plate: bool) -> Raster:
    """The cat through all links, on the same piece of sensor."""

    def factor(down: Floats, across: Floats) -> Floats:
        down, across = WAVES_PER_MM * down, WAVES_PER_MM * across
        left = lens.at(np.hypot(down, across))
        left *= pixel_transfer(across, pitch) * pixel_transfer(down, pitch)
        if plate:
            left *= plate_transfer(across, pitch) * plate_transfer(down, pitch)
        return left

    picture, count = blurred(factor), columns(pitch)
    for axis, pixels in ((1, 3 * count // 4), (2, count)):
        last = picture.shape[axis] - 1
        place = 0.5 * last + centred(pixels) * (pitch * WAVES_PER_MM / 1000.0)
        low = np.clip(np.floor(place).astype(int), 0, last - 1)
        share = (place - low).reshape((-1, 1) if axis == 1 else -1)
        first, second = (picture.take(low + step, axis) for step in (0, 1))
        picture = first + share * (second - first)
    return of_planes(encode_srgb_codes(picture))


STAGES = (
    Stage("lens", lens),
    Stage("spot", spot),
    Stage("close", close, ("spot",)),
    Stage("star", star),
    Stage("picture", picture, ("lens", "star")),
    Stage("subject", subject, ("lens",)),
)
