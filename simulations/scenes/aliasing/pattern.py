"""The patterns of the aliasing scene: a wave along each axis, filtered exactly, then sampled."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.pixel_grid import centred
from simulations.models.sampling import prefilters
from simulations.models.sampling.aliasing import alias_frequency
from simulations.models.sampling.prefilters import Prefilter, filtered_wave
from simulations.scenes.aliasing.own import Own, own_light, sample_own

SHOWN = 20
"""Pixels of the row that the second panel draws."""


@dataclass(frozen=True, slots=True)
class Pattern:
    """Light 0.5 + 0.5 sin(φ + π(2 f x + c x²)) along a row, x in spacings of the samples."""

    kind: str
    frequency: float
    """Cycles per sample of the stripes, or of the rings at the edge."""
    phase_rad: float
    width: int
    """Samples in a row."""
    height: int
    first: float
    """x of the first sample: 0 for stripes; the zone plate has 0 in the middle."""
    start: int
    """Index of the first sample that the second panel shows."""
    rate: float
    """Samples per pixel, to convert to the pixels in the labels."""

    @property
    def chirp(self) -> float:
        """Increase of the frequency along the row, cycles per sample per sample."""
        return 0.0 if self.kind == "stripes" else 2.0 * self.frequency / self.width

    @property
    def base(self) -> float:
        """Frequency at x = 0."""
        return self.frequency if self.kind == "stripes" else 0.0

    @property
    def alias(self) -> float:
        """The alias of ``frequency`` on the samples, without its sign."""
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


def pattern_of(kind: str, frequency: float, phase_deg: float, rate: float = 1.0) -> Pattern:
    """Stripes on 64 × 48 pixels, or a zone plate on 160 × 120, at ``rate`` samples a pixel.

    ``frequency`` is in cycles per pixel.
    """
    # Rounded, so that frequencies exactly on a fold are on the same side of it at every rate.
    per_sample, phase_rad = round(frequency / rate, 9), math.radians(phase_deg)
    width, height = (64, 48) if kind == "stripes" else (160, 120)
    columns, rows = round(width * rate), round(height * rate)
    if kind == "stripes":
        return Pattern(kind, per_sample, phase_rad, columns, rows, 0.0, 0, rate)
    middle, start = 0.5 * (columns - 1), columns - samples_shown(rate)
    return Pattern(kind, per_sample, phase_rad, columns, rows, -middle, start, rate)


def samples_shown(rate: float) -> int:
    """Count of samples in the second panel."""
    return math.floor((SHOWN - 1) * rate + 1e-9) + 1


def picture(
    own: Own | None, pattern: str, frequency: float, phase: float, prefilter: str, rate: float
) -> Raster:
    """The sampled picture, as canvas bytes."""
    if own:
        return own.raster
    shown = pattern_of(pattern, frequency, phase, rate).picture(prefilters.prefilter(prefilter))
    return to_rgba8(encode_srgb(np.clip(shown, 0.0, 1.0)))


STAGES = (
    Stage("own light", own_light),
    Stage("own picture", sample_own, ("own light",)),
    Stage("picture", picture, ("own picture",)),
)
