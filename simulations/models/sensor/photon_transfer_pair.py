"""Two frames of the same even light: what differs between them is noise, what they share is not.

European Machine Vision Association, *Standard 1288: characterization of image sensors and cameras*,
release 4.0, sections 6.5 (temporal noise from two frames) and 8 (nonuniformities). The light may
fall off smoothly over the frame: a polynomial of second degree is taken off each.
"""

import math
from dataclasses import KW_ONLY, dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats, centred
from simulations.models.sensor.photon_transfer import LEAST_VARIANCE_DN2

TREND_TERMS = 6
"""Terms of a polynomial of second degree in x and y."""
BESIDE = ((0, 1), (1, 0))
LAGS = (*BESIDE, (1, 1), (1, -1), *((2, aside) for aside in range(-2, 3)), (0, 2), (1, 2), (1, -2))
"""From a cell to half of the 24 around it; the others are opposite to these."""
PILED = 0.05
"""Share of the pixels at the last code that occurs, from which on codes are clipped there: of noise
that is not lost in rounding, a thousandth have it."""
FEWEST_PIXELS = 64
"""Least pixels of a frame; fewer give a variance to a fifth of it at best."""


@dataclass(frozen=True, slots=True)
class Level:
    """What a pair of frames at one exposure says, in DN: steps of light, where the response of the
    file is known, and otherwise codes."""

    mean_dn: float
    noise_dn2: float
    """Variance of one frame in time, without that of rounding."""
    noise_error_dn2: float
    _: KW_ONLY
    pattern_dn2: float
    """Variance from cell to cell that both frames share. Below 0 if noise hides it."""
    pattern_error_dn2: float
    """One standard error, for these cells."""
    noise_in_codes: float
    """Variance in time, with that of rounding, in squared steps of the codes that occur."""
    correlation: float
    """Correlation of the noise of neighbouring pixels beside that of whole rows and columns: 0 for
    cells read one by one."""
    clipped: float
    """Share of the pixels at an end of the scale, or at the last code that occurs, if many are."""
    pixels: int
    neighbours: float = 0.0
    """Sum of the correlations with all eight neighbours, likewise."""
    farther: float = 0.0
    """The same of the sixteen cells around these."""
    row_dn2: float = 0.0
    """Part of the variance of noise that all pixels of a row share. Below 0 if there is none."""
    row_error_dn2: float = 0.0
    lowest: float = 0.0
    """Share of the pixels at the lowest code that occurs."""
    step: float = 1.0
    """Codes from one that occurs to the next: above 1 where a file leaves out codes."""


def measure_pair(
    frames: NDArray[np.unsignedinteger], highest: int, response: Floats | None = None
) -> Level:
    """The level of two frames (2, H, W) of codes from 0 to ``highest``.

    ``response`` (highest + 1,) is the light of each code, in DN; without it, the codes are
    proportional to the light. Raises `ValueError` for other shapes, and for frames of fewer than 64
    pixels.
    """
    if frames.ndim != 3 or len(frames) != 2 or frames[0].size < FEWEST_PIXELS:
        raise ValueError(f"frames {frames.shape}; legal: (2, H, W), of 64 pixels or more")
    first, second = frames
    linear = frames.astype(float) if response is None else np.asarray(response, float)[frames]
    rest_a, rest_b = _without_trend(linear)
    free = first.size - TREND_TERMS
    difference = rest_a - rest_b
    noise = float(np.sum(difference**2)) / (2 * free)
    pattern = float(np.sum(rest_a * rest_b)) / free
    step = _step(frames)
    per_code = 1.0 if response is None else float(np.mean(np.gradient(response)[frames] ** 2))
    rounding = step**2 * per_code / 12
    apart = first.astype(float) - second
    noise_in_codes = float(apart.var(ddof=1)) / (2 * step**2)
    rows, columns = (_shared(difference, 2 * noise, axis) for axis in (1, 0))
    shares = _correlations(difference, 2 * noise)
    bands = [max(each, 0.0) / 2 for each in (rows, columns)]
    few = [band * math.sqrt(2 / side) for band, side in zip(bands, first.shape, strict=True)]
    return Level(
        mean_dn=float(linear.mean()),
        noise_dn2=noise - rounding,
        noise_error_dn2=math.hypot(noise * math.sqrt(2 / free), *few),
        pattern_dn2=pattern,
        pattern_error_dn2=math.hypot(
            math.sqrt(noise * (noise + 2 * max(pattern, 0.0)) / free), *few
        ),
        noise_in_codes=noise_in_codes,
        correlation=sum(shares[lag] for lag in BESIDE) / len(BESIDE),
        neighbours=2 * sum(shares[lag] for lag in (*BESIDE, (1, 1), (1, -1))),
        farther=2 * sum(share for lag, share in shares.items() if 2 in map(abs, lag)),
        clipped=_clipped(frames, highest, noise_in_codes >= LEAST_VARIANCE_DN2),
        pixels=first.size,
        row_dn2=rows / 2,
        row_error_dn2=(noise / first.shape[1] + bands[0]) * math.sqrt(2 / first.shape[0]),
        lowest=np.count_nonzero(frames == frames.min()) / frames.size,
        step=step,
    )


def _clipped(frames: NDArray[np.unsignedinteger], highest: int, noisy: bool) -> float:
    """Share of the pixels at an end of the scale, or where others of the noise are missing."""
    shares = {
        end: np.count_nonzero(frames == end) / frames.size
        for end in {int(frames.min()), int(frames.max())}
    }
    return sum(s for end, s in shares.items() if end in (0, highest) or (noisy and s > PILED))


def _step(frames: NDArray[np.unsignedinteger]) -> float:
    """Mean step between the codes of the middle two thirds of the pixels; if these have one code,
    the smallest between any."""
    counts = np.bincount(frames.ravel())
    places = np.searchsorted(np.cumsum(counts), (frames.size // 6, 5 * frames.size // 6))
    used = np.flatnonzero(counts[places[0] : places[1] + 1])
    if len(used) > 1:
        return float(np.ptp(used)) / (len(used) - 1)
    return float(min(np.diff(np.flatnonzero(counts)), default=1))


def _shared(difference: Floats, variance: float, axis: int) -> float:
    """Variance of the means along an axis, less what single pixels leave in them."""
    count = difference.shape[1 - axis]
    means = difference.mean(axis=axis)
    return float(np.sum(means**2)) / max(count - 3, 1) - variance / difference.shape[axis]


def _without_trend(frames: Floats) -> Floats:
    """Frames (2, H, W), each without the polynomial of second degree nearest to it."""
    terms = _terms(*frames.shape[1:])
    values = frames.reshape(2, -1)
    # Frames of one row or column have fewer terms.
    shares = np.linalg.lstsq(terms @ terms.T, terms @ values.T, rcond=1e-12)[0]
    rest: Floats = (values - shares.T @ terms).reshape(frames.shape)
    return rest


@lru_cache(4)
def _terms(height: int, width: int) -> Floats:
    """(6, H · W) the terms of the polynomial."""
    y, x = np.meshgrid(centred(height) / height, centred(width) / width, indexing="ij")
    return np.stack([np.ones_like(x), x, y, x * x, x * y, y * y]).reshape(TREND_TERMS, -1)


def _correlations(difference: Floats, variance: float) -> dict[tuple[int, int], float]:
    """Correlations of cells (down, across) apart, of `LAGS`; 0 for frames that do not differ.

    The means of rows and columns, which are taken off, hold a part of each cell's own noise.
    """
    found, (height, width) = {}, difference.shape
    framed = np.zeros((height, width + 2))  # cells beyond the end of a row are 0
    framed[:, :width] = difference - difference.mean(axis=1, keepdims=True)
    framed[:, :width] -= difference.mean(axis=0)
    single = framed.ravel()
    own = float(single @ single) / difference.size
    for down, across in LAGS:
        away = down * (width + 2) + across
        count = max(height - down, 0) * max(width - abs(across), 0)
        product = float(single[away:] @ single[: single.size - away]) / count if count else 0.0
        product += own * ((down == 0) / width + (across == 0) / height)
        found[down, across] = product / (variance or 1.0)
    return found
