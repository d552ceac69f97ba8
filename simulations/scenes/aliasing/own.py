"""The reader's own picture on the grid: filtered, sampled, one row of it, and its frequencies."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import Raster
from simulations.engine.photograph import Photograph
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.color.cie import luminance
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.sampling.prefilters import Prefilter, prefilter

PHOTOGRAPH_PX = (320, 240)
FINE = 5
"""Points of the picture per pixel of the figure, along each axis."""
SHOWN, FIRST, POINTS = 20, 22, 12
"""Pixels of the row that are drawn, the first of them, and points of a curve per pixel."""
SPECTRUM_TO = 1.2
"""Cycles per pixel."""


@dataclass(frozen=True, slots=True)
class OwnLight:
    """A reader's picture before sampling: the same at every setting."""

    linear: Floats
    """(H, W, 3) light."""
    grey: Floats
    """(H, W) luminance."""
    detail: Floats
    """As in `Own`."""


@dataclass(frozen=True, slots=True)
class Own:
    """The data that the figure shows of a reader's picture."""

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


def own_light(photograph: Photograph | None) -> OwnLight | None:
    """None if the book's pattern is shown."""
    if photograph is None:
        return None
    linear = light_of(photograph)
    grey = luminance(linear)
    return OwnLight(linear, grey, _detail(grey))


def sample_own(own: OwnLight | None, prefilter: str, rate: float) -> Own | None:
    """Filter the picture and sample it; None if the book's pattern is shown."""
    return _sampled(own, prefilter, rate) if own else None


def _sampled(own: OwnLight, kind: str, rate: float) -> Own:
    light, grey, kernel = own.linear, own.grey, prefilter(kind)
    height, width = light.shape[:2]
    across = grid_places(width, rate)
    along_x = weights(across, kernel, rate, width)
    along_y = weights(grid_places(height, rate), kernel, rate, height)
    linear = along_both(light, along_y, along_x)
    row = (len(along_y) - 1) // 2
    # Points of the curves, as if they were samples of the same row.
    fine = (FIRST + np.linspace(0, SHOWN - 1, POINTS * (SHOWN - 1) + 1) + 0.5) * FINE - 0.5
    before = weights(grid_places(height, rate)[[row]], prefilter("none"), rate, height) @ grey
    behind = along_y[[row]] @ grey
    columns = (across + 0.5) / FINE - 0.5 - FIRST
    inside = (columns >= 0) & (columns <= SHOWN - 1)
    return Own(
        to_rgba8(encode_srgb(np.clip(linear, 0.0, 1.0))),
        linear,
        row,
        columns[inside],
        luminance(linear[row, inside]),
        (before @ weights(fine, prefilter("none"), rate, width).T)[0],
        (behind @ weights(fine, kernel, rate, width).T)[0],
        own.detail,
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
    # Cosine k has k / 2 cycles over the whole axis.
    highest = math.ceil(rate * length / FINE)
    orders = np.arange(highest)
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


def ideal_own(photograph: Photograph, rate: float) -> Floats:
    """(h, w, 3) light of the picture after the ideal low-pass."""
    light = light_of(photograph)
    along_y, along_x = (ideal_weights(length, rate) for length in light.shape[:2])
    return along_both(light, along_y, along_x)


def _detail(grey: Floats) -> Floats:
    """Amplitude times frequency, the detail per octave, as the mean of all rows."""
    width = grey.shape[1]
    # Ends that do not match would look like detail, so they are faded out.
    faded = (grey - grey.mean(axis=1, keepdims=True)) * np.hanning(width)
    count = math.floor(SPECTRUM_TO * width / FINE) + 1
    spectrum = np.sqrt(np.mean(np.abs(np.fft.rfft(faded, axis=1)[:, :count]) ** 2, axis=0))
    detail = spectrum * np.arange(count)
    return detail / max(float(detail.max()), 1e-9)
