"""The patterns of the aliasing scene: a wave along each axis, filtered exactly, then sampled."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.pixel_grid import centred
from simulations.models.sampling import prefilters
from simulations.models.sampling.aliasing import alias_frequency
from simulations.models.sampling.prefilters import Prefilter, filtered_wave

PATTERNS = {"stripes": "Stripes", "zone_plate": "Zone plate"}
SHOWN = 20
"""Samples of the row that the second panel draws."""


@dataclass(frozen=True, slots=True)
class Pattern:
    """Light 0.5 + 0.5 sin(φ + π(2 f x + c x²)) along a row, x in pixels."""

    kind: str
    frequency: float
    """Cycles per pixel: of the stripes, or of the rings at the edge."""
    phase_rad: float
    width: int
    """Pixels in a row."""
    height: int
    first: float
    """x of the first pixel's centre: 0 for stripes; the zone plate has 0 in the middle."""
    start: int
    """Index of the first pixel that the second panel shows."""

    @property
    def chirp(self) -> float:
        """How fast the frequency rises along the row, cycles per pixel per pixel."""
        return 0.0 if self.kind == "stripes" else 2.0 * self.frequency / self.width

    @property
    def base(self) -> float:
        """Frequency at x = 0."""
        return self.frequency if self.kind == "stripes" else 0.0

    @property
    def alias(self) -> float:
        """What ``frequency`` folds to on the pixels, whichever way the wave then runs."""
        return abs(float(alias_frequency(self.frequency)))

    def local_frequency(self, x: ArrayLike) -> Floats:
        return self.base + self.chirp * np.asarray(x, float)

    def wave(self, kernel: Prefilter, x: ArrayLike) -> Floats:
        """Sine part in [-1, 1] of the light at places x (...) of the middle row."""
        along = filtered_wave(kernel, x, self.base, self.chirp)
        return (self._across(kernel, 0.0) * along).imag

    def picture(self, kernel: Prefilter) -> Floats:
        """Linear light (height, width) of all samples."""
        x = self.first + np.arange(self.width)
        y = centred(self.height)
        along = filtered_wave(kernel, x, self.base, self.chirp)
        return 0.5 + 0.5 * np.multiply.outer(self._across(kernel, y), along).imag

    def _across(self, kernel: Prefilter, y: ArrayLike) -> NDArray[np.complex128]:
        """The factor of the wave that depends on the row, with the phase."""
        turned = np.exp(1j * self.phase_rad)
        if self.kind == "stripes":
            return np.full(np.shape(y), turned)
        return turned * filtered_wave(kernel, y, 0.0, self.chirp)


def pattern_of(kind: str, frequency: float, phase_deg: float) -> Pattern:
    """Stripes on 64 x 48 pixels, or a zone plate on 160 x 120."""
    phase_rad = math.radians(phase_deg)
    if kind == "stripes":
        return Pattern(kind, frequency, phase_rad, 64, 48, first=0.0, start=0)
    return Pattern(kind, frequency, phase_rad, 160, 120, first=-79.5, start=160 - SHOWN)


def picture(pattern: str, frequency: float, phase: float, prefilter: str) -> NDArray[np.uint8]:
    """The sampled picture as canvas bytes."""
    light = pattern_of(pattern, frequency, phase).picture(prefilters.prefilter(prefilter))
    return to_rgba8(encode_srgb(np.clip(light, 0.0, 1.0)))


STAGES = (Stage("picture", picture),)
