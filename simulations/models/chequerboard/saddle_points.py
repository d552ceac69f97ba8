"""Saddle points of brightness: places where four squares of a chequerboard may meet.

Along one diagonal of a corner the brightness has a maximum and along the other a minimum, so that
the determinant of its second derivatives is negative, and most so at the corner. D. Chen and G.
Zhang, *A new sub-pixel detector for x-corners in camera calibration targets*, 2005. A candidate is
kept if a circle about it meets four alternating arcs, dark and light, each like the one opposite:
S. Bennett and J. Lasenby, *ChESS: quick and robust detection of chess-board features*, 2014.
"""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats, Mask, Planes

WEAKEST = 1.5
"""Least curvature of a saddle, in codes per square pixel: a few times that of noise."""
FAINTEST = 0.06
"""Least curvature as a share of the strongest."""
MOST = 2500
"""The strongest candidates that are kept, so that a busy picture costs no more than a quarter of
a second."""
RADIUS, SAMPLES = 3.0, 32
"""Circle about a candidate, px, and the samples on it."""
ODD_RAD = 0.5
"""Largest angle by which two opposite edges may fail to lie on one line."""


@dataclass(frozen=True, slots=True)
class Saddles:
    """Candidates, the strongest first."""

    places: Floats
    """(N, 2) px; the centre of the top-left pixel is (0, 0)."""
    rays_rad: Floats
    """(N, 4) directions of the four edges, from x to y; it is light between the first and the
    second, dark between the second and the third, and so on."""
    contrast: Floats
    """(N,) difference of the light and the dark arcs, codes."""


def smoothed(grey: Planes) -> Planes:
    """A picture (H, W) under the kernel 1 4 6 4 1, whose standard deviation is 1 px."""
    for axis in (0, 1):
        padded = np.pad(grey, [(2, 2) if axis == along else (0, 0) for along in (0, 1)], "edge")
        parts = [_part(padded, axis, shift, grey.shape[axis]) for shift in range(5)]
        total = parts[0] + parts[4]
        total += np.float32(4) * (parts[1] + parts[3])
        total += np.float32(6) * parts[2]
        total *= np.float32(1 / 16)
        grey = total
    return grey


def _part(padded: Planes, axis: int, start: int, length: int) -> Planes:
    part = slice(start, start + length)
    return padded[part] if axis == 0 else padded[:, part]


def find_saddles(smooth: Planes) -> Saddles:
    """The saddle points of a smoothed picture (H, W) that look like corners."""
    peaks = _peaks(smooth)
    return _with_four_arcs(smooth, peaks)


def _peaks(smooth: Planes) -> Floats:
    """(N, 2) local maxima of the saddle's curvature, the strongest first, to parts of a pixel."""
    if min(smooth.shape) < 2 * RADIUS + 3:
        return np.zeros((0, 2))
    inside = smooth[1:-1, 1:-1]
    twice = np.float32(2) * inside
    xx = smooth[1:-1, 2:] + smooth[1:-1, :-2]
    xx -= twice
    yy = smooth[2:, 1:-1] + smooth[:-2, 1:-1]
    yy -= twice
    xy = smooth[2:, 2:] - smooth[2:, :-2]
    xy -= smooth[:-2, 2:]
    xy += smooth[:-2, :-2]
    xy *= np.float32(0.25)
    saddle = xy * xy
    saddle -= xx * yy
    height, width = saddle.shape
    flat = saddle.ravel()
    least = max(WEAKEST**2, FAINTEST**2 * float(flat.max()))
    at = np.flatnonzero(flat > least)
    row, column = np.divmod(at, width)
    margin = int(RADIUS) + 1
    fits = (
        (row >= margin) & (row < height - margin) & (column >= margin) & (column < width - margin)
    )
    at = at[fits]
    for down in (-2, -1, 0, 1, 2):
        for right in (-2, -1, 0, 1, 2):
            if down or right:
                before = (down, right) < (0, 0)
                other = flat[at + down * width + right]
                at = at[flat[at] > other] if before else at[flat[at] >= other]
    at = at[np.argsort(-flat[at], kind="stable")[:MOST]]
    row, column = np.divmod(at, width)
    slope_x = 0.5 * (smooth[row + 1, column + 2] - smooth[row + 1, column])
    slope_y = 0.5 * (smooth[row + 2, column + 1] - smooth[row, column + 1])
    a, b, c = xx.ravel()[at], xy.ravel()[at], yy.ravel()[at]
    step = np.stack([c * slope_x - b * slope_y, a * slope_y - b * slope_x], axis=-1)
    step = np.clip(step / flat[at][:, None], -1.0, 1.0)
    return np.stack([column + 1.0, row + 1.0], axis=-1) + step


def sample(picture: Planes, places: Floats) -> Floats:
    """A picture (H, W) at places (..., 2), bilinear; clamped at the border, NaN at places NaN."""
    height, width = picture.shape
    x = np.clip(places[..., 0], 0.0, width - 1.001)
    y = np.clip(places[..., 1], 0.0, height - 1.001)
    column, row = (np.nan_to_num(along).astype(np.int64) for along in (x, y))
    right, down = x - column, y - row
    flat, at = picture.ravel(), row * width + column
    above = flat[at] + right * (flat[at + 1] - flat[at])
    below = flat[at + width] + right * (flat[at + width + 1] - flat[at + width])
    return above + down * (below - above)


def _with_four_arcs(smooth: Planes, peaks: Floats) -> Saddles:
    """The candidates whose circle is cut by four edges, two and two on one line."""
    angles = np.arange(SAMPLES) * (2 * np.pi / SAMPLES)
    circle = RADIUS * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    ring = sample(smooth, peaks[:, None] + circle)
    level = ring - sample(smooth, peaks)[:, None]
    light = level > 0.0
    cuts = light != np.roll(light, -1, axis=1)
    four = cuts.sum(axis=1) == 4
    peaks, level, light, cuts = peaks[four], level[four], light[four], cuts[four]
    rays = _rays(level, light, cuts)
    contrast = _contrast(level, light)
    straight = _opposite(rays[:, 0], rays[:, 2]) & _opposite(rays[:, 1], rays[:, 3])
    half = SAMPLES // 2
    unlike = np.abs(level - np.roll(level, half, axis=1)).mean(axis=1)
    selected = straight & (unlike < 0.5 * contrast)
    return Saddles(peaks[selected], rays[selected], contrast[selected])


def _rays(level: Floats, light: Mask, cuts: Mask) -> Floats:
    """(N, 4) directions where the ring changes between dark and light, dark to light first."""
    before = np.nonzero(cuts)[1].reshape(-1, 4)
    row = np.arange(len(level))[:, None]
    low, high = level[row, before], level[row, (before + 1) % SAMPLES]
    rays = (before + low / (low - high)) * (2 * np.pi / SAMPLES)
    turned = light[row, before][:, :1]
    return np.where(turned, np.roll(rays, -1, axis=1), rays)


def _contrast(level: Floats, light: Mask) -> Floats:
    bright = np.maximum(level, 0.0).sum(axis=1) / np.maximum(light.sum(axis=1), 1)
    dark = np.minimum(level, 0.0).sum(axis=1) / np.maximum((~light).sum(axis=1), 1)
    return bright - dark


def _opposite(first: Floats, second: Floats) -> Mask:
    away: Mask = np.abs(np.mod(second - first, 2 * np.pi) - np.pi) < ODD_RAD
    return away
