"""The MTF of a camera, measured with one picture of a slanted edge.

Rows of pixels meet a slanted edge at places that differ by parts of a pixel. Ordered by their
distance from the edge, the pixels of all rows sample the edge far more finely than one row does:
the edge spread function, ESF. Its slope is the line spread function, LSF, and the size of that
one's Fourier transform is the MTF. P. D. Burns, *Slanted-edge MTF for digital camera and scanner
analysis*, 2000; ISO 12233. Lengths are in pixels, frequencies in cycles per pixel.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.sampling.first_fall import first_fall
from simulations.models.sampling.slanted_edge_curve import EdgeCurve, fit_curve
from simulations.models.sampling.slanted_edge_line import FAINT, LEAST_STEP, UnfitEdgeError
from simulations.models.sampling.slanted_edge_pixels import EdgePixels, locate_edge

WIDEST_GAP = 0.5
"""The pixels near the edge must not leave wider gaps between their distances than this."""
UNEVEN = 0.1
"""How much of the step the light may change in the outer halves of the reach."""
SECOND_PEAK, VALLEY = 0.4, 0.25
"""A second edge has a slope of so much of the first's, and between them the slope falls to so much
of its own ..."""
CERTAIN = 5.0
"""... if it is so many standard errors."""
FALL, ABOVE = 0.006, 0.02
"""How far the light beside an edge may fall again, of its step, and how far an MTF may exceed 1 or
the limit of diffraction, in a picture that is not sharpened ..."""
SURE = 3.0
"""... and by how many standard errors more."""
LEAST_CORRELATION = 0.01
"""Size of a correlation of the noise of neighbours, beyond chance, that is due to software."""
HALOS = (4.0, 8.0, 16.0)
"""Widths of halos that are looked for."""
FREQUENCIES = np.linspace(0.0, 1.0, 51)
"""Cycles per pixel at which MTF50 is looked for, up to twice the Nyquist frequency."""

REPEATED = (
    "The rows meet the edge at too few different places: slant the edge by about 5°, or choose a "
    "longer piece."
)
UNEVEN_LIGHT = (
    "The light still changes away from the edge: choose a rectangle that holds one edge between "
    "two even areas."
)
TWO_EDGES = "There are two edges side by side: choose a rectangle that holds one."


@dataclass(frozen=True, slots=True)
class HalfContrast:
    """MTF50: the frequency at which half of the contrast is left."""

    frequency: float
    """Infinite if the curve stays above one half."""
    error: float
    """Its standard error."""


@dataclass(frozen=True, slots=True)
class EdgeReading:
    """The measurements of one picture of an edge."""

    pixels: EdgePixels
    curve: EdgeCurve

    def transfer(self, frequency: ArrayLike) -> tuple[Floats, Floats]:
        """MTF (F,) at frequencies (F,) and its standard error (F,): see `EdgeCurve.transfer`."""
        return self.curve.transfer(frequency)

    def half_contrast(self) -> HalfContrast:
        """MTF50; its error is that of the contrast there, by how steeply the contrast falls."""
        contrast, _ = self.transfer(FREQUENCIES)
        roughly = first_fall(FREQUENCIES, contrast, 0.5)
        if not np.isfinite(roughly):
            return HalfContrast(np.inf, np.inf)
        beside = roughly * np.linspace(0.8, 1.2, 17)
        contrast, error = self.transfer(beside)
        half = first_fall(beside, contrast, 0.5) if contrast[0] > 0.5 else roughly
        fall = float(contrast[0] - contrast[-1]) / float(beside[-1] - beside[0])
        uncertain = float(np.interp(half, beside, error))
        return HalfContrast(half, uncertain / fall if fall > 0 else np.inf)

    @property
    def rise(self) -> float:
        """Width over which the light rises from a tenth to nine tenths of the step."""
        place = self.pixels.reach * np.linspace(-1.0, 1.0, 1025)
        spread = self.curve.spread(place)
        return float(place[np.argmax(spread > 0.9)] - place[np.argmax(spread > 0.1)])

    @property
    def overshoot(self) -> float:
        """How far the curve leaves the range from dark to light near the edge, as a share of it."""
        spread = self.curve.spread(self.pixels.reach * np.linspace(-0.5, 0.5, 257))
        return float(np.max(np.maximum(spread - 1.0, -spread), initial=0.0))

    @property
    def noise_correlation(self) -> tuple[float, float]:
        """Correlation of the noise of neighbours in rows, beside the edge, and its standard error.

        0 for pixels read one by one, above for those that were estimated from neighbours, smoothed
        or compressed, and below for those from which a part of their neighbours was taken off.
        """
        pixels = self.pixels
        beside = np.abs(pixels.distance) > 0.25 * pixels.reach
        off = np.where(beside, pixels.value - self.curve.spread(pixels.distance), 0.0)
        near = beside[1:] & beside[:-1] & (pixels.row[1:] == pixels.row[:-1])
        variance = max(float(np.mean(off[beside] ** 2)), 1e-300)
        shared = float(np.mean((off[1:] * off[:-1])[near]))
        return shared / variance, max(float(np.count_nonzero(near)), 1.0) ** -0.5

    def is_sharpened(self, limit: Floats | float = 1.0) -> bool:
        """Whether software has sharpened the picture.

        Behind a lens, the light rises all the way across the edge, and no contrast exceeds 1 or
        ``limit`` (F,), that of diffraction, at `FREQUENCIES`. What sharpens an edge makes the noise
        of neighbours correlate negatively.
        """
        correlation, chance = self.noise_correlation
        if correlation < -LEAST_CORRELATION - SURE * chance:
            return True
        for width in HALOS:
            end = min(self.pixels.reach - 0.5 * width, 3.0 * width)
            rise, error = self.curve.rise(np.arange(-end, end + 0.1, 0.25), width)
            if np.any(rise < -FALL - SURE * error):
                return True
        contrast, error = self.transfer(FREQUENCIES)
        return bool(np.any((contrast > limit + ABOVE + SURE * error)[FREQUENCIES <= 0.5]))


def read_edge(picture: ArrayLike) -> EdgeReading:
    """Measure an edge: `measure(locate_edge(picture))`."""
    return measure(locate_edge(picture))


def measure(pixels: EdgePixels) -> EdgeReading:
    """The curve through the pixels of an edge. Raises `UnfitEdgeError` if it would be no MTF's."""
    if pixels.widest_gap > WIDEST_GAP:
        raise UnfitEdgeError(REPEATED)
    curve = fit_curve(pixels.distance, pixels.value, pixels.row, pixels.reach)
    if _has_two_edges(curve):
        raise UnfitEdgeError(TWO_EDGES)
    outer = pixels.reach * np.linspace(0.5, 1.0, 65)
    if max(np.ptp(curve.spread(outer)), np.ptp(curve.spread(-outer))) > UNEVEN:
        raise UnfitEdgeError(UNEVEN_LIGHT)
    if curve.noise * LEAST_STEP > 1.0:
        raise UnfitEdgeError(FAINT)
    return EdgeReading(pixels, curve)


def _has_two_edges(curve: EdgeCurve) -> bool:
    """Whether the rises over two pixels have two high peaks with a valley between them."""
    place = np.arange(-curve.reach + 1.0, curve.reach - 1.0, 0.25)
    rise, error = curve.rise(place, 2.0)
    first = int(np.argmax(rise))
    for side in (slice(first, None), slice(first, None, -1)):
        beside, valley = rise[side], np.minimum.accumulate(rise[side])
        fallen = beside - valley > CERTAIN * error[side]
        if np.any(fallen & (beside > SECOND_PEAK * rise[first]) & (valley < VALLEY * beside)):
            return True
    return False
