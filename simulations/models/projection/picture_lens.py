"""The distortion of a picture's lens: known, or found from edges that are straight in the world.

Lengths in the plane of the picture are in a unit of pixels about the centre of distortion, in which
`simulations.models.distortion.lens` holds. Plumb lines: D. C. Brown, *Close-range camera
calibration*, 1971; F. Devernay and O. Faugeras, *Straight lines have to be straight*, 2001;
Szeliski, 2nd ed., §2.1.5.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats, quantile_of
from simulations.models.distortion.lens import Lens, distorted, ideal
from simulations.models.distortion.lens_model import Distortion

ORDINARY = 0.04
"""Standard deviation of k₁ among lenses, in units of half the diagonal: 4 % at the corners."""
SHORTEST = 50.0
"""Pixels of the shortest line along which an edge is looked for."""
APART, REACH, ASIDE = 6.0, 12.0, 2.0
"""Pixels between the places of a line, how far beside it the edge may be, and how far along it
light is averaged."""
LEAST_STEP, LEAST_SHARE = 0.02, 0.6
"""Least change of an edge per half pixel, with 1 for white, and share of the places with one."""
FINEST = 0.05
"""Pixels to which an edge in a picture is straight at best."""
ROUNDS = 3
NONE = Distortion()


@dataclass(frozen=True, slots=True)
class PictureLens:
    """Where a lens puts what an ideal one would put elsewhere."""

    centre: tuple[float, float] = (0.0, 0.0)
    """Centre of distortion, in pixels."""
    unit: tuple[float, float] = (1.0, 1.0)
    """Pixels of a length of 1, across and down."""
    distortion: Lens = NONE
    error: float = 0.0
    """Standard error of k₁; 0 if it is known."""
    pinhole_errors: tuple[float, float] | None = None
    """Of a calibrated lens, whose ``unit`` is the focal length and whose ``centre`` is the
    principal point: standard errors of the former, as a share, and of the latter, in pixels."""

    def straight(self, pixels: Floats) -> Floats:
        """Where an ideal lens would put points (..., 2) of the picture."""
        if self.distortion == NONE:
            return pixels
        return self._within(ideal(self._apart(pixels), self.distortion)[0])

    def bent(self, pixels: Floats) -> Floats:
        """Where the lens puts points (..., 2) of an ideal picture."""
        return self._within(distorted(self._apart(pixels), self.distortion))

    def straight_with_growth(self, points: Floats, across: Floats) -> tuple[Floats, Floats]:
        """`straight` (..., 2), and how much larger (...) it makes the noise of the points along
        unit vectors (..., 2)."""
        beside = 0.5 * np.broadcast_to(across, points.shape)
        straight, further, nearer = self.straight(
            np.stack([points, points + beside, points - beside])
        )
        return straight, np.asarray(np.sum((further - nearer) * across, axis=-1))

    def moved(self, step: float) -> "PictureLens":
        """With another k₁."""
        return replace(self, distortion=replace(self.distortion, k1=self.distortion.k1 + step))

    def _apart(self, pixels: Floats) -> Floats:
        return (pixels - np.array(self.centre)) / self.unit

    def _within(self, plane: Floats) -> Floats:
        return np.asarray(plane * self.unit + np.array(self.centre))


IDEAL = PictureLens()


def unknown_lens(size: tuple[float, float]) -> PictureLens:
    """A lens of which nothing is known, for a picture of this width and height."""
    half = 0.5 * float(np.hypot(*size))
    return PictureLens(((size[0] - 1) / 2, (size[1] - 1) / 2), (half, half), error=ORDINARY)


def edge_points(codes: NDArray[np.uint8], ends: Floats) -> Floats:
    """Points (N, 2) of the edge along a line (2, 2) that was drawn near it; none if there is none.

    The edge may bow, as a parabola does.
    """
    length = float(np.hypot(*(ends[1] - ends[0])))
    if length < SHORTEST or min(codes.shape[:2]) < 2:
        return np.zeros((0, 2))
    along = (ends[1] - ends[0]) / length
    normal = np.array([-along[1], along[0]])
    share = np.linspace(0.05, 0.95, int(length / APART))
    beside = np.arange(-REACH, REACH + 0.25, 0.5)
    middles = ends[0] + share[:, None] * (ends[1] - ends[0])
    places = middles[:, None] + beside[:, None] * normal
    light = np.mean([_sampled(codes, places + s * along) for s in (-ASIDE, 0.0, ASIDE)], axis=0)
    slope = np.abs(np.diff(light, axis=1))
    at = 0.5 * (beside[1:] + beside[:-1])
    peak = np.argmax(slope, axis=1)
    near = np.abs(np.arange(len(at)) - peak[:, None]) <= 4
    weight = np.where(near, np.square(slope), 0.0)
    offset = (weight @ at) / np.maximum(weight.sum(axis=1), 1e-12)
    used = slope.max(axis=1) > LEAST_STEP
    for _ in range(ROUNDS):
        if np.count_nonzero(used) < max(LEAST_SHARE * len(share), 8):
            return np.zeros((0, 2))
        off = np.abs(offset - np.polyval(np.polyfit(share[used], offset[used], 2), share))
        used = (off <= max(4.0 * quantile_of(off[used]), 0.2)) & (slope.max(axis=1) > LEAST_STEP)
    return np.asarray(middles[used] + offset[used, None] * normal)


def lens_by_lines(lines: Sequence[Floats], lens: PictureLens) -> PictureLens:
    """The lens whose picture of straight lines has these points (N, 2) each.

    What is known of ``lens`` counts as well. The error is the larger of two: that of points that
    scatter independently, and that by how much the lines, each as a whole, differ.
    """
    lines = [line for line in lines if len(line) >= 3]
    if not lines:
        return lens
    points, of = (
        np.concatenate(lines),
        np.repeat(np.arange(len(lines)), [len(line) for line in lines]),
    )
    chords = np.array([line[-1] - line[0] for line in lines])[of]
    across = np.stack([-chords[:, 1], chords[:, 0]], axis=1) / np.hypot(*chords.T)[:, None]
    found = lens
    for _ in range(ROUNDS):
        r = _bows(points, of, across, found)
        J = (_bows(points, of, across, found.moved(1e-5)) - r) / 1e-5
        variance = max(float(r @ r) / max(len(r) - 2 * len(lines) - 1, 1), FINEST**2)
        known = lens.error**-2
        information = float(J @ J) / variance + known
        away = found.distortion.k1 - lens.distortion.k1
        found = found.moved(-(float(J @ r) / variance + away * known) / information)
    leverage = np.bincount(of, J * J) / variance / information  # of a line; the jackknife
    pulls = np.bincount(of, J * r) / variance / np.maximum(1.0 - leverage, 0.1)
    shared = float(pulls @ pulls) / information**2
    return replace(found, error=float(np.sqrt(max(1.0 / information, shared))))


def _bows(points: Floats, of: NDArray[np.intp], across: Floats, lens: PictureLens) -> Floats:
    """(N,) how far points (N, 2) are from the straight line through all of their line (N,), behind
    an ideal lens, in pixels of the picture: else a lens that draws all smaller would seem the
    straighter."""
    straight, growth = lens.straight_with_growth(points, across)
    count = np.bincount(of)
    x, y = (each - (np.bincount(of, each) / count)[of] for each in straight.T)
    xx, yy, xy = (np.bincount(of, product) for product in (x * x, y * y, x * y))
    angle = (0.5 * np.arctan2(2 * xy, xx - yy))[of]
    return np.asarray((y * np.cos(angle) - x * np.sin(angle)) / growth)


def _sampled(codes: NDArray[np.uint8], places: Floats) -> Floats:
    """Green (...) from 0 to 1 between the pixels at places (..., 2)."""
    green = codes[..., 1]
    height, width = green.shape
    x, y = (np.clip(places[..., k], 0.0, side - 1.001) for k, side in enumerate((width, height)))
    u, v = x.astype(np.intp), y.astype(np.intp)
    right, down = x - u, y - v
    upper = green[v, u] * (1 - right) + green[v, u + 1] * right
    lower = green[v + 1, u] * (1 - right) + green[v + 1, u + 1] * right
    return np.asarray((upper * (1 - down) + lower * down) / 255)
