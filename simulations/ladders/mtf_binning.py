"""MTF50 from the pixels of a slanted edge: means over bins, and the curve of the book.

The binned tiers follow ISO 12233: means over bins, differences of the means, a Hamming window, the
Fourier sum, and a correction for the waves that means and differences take away.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np
from numpy.typing import NDArray

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.sampling.first_fall import first_fall
from simulations.models.sampling.slanted_edge import measure
from simulations.models.sampling.slanted_edge_picture import edge_picture, edge_transfer
from simulations.models.sampling.slanted_edge_pixels import EdgePixels, locate_edge

ANGLES_DEG = (3.0, 5.0, 9.0, 14.0, 18.4, 26.6)
"""Slants; the tangents of the last three are nearly 1/4, 1/3 and 1/2."""
SPOTS_PX = (0.5, 1.0)
"""Standard deviations of the blur."""
HEIGHT, WIDTH = 100, 96
NOISE = 1 / 30
FREQUENCIES = np.linspace(0.0, 1.0, 201)
REACH = 20.0
"""Pixels on either side of the edge that the bins cover."""


@dataclass(frozen=True, slots=True)
class Edge:
    """A slanted edge behind a lens."""

    slant_deg: float
    spot_px: float
    """Standard deviation of the blur."""

    @property
    def slant_rad(self) -> float:
        return math.radians(self.slant_deg)

    def lens(self, frequency: Floats) -> Floats:
        """Contrast left by the blur, at frequencies in cycles per pixel."""
        factor: Floats = np.exp(-2.0 * (np.pi * self.spot_px * frequency) ** 2)
        return factor


@dataclass(frozen=True, slots=True)
class Workload:
    """The located pixels of each picture, without noise and with it."""

    edges: tuple[Edge, ...]
    clean: tuple[EdgePixels, ...]
    noisy: tuple[EdgePixels, ...]


@dataclass(frozen=True, slots=True)
class Halves:
    """MTF50 (N,) of each picture, in cycles per pixel."""

    clean: Floats
    noisy: Floats


def prepare(angles_deg: Sequence[float] = ANGLES_DEG) -> Workload:
    """The ladder's workload; tests use other slants too."""
    return _workload([Edge(angle, spot) for angle in angles_deg for spot in SPOTS_PX], 5)


def draw(index: int) -> Workload:
    """Two slants from 2° to 43°, with blurs from 0.4 to 1.2 pixels, and other noise."""
    rng = np.random.default_rng(index)
    slants, spots = rng.uniform(2.0, 43.0, 2), rng.uniform(0.4, 1.2, 2)
    return _workload([Edge(*map(float, pair)) for pair in zip(slants, spots, strict=True)], index)


def _workload(edges: Sequence[Edge], seed: int) -> Workload:
    rng = np.random.default_rng(seed)
    pictures = [edge_picture(HEIGHT, WIDTH, edge.slant_rad, edge.lens) for edge in edges]
    noisy = [picture + rng.normal(0.0, NOISE, picture.shape) for picture in pictures]
    located = (tuple(map(locate_edge, each)) for each in (pictures, noisy))
    return Workload(tuple(edges), *located)


def reference(workload: Workload) -> Halves:
    """Of the product of spot and pixel, on a grid fine enough."""
    frequency = np.linspace(0.0, 1.0, 100_001)
    halves = np.array(
        [
            first_fall(
                frequency, edge.lens(frequency) * edge_transfer(frequency, edge.slant_rad), 0.5
            )
            for edge in workload.edges
        ]
    )
    return Halves(halves, halves)


def _mean_halves(workload: Workload, *, half: Callable[[EdgePixels], float]) -> Halves:
    clean, noisy = (np.array([half(p) for p in each]) for each in (workload.clean, workload.noisy))
    return Halves(clean, noisy)


def _by_curve(pixels: EdgePixels) -> float:
    return measure(pixels).half_contrast().frequency


def _by_bins(pixels: EdgePixels, *, bins: int, corrected: bool, at_means: bool) -> float:
    """By ``bins`` per pixel, placed at their middles or at the mean distance of their pixels."""
    near = np.abs(pixels.distance) < REACH
    distance, value = pixels.distance[near], pixels.value[near]
    middles: Floats = _middles(bins)
    index = np.floor((distance + REACH) * bins).astype(np.intp)
    filled = np.bincount(index, minlength=middles.size)
    used = np.flatnonzero(filled)
    spread: Floats = np.bincount(index, value, middles.size)[used] / filled[used]
    if at_means:
        place = np.bincount(index, distance, middles.size)[used] / filled[used]
        between: Floats = 0.5 * (place[1:] + place[:-1])
        width = np.diff(place)
        waves = _waves(between) * np.sinc(FREQUENCIES[:, None] * width)
    else:  # an empty bin has the mean of its neighbours
        spread = np.interp(middles, middles[used], spread)
        between, waves = middles[:-1] + 0.5 / bins, _even_waves(bins)
    rise = np.diff(spread) * (0.54 + 0.46 * np.cos(np.pi * between / REACH))
    contrast = np.abs(waves @ rise) / np.sum(rise)
    if corrected:  # for the means and, where steps are even, for the differences
        contrast /= np.sinc(FREQUENCIES / bins) ** (1 if at_means else 2)
    return first_fall(FREQUENCIES, contrast, 0.5)


def _middles(bins: int) -> Floats:
    return (np.arange(round(2 * REACH * bins)) + 0.5) / bins - REACH


def _waves(place: Floats) -> NDArray[np.complex128]:
    return np.exp(-2j * np.pi * FREQUENCIES[:, None] * place)


@lru_cache
def _even_waves(bins: int) -> NDArray[np.complex128]:
    return _waves(_middles(bins)[:-1] + 0.5 / bins)


def _off_percent(found: Floats, true: Floats) -> float:
    """Root mean square of the relative errors."""
    return float(100.0 * np.sqrt(np.mean(np.square(found / true - 1.0))))


def clean_error(result: Halves, truth: Halves, _workload: Workload) -> float:
    return _off_percent(result.clean, truth.clean)


def noisy_error(result: Halves, truth: Halves, _workload: Workload) -> float:
    return _off_percent(result.noisy, truth.noisy)


def _bins(
    id: str, label: str, bins: int, *, corrected: bool = True, at_means: bool = False
) -> Tier:
    half = partial(_by_bins, bins=bins, corrected=corrected, at_means=at_means)
    return Tier(id, label, f"{round(2 * REACH * bins)} bins", partial(_mean_halves, half=half))


LADDER = Ladder(
    id="mtf-binning",
    title="MTF from an edge",
    workload="24 pictures of 100 × 96 pixels: six slants, two blurs, without noise and with it",
    prepare=prepare,
    tiers=(
        _bins("bins-1", "Bins of a pixel", 1),
        _bins("bins-4-raw", "Bins of ¼ px, uncorrected", 4, corrected=False),
        _bins("bins-4", "Bins of ¼ px", 4),
        _bins("means-4", "Bins of ¼ px, at their mean distances", 4, at_means=True),
        _bins("bins-8", "Bins of ⅛ px", 8),
        Tier("spline", "Spline", "44 unknowns", partial(_mean_halves, half=_by_curve)),
    ),
    reference=reference,
    reference_label="the product of the formulae of blur and pixel",
    metrics=(
        Metric("clean", "Error of MTF50 without noise", "%", clean_error),
        Metric("noisy", "Error of MTF50 at an SNR of 30", "%", noisy_error),
    ),
    default_tier="spline",
    draw=draw,
    items=230_400,
)
