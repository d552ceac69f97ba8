"""Light on a grid of samples: a pattern, filtered exactly, or the reader's own picture."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.engine.frame import Raster
from simulations.engine.photograph import Photograph
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats, Mask, centred
from simulations.models.color.cie import luminance
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.sampling import prefilters
from simulations.models.sampling.aliasing import alias_frequency
from simulations.models.sampling.prefilters import Prefilter, filtered_wave

NYQUIST = 0.5  # cycles per sample
GUARD = 0.1  # parts of the zone plate this close to Nyquist are left out of the error
SIZE_PX = (160, 120)  # of the book's patterns
FRAMED_AT = 82  # first pixel of the stripes that the second panel shows
SHOWN = 20  # pixels of the row that is drawn as curves
PHOTOGRAPH_PX = (320, 240)
FINE = 5  # points of the reader's picture per pixel of the figure, along each axis
FIRST, POINTS = 22, 12  # the first pixel of its row that is drawn, and points of a curve per pixel
SPECTRUM_TO = 1.2  # cycles per pixel


@dataclass(frozen=True, slots=True, kw_only=True)
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
    """x of the first sample: stripes have 0 at the frame, the zone plate in the middle."""
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
        along = filtered_wave(kernel, x, self.base, self.chirp)
        across = self._across(kernel, centred(self.height))
        return 0.5 + 0.5 * np.multiply.outer(across, along).imag

    def _across(self, kernel: Prefilter, y: ArrayLike) -> NDArray[np.complex128]:
        """The factor of the wave that depends on the row, with the phase."""
        turned = np.exp(1j * self.phase_rad)
        if self.kind == "stripes":
            return np.full(np.shape(y), turned)
        return turned * filtered_wave(kernel, y, 0.0, self.chirp)


def pattern_of(kind: str, frequency: float, phase_deg: float, rate: float = 1.0) -> Pattern:
    """Stripes or a zone plate on 160 × 120 pixels, at ``rate`` samples a pixel.

    ``frequency`` is in cycles per pixel.
    """
    # Rounded, so that frequencies exactly on a fold are on the same side of it at every rate.
    per_sample, phase_rad = round(frequency / rate, 9), math.radians(phase_deg)
    columns, rows = (round(length * rate) for length in SIZE_PX)
    if kind == "stripes":
        start = round(FRAMED_AT * rate)
        return Pattern(
            kind=kind,
            frequency=per_sample,
            phase_rad=phase_rad,
            width=columns,
            height=rows,
            first=-start,
            start=start,
            rate=rate,
        )
    middle, start = 0.5 * (columns - 1), columns - sample_count(rate)
    return Pattern(
        kind=kind,
        frequency=per_sample,
        phase_rad=phase_rad,
        width=columns,
        height=rows,
        first=-middle,
        start=start,
        rate=rate,
    )


def sample_count(rate: float) -> int:
    """Count of samples in the second panel."""
    return math.floor((SHOWN - 1) * rate + 1e-9) + 1


def ideal(pattern: Pattern) -> tuple[Floats, Mask]:
    """The ideal picture (height, width) of a pattern, and where it is certain.

    Waves below Nyquist along both axes are unfiltered; all others are even grey. The pattern is
    computed again here, from its definition.
    """
    x = pattern.first + np.arange(pattern.width)
    y = centred(pattern.height)[:, None]
    f = pattern.frequency
    if pattern.kind == "stripes":
        wave = np.sin(pattern.phase_rad + 2 * np.pi * f * (x + 0 * y))
        resolved = np.full(wave.shape, f < NYQUIST)
        return np.where(resolved, 0.5 + 0.5 * wave, 0.5), np.ones(wave.shape, bool)
    highest = 2 * f / pattern.width * np.maximum(np.abs(x), np.abs(y))
    wave = np.sin(pattern.phase_rad + 2 * np.pi * f / pattern.width * (x * x + y * y))
    light: Floats = np.where(highest < NYQUIST, 0.5 + 0.5 * wave, 0.5)
    return light, np.abs(highest - NYQUIST) > GUARD


@dataclass(frozen=True, slots=True)
class PhotographLight:
    """A reader's picture before sampling: the same at every setting."""

    linear: Floats
    """(H, W, 3) light."""
    grey: Floats
    """(H, W) luminance."""
    detail: Floats
    """(m,) the spectrum: see `SampledPhotograph`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SampledPhotograph:
    """A reader's picture, sampled, as the figure shows it."""

    raster: Raster
    linear: Floats
    """(h, w, 3) light of the samples."""
    row: int
    """Row of the samples that is drawn as curves."""
    places: Floats
    """Places of its samples in the second panel, in pixels from the panel's left."""
    samples: Floats
    curve: Floats
    """(n,) luminance of the pixels drawn, before the filter ..."""
    filtered: Floats
    """... and after it."""
    detail: Floats
    """(m,) amplitude times frequency, relative to the largest, at frequencies from 0 to
    `SPECTRUM_TO`."""


def photograph_light(photograph: Photograph | None) -> PhotographLight | None:
    """None if the book's pattern is shown."""
    if photograph is None:
        return None
    linear = light_of(photograph)
    grey = luminance(linear)
    width = grey.shape[1]
    # Ends that do not match would look like detail, so they are faded out.
    faded = (grey - grey.mean(axis=1, keepdims=True)) * np.hanning(width)
    count = math.floor(SPECTRUM_TO * width / FINE) + 1
    spectrum = np.sqrt(np.mean(np.abs(np.fft.rfft(faded, axis=1)[:, :count]) ** 2, axis=0))
    detail = spectrum * np.arange(count)  # the detail per octave
    return PhotographLight(linear, grey, detail / max(float(detail.max()), 1e-9))


def sample_photograph(
    photograph: PhotographLight | None, prefilter: str, rate: float
) -> SampledPhotograph | None:
    """Filter the picture and sample it; None if the book's pattern is shown."""
    if photograph is None:
        return None
    light, grey = photograph.linear, photograph.grey
    height, width = grey.shape
    kernel, point = prefilters.prefilter(prefilter), prefilters.prefilter("none")
    across, up = (grid_places(length, rate) for length in (width, height))
    along_y = weights(up, kernel, rate, height)
    linear = along_both(light, along_y, weights(across, kernel, rate, width))
    row = (len(along_y) - 1) // 2
    # Points of the curves, as if they were samples of the same row.
    fine = (FIRST + np.linspace(0, SHOWN - 1, POINTS * (SHOWN - 1) + 1) + 0.5) * FINE - 0.5
    before = weights(up[[row]], point, rate, height) @ grey
    behind = along_y[[row]] @ grey
    columns = (across + 0.5) / FINE - 0.5 - FIRST
    inside = (columns >= 0) & (columns <= SHOWN - 1)
    return SampledPhotograph(
        raster=to_rgba8(encode_srgb(np.clip(linear, 0.0, 1.0))),
        linear=linear,
        row=row,
        places=columns[inside],
        samples=luminance(linear[row, inside]),
        curve=(before @ weights(fine, point, rate, width).T)[0],
        filtered=(behind @ weights(fine, kernel, rate, width).T)[0],
        detail=photograph.detail,
    )


def light_of(photograph: Photograph) -> Floats:
    """(H, W, 3) linear."""
    return decode_srgb(np.float32(1 / 255) * photograph.codes)


def grid_places(length: int, rate: float) -> Floats:
    """(n,) places of the samples along an axis of ``length`` points, in points."""
    count = round(length / FINE * rate)
    return (np.arange(count) + 0.5) / rate * FINE - 0.5


def weights(places: Floats, kernel: Prefilter, rate: float, length: int) -> Floats:
    """(n, length) weight of each point of an axis in the measurement at each place.

    The light is linear between two points and constant beyond the border.
    """
    at = places[:, None] + kernel.offsets_px * (FINE / rate)
    at = np.clip(at, 0.0, length - 1.0)
    low = np.minimum(np.floor(at).astype(np.intp), length - 2)
    upper = (at - low) * kernel.weights
    first = np.arange(len(places))[:, None] * length + low
    size = len(places) * length
    shares = np.bincount(first.ravel(), (kernel.weights - upper).ravel(), size)
    shares += np.bincount(first.ravel() + 1, upper.ravel(), size)
    return shares.reshape(len(places), length).astype(np.float32)


def ideal_weights(length: int, rate: float) -> Floats:
    """Weights of the ideal low-pass: all cosines below Nyquist, and none above.

    The axis is mirrored at its ends, as in the cosine transform.
    """
    places, points = grid_places(length, rate), np.arange(length)
    orders = np.arange(math.ceil(rate * length / FINE))  # k / 2 cycles over the whole axis
    scale = np.where(orders == 0, 1.0, 2.0) / length
    sampled = np.cos(np.pi / length * np.multiply.outer(places + 0.5, orders))
    taken = np.cos(np.pi / length * np.multiply.outer(orders, points + 0.5))
    return (sampled * scale) @ taken


def along_both(light: Floats, along_y: Floats, along_x: Floats) -> Floats:
    """(h, w, 3) of a picture (H, W, 3) by the weights (h, H) and (w, W)."""
    height, width, colours = light.shape
    rows = (along_y @ light.reshape(height, -1)).reshape(-1, width, colours)
    columns = rows.swapaxes(0, 1).reshape(width, -1)
    return (along_x @ columns).reshape(len(along_x), -1, colours).swapaxes(0, 1)


def ideal_photograph(photograph: Photograph, rate: float) -> Floats:
    """(h, w, 3) light of the picture after the ideal low-pass."""
    light = light_of(photograph)
    return along_both(light, *(ideal_weights(length, rate) for length in light.shape[:2]))
