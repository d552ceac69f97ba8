"""Where the edge lies in a picture of an edge: a line, slightly bowed if need be.

In each row the light alone says where the edge is: the more of the row is light, the farther left
is the edge. That is exact to a fraction of a pixel for any symmetric blur. Lengths are in pixels.
P. D. Burns and D. Williams, *Refined slanted-edge measurement for practical camera and scanner
testing*, 2002; ISO 12233.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats, centred, quantile_of

type Indices = NDArray[np.intp]

SMALLEST = 16
"""Least count of rows, and of columns."""
WINDOW = 16
"""Pixels on either side of the edge whose light is added up, if the picture is so wide ..."""
MARGIN = 6
"""... and how many there must be. Rows in which the edge is nearer to a side are left out."""
LEAST_SHARE = 0.1
"""Rows that are dark, or light, to less than this share of their pixels do not hold the edge."""
ROUNDS = 4
"""How often the line is fitted; each time the window follows it."""
FAR_OFF = 4.0
"""Rows that are so many times the median off the line are left out: specks of dust."""
LEAST_STEP = 5.0
"""Least difference of dark and light, in standard deviations of the noise."""
MOST_SCATTER, MOST_BOW = 1.0, 0.03
"""Largest median distance of a row's edge from the line, and largest bow, per length of the line,
of a line that bows by more than a pixel."""

NO_EDGE = "No straight edge found: choose a rectangle that holds one edge, dark on one side."
TOO_SMALL = f"The rectangle is too small: choose at least {SMALLEST} × {SMALLEST} pixels."
FAINT = "Too little contrast: photograph an edge between black and white, evenly lit."
TOO_SHORT = "Too little of the edge: choose a rectangle that holds more of it, near its middle."
BOWED = "The edge is bowed: choose a shorter piece of it, or correct the lens first."


class UnfitEdgeError(ValueError):
    """An edge that gives no MTF. The message says to a reader what is wrong and what to do."""


@dataclass(frozen=True, slots=True)
class EdgeLine:
    """An edge, less than about 45° from the columns of ``picture``."""

    picture: Floats
    """(H, W) as found, or turned so that the edge is upright and the dark side on the left."""
    turned: bool
    """Whether rows and columns were exchanged."""
    mirrored: bool
    """Whether left and right were exchanged, after that."""
    coefficients: tuple[float, float, float]
    """(bow, slope, middle): at height y the edge is at ``middle + slope y + bow y²``. All are
    measured from the middle of the picture, as in `arrays.centred`."""
    rows: Indices
    """(N,) the rows that hold the edge and nothing else."""

    @property
    def angle_rad(self) -> float:
        """Slant against the columns, or the rows if ``turned``: 0 or more."""
        return float(np.arctan(abs(self.coefficients[1])))

    def on(self, picture: Floats) -> "EdgeLine":
        """The same line over another picture (H, W) of the same place, as in another colour."""
        values = picture.T if self.turned else picture
        return replace(self, picture=values[:, ::-1] if self.mirrored else values)

    def column(self, y: Floats) -> Floats:
        """Places (...) of the edge at heights (...)."""
        return np.polyval(self.coefficients, y)

    def distances(self, columns: slice) -> Floats:
        """(N, C) distance of the pixels in some columns along the normal of the edge; positive
        where it is light."""
        y = centred(self.picture.shape[0])[self.rows, None]
        bow, slope, _ = self.coefficients
        across: Floats = centred(self.picture.shape[1])[columns] - self.column(y)
        return across / np.hypot(1.0, slope + 2.0 * bow * y)


def find_line(picture: Floats) -> EdgeLine:
    """The edge in a picture (H, W) of light. Raises `UnfitEdgeError` if there is none."""
    if min(picture.shape) < SMALLEST:
        raise UnfitEdgeError(TOO_SMALL)
    _require_contrast(picture)
    values, turned, mirrored = _upright(picture)
    y = centred(values.shape[0])
    line = _rough_line(values, y)
    for _ in range(ROUNDS):
        rows, crossing = _crossings(values, np.polyval(line, y))
        off = np.abs(crossing - np.polyval(line, y[rows]))
        inliers = off <= FAR_OFF * max(quantile_of(off), 0.05)
        rows, crossing = rows[inliers], crossing[inliers]
        line = np.polyfit(y[rows], crossing, 2)
    length = float(np.ptp(y[rows]))
    if quantile_of(np.abs(crossing - np.polyval(line, y[rows]))) > MOST_SCATTER:
        raise UnfitEdgeError(NO_EDGE)
    if 0.25 * abs(line[0]) * length**2 > max(MOST_BOW * length, 1.0):
        raise UnfitEdgeError(BOWED)
    bow, slope, middle = line.tolist()
    return EdgeLine(values, turned, mirrored, (bow, slope, middle), rows)


def as_shares(values: Floats, dark: Floats, light: Floats, y: Floats) -> Floats:
    """Rows (N, W) of light as shares of the step from dark to light of their own row.

    ``dark`` and ``light`` (N,) are means of the rows at heights ``y``. Straight lines through them
    follow light that grows evenly along the edge. Raises `UnfitEdgeError` if light is not lighter.
    """
    slopes, middles = np.polyfit(y, np.stack([dark, light], axis=-1), 1)
    foot, top = (np.multiply.outer(y, slopes) + middles).T[..., None]
    if not np.all(top > foot):
        raise UnfitEdgeError(NO_EDGE)
    shares: Floats = (values - foot) / (top - foot)
    return shares


def _require_contrast(picture: Floats) -> None:
    low, high = _levels(_sample(picture))
    rows = picture[:: max(1, picture.shape[0] // 64)]
    noise = quantile_of(np.abs(np.diff(rows, axis=1))) / 0.954  # of a normal distribution
    if high - low <= max(LEAST_STEP * noise, 1e-6 * abs(high)):
        raise UnfitEdgeError(FAINT)


def _levels(values: Floats) -> tuple[float, float]:
    """Values between which nine tenths of all lie."""
    return quantile_of(values, 0.05), quantile_of(values, 0.95)


def _sample(values: Floats) -> Floats:
    """Pixels evenly spread over a picture, enough for its levels."""
    return values[tuple(slice(None, None, max(1, side // 128)) for side in values.shape)]


def _upright(picture: Floats) -> tuple[Floats, bool, bool]:
    """With the edge along the columns and dark on the left; whether turned, whether mirrored."""
    across, down = (float(np.mean(np.square(np.diff(picture, axis=axis)))) for axis in (1, 0))
    values = picture.T if down > across else picture
    half = values.shape[1] // 2
    mirrored = bool(values[:, :half].mean() > values[:, half:].mean())
    return (values[:, ::-1] if mirrored else values), down > across, mirrored


def _rough_line(values: Floats, y: Floats) -> Floats:
    """(0, slope, middle) by the light of whole rows; up to a quarter of them may be wrong."""
    few = _sample(values)
    half_way = 0.5 * sum(_levels(few))
    dark, light = (quantile_of(few[side]) for side in (few < half_way, few >= half_way))
    lit = np.mean((values - dark) / (light - dark), axis=1)
    both = (lit > LEAST_SHARE) & (lit < 1.0 - LEAST_SHARE)
    if both.sum() < SMALLEST:
        raise UnfitEdgeError(TOO_SHORT)
    height, crossing = y[both], (0.5 - lit[both]) * values.shape[1]
    apart = len(height) // 2
    slope = quantile_of((crossing[apart:] - crossing[:-apart]) / (height[apart:] - height[:-apart]))
    return np.array((0.0, slope, quantile_of(crossing - slope * height)))


def _crossings(values: Floats, guess: Floats) -> tuple[Indices, Floats]:
    """Rows (N,) with the edge, and where it is in each (N,), from places (H,) to look at."""
    middle = 0.5 * (values.shape[1] - 1)
    centre = np.rint(np.clip(guess + middle, -1, 2 * middle + 1)).astype(np.intp)
    margin = np.minimum(centre, values.shape[1] - 1 - centre)
    inside = margin >= MARGIN
    if inside.sum() < SMALLEST:
        raise UnfitEdgeError(TOO_SHORT)
    window = min(WINDOW, int(quantile_of(margin[inside], 0.1)))
    rows = np.flatnonzero(margin >= window)
    columns = centre[rows, None] + np.arange(-window, window + 1)
    near = values[rows[:, None], columns]
    dark, light = near[:, : window // 2].mean(axis=1), near[:, -(window // 2) :].mean(axis=1)
    lit = np.sum(as_shares(near, dark, light, rows - 0.5 * (len(values) - 1)), axis=1)
    return rows, centre[rows] + window + 0.5 - lit - middle
