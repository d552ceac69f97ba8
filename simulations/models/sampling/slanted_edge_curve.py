"""The light across an edge as a smooth curve, and the contrast of waves that follows from it.

The curve is a cubic spline fitted by least squares to all pixels, each at its own distance from the
edge: no pixel is moved to the middle of a bin, and bins without pixels do no harm. Its knots are a
quarter of a pixel apart at the edge and, farther out, a quarter of the distance from it. There the
light changes slowly, and with fewer knots less of the noise is taken for light. Lengths are in
pixels, frequencies in cycles per pixel.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats
from simulations.models.require import require
from simulations.models.sampling.bspline import weigh
from simulations.models.sampling.slanted_edge_line import Indices

PER_PIXEL = 4
"""Knots per pixel at the edge."""
STIFFNESS = 1e-4
"""Weight of the curve's roughness, which settles it where no pixel does."""
SEGMENT = 8
"""Rows of a segment of the edge."""
STEPS = 8
"""Steps per pixel in the Fourier sum."""
BESIDE = 12.0
"""Pixels on either side of an edge whose light says where it is."""
MOST = 4.0
"""Frequencies are below this."""


@dataclass(frozen=True, slots=True)
class EdgeCurve:
    """The edge spread function, with what it leaves uncertain."""

    reach: float
    """The curve is defined to this distance on either side."""
    heights: Floats
    """(K,) of the B-splines whose sum is the curve."""
    covariances: Floats
    """(2, K, K) of the heights, from the deviations of the pixels from the curve: as if these were
    independent, and from the sums over segments of the edge. Errors are by the larger."""
    noise: float
    """Standard deviation of the pixels from the curve."""

    def spread(self, distance: ArrayLike) -> Floats:
        """ESF (...) at distances (...): of the four B-splines that reach each."""
        first, shares = _shares(np.asarray(distance, float), self.reach)
        return _sum(first, shares, self.heights)

    def spread_error(self, distance: ArrayLike) -> Floats:
        """Standard error (...) of the ESF at distances (...)."""
        return self._error(weights(distance, self.reach))

    @property
    def middle(self) -> tuple[float, float]:
        """Where a sharp edge would let the same light through, and its standard error."""
        beside = min(BESIDE, self.reach)
        steps = round(STEPS * beside)
        places = (np.arange(2 * steps) - steps + 0.5) / STEPS
        shares = weights(places, self.reach).sum(axis=0) / STEPS
        return beside - float(shares @ self.heights), float(self._error(shares))

    def slope(self, distance: ArrayLike) -> Floats:
        """LSF (...), per pixel, at distances (...)."""
        place, half = np.asarray(distance, float), 0.5 / STEPS
        return STEPS * (self.spread(place + half) - self.spread(place - half))

    def rise(self, distance: ArrayLike, width: float) -> tuple[Floats, Floats]:
        """How far the ESF rises (...) over a width around distances (...); its standard error."""
        shares = _between(np.asarray(distance, float).tobytes(), width, self.reach)
        return shares @ self.heights, self._error(shares)

    def _error(self, shares: Floats) -> Floats:
        """Standard errors (...) of sums of heights, each with its weights (..., K)."""
        squares = [np.sum(shares @ each * shares, axis=-1) for each in self.covariances]
        return np.sqrt(np.maximum(np.max(squares, axis=0), 0.0))

    def transfer(self, frequency: ArrayLike) -> tuple[Floats, Floats]:
        """MTF (F,) at frequencies (F,), and its standard error (F,).

        The Fourier transform of the curve's slope is a sum over its B-splines, so the error
        follows from their covariance.
        """
        cycles = np.asarray(frequency, float)
        require("frequency", cycles, np.all(np.abs(cycles) < MOST), f"below {MOST:g} in size")
        waves = _waves(tuple(cycles.tolist()), self.reach)
        whole = _rises(self.reach).sum(axis=0)
        step = float(whole @ self.heights)
        wave = waves @ self.heights
        size = np.abs(wave)
        phase = np.conj(wave / np.maximum(size, 1e-300))[:, None]
        contrast = size / step
        change = ((phase * waves).real - contrast[:, None] * whole) / step
        return contrast, self._error(change)


def fit_curve(distance: Floats, value: Floats, row: Indices, reach: float) -> EdgeCurve:
    """Fit pixels (N,) by their values, rows, and distances, below ``reach``, from the edge.

    One covariance takes each pixel's own deviation (H. White, 1980), so that light may be noisier
    than dark, as independent of its neighbours'. The other, for noise that neighbours share after
    demosaicing, smoothing or compression, takes only whole segments along the edge as independent
    (K.-Y. Liang and S. Zeger, 1986).
    """
    first, shares = _shares(distance, reach)
    count = 2 * _half_count(reach) + 4
    squares = _products(first, shares, np.ones_like(value), count)
    bend = np.diff(np.eye(count), 3, axis=0)
    squares += STIFFNESS * len(value) / count * bend.T @ bend
    sums = sum(
        np.bincount(first + place, shares[place] * value, count) for place in range(len(shares))
    )
    inverse = np.linalg.inv(squares)
    heights = inverse @ sums
    off = value - _sum(first, shares, heights)
    spare = max(len(value) - count, 1)
    scatter = _products(first, shares, np.square(off) * len(value) / spare, count)
    noise = float(np.sqrt(np.sum(np.square(off)) / spare))
    segment = row // SEGMENT
    segments = int(segment.max()) + 1
    pulls = np.zeros(segments * count)
    for place in range(len(shares)):
        where = segment * count + first + place
        pulls += np.bincount(where, shares[place] * off, segments * count)
    pulled = pulls.reshape(segments, count)
    shared = pulled.T @ pulled * (segments / max(segments - 1, 1) * len(value) / spare)
    return EdgeCurve(reach, heights, inverse @ np.stack([scatter, shared]) @ inverse, noise)


@lru_cache(maxsize=16)
def _waves(frequency: tuple[float, ...], reach: float) -> NDArray[np.complex128]:
    """(F, K) Fourier transform of the slope of each B-spline."""
    cycles, rises = np.array(frequency), _rises(reach)
    middles = (np.arange(len(rises)) + 0.5 * (1 - len(rises))) / STEPS
    turns = np.exp(-2j * np.pi * cycles[:, None] * middles)
    turns /= np.sinc(cycles / STEPS)[:, None]
    return np.asarray(turns.real @ rises + 1j * (turns.imag @ rises))  # faster than at once


@lru_cache(maxsize=16)
def _rises(reach: float) -> Floats:
    """(M, K) how far each B-spline rises in each step of the sum."""
    steps = round(STEPS * reach)
    return np.diff(weights(np.arange(-steps, steps + 1) / STEPS, reach), axis=0)


@lru_cache(maxsize=16)
def _between(distances: bytes, width: float, reach: float) -> Floats:
    """Weights (N, K) of the heights in the rise over a width around distances (N,) of float64."""
    place = np.frombuffer(distances)
    return weights(place + 0.5 * width, reach) - weights(place - 0.5 * width, reach)


def weights(distance: ArrayLike, reach: float) -> Floats:
    """(..., K) of the B-splines at distances (...)."""
    place = _in_knots(np.asarray(distance, float)) + _half_count(reach) + 1
    return weigh(place[..., None] - np.arange(2 * _half_count(reach) + 4))


def _in_knots(distance: Floats) -> Floats:
    """Distances counted in knots: nearly in quarter pixels at the edge."""
    return PER_PIXEL * np.arcsinh(distance)


def _half_count(reach: float) -> int:
    """Knots on either side."""
    return int(np.ceil(PER_PIXEL * np.arcsinh(reach)))


def _shares(distance: Floats, reach: float) -> tuple[Indices, Floats]:
    """The first of the four B-splines that reach each pixel (...), and the weights (4, ...)."""
    place = _in_knots(distance) + _half_count(reach)
    first = np.clip(np.floor(place).astype(np.intp), 0, 2 * _half_count(reach))
    t = place - first
    return first, np.stack([weigh(t + 1.0), weigh(t), weigh(1.0 - t), weigh(2.0 - t)])


def _sum(first: Indices, shares: Floats, heights: Floats) -> Floats:
    """Sums (...) of the heights, by `_shares`."""
    total = np.zeros(first.shape)
    for place, share in enumerate(shares):
        total += share * heights[first + place]
    return total


def _products(first: Indices, shares: Floats, scale: Floats, count: int) -> Floats:
    """(K, K) sums over all pixels of the products of their weights, times ``scale`` (N,)."""
    total = np.zeros((count, count))
    for low in range(len(shares)):
        for high in range(low, len(shares)):
            sums = np.bincount(first + low, scale * shares[low] * shares[high], count)
            place = np.arange(count - (high - low))
            total[place, place + high - low] += sums[: place.size]
            if high > low:
                total[place + high - low, place] += sums[: place.size]
    return total
