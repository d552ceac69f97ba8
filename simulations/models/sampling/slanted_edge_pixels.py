"""The pixels of a picture of an edge, by their distances from it. Lengths are in pixels."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, centred, quantile_of
from simulations.models.require import require
from simulations.models.sampling.slanted_edge_line import (
    MARGIN,
    TOO_SHORT,
    EdgeLine,
    Indices,
    UnfitEdgeError,
    as_shares,
    find_line,
)

REACH = 64.0
"""Pixels at most so far from the edge take part."""
MOST_FALL, SURE = 0.15, 8.0
"""Share by which light may grow or fall from the edge to the end of the reach, to be taken out, and
how many standard errors of noise of single pixels it must be."""
NEAR = 2.0
"""The slope of the edge of a sharp picture lies within this distance."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EdgePixels:
    """The pixels within reach of an edge, row by row."""

    line: EdgeLine
    reach: float
    """How far the picture extends on either side of the edge: whole pixels, `REACH` at most."""
    distance: Floats
    """(N,) distance of each pixel from the edge; positive on the lighter side."""
    value: Floats
    """(N,) value of each pixel; 0 and 1 are the mean dark and light, away from the edge."""
    row: Indices
    """(N,) which of the `EdgeLine.rows` it is in."""
    levels: tuple[float, float]
    """Mean light of the dark and of the light side."""

    @property
    def widest_gap(self) -> float:
        """Largest difference of successive distances near the edge."""
        near = np.sort(self.distance[np.abs(self.distance) < NEAR])
        return float(np.max(np.diff(near), initial=0.0)) if near.size > 1 else np.inf


def locate_edge(picture: ArrayLike) -> EdgePixels:
    """The pixels (H, W) of an edge that runs from end to end, in any direction, by their distances.

    Values must be proportional to the light. Raises `UnfitEdgeError` if there is no such edge.
    """
    values = np.asarray(picture, float)
    require("picture", values.shape, values.ndim == 2, "(H, W)")
    require("picture", values, bool(np.isfinite(values).all()), "finite")
    largest = float(np.abs(values).max(initial=0.0)) or 1.0
    return pixels_beside(find_line(values / largest), largest)


def pixels_beside(line: EdgeLine, unit: float = 1.0) -> EdgePixels:
    """The pixels of a line's picture by their distances from it; ``unit`` is the light of a 1.

    Pixels that are NaN, and rows that have no others, are left out.
    """
    height, width = line.picture.shape
    line = replace(line, rows=line.rows[np.isfinite(line.picture[line.rows]).any(axis=1)])
    y = centred(height)[line.rows]
    edge = line.column(y) + 0.5 * (width - 1)
    room = min(quantile_of(edge), width - 1 - quantile_of(edge))
    reach = min(REACH, float(np.floor(room * np.cos(line.angle_rad))))
    if reach < MARGIN:
        raise UnfitEdgeError(TOO_SHORT)
    beside = reach / np.cos(line.angle_rad) + 1.0
    columns = slice(max(0, int(edge.min() - beside)), int(edge.max() + beside) + 2)
    light, distance = line.picture[line.rows, columns], line.distances(columns)
    near = (np.abs(distance) < reach) & np.isfinite(light)
    light = light / _fall_off(light, distance, y, near, reach)
    dark, bright = (_row_means(light, near & (side * distance > 0.5 * reach)) for side in (-1, 1))
    share = as_shares(light, dark, bright, y)
    levels = unit * float(dark.mean()), unit * float(bright.mean())
    return EdgePixels(
        line=line,
        reach=reach,
        distance=distance[near],
        value=share[near],
        row=np.nonzero(near)[0],
        levels=levels,
    )


def _fall_off(light: Floats, distance: Floats, y: Floats, near: Mask, reach: float) -> Floats:
    """(N, W) light by that at the edge, if it falls off evenly over both sides: by its slope in the
    outer halves of both, beside that along the edge (heights (N,) of the rows); ones if that is
    noise, or more than `MOST_FALL`."""
    heights = np.broadcast_to(y[:, None], light.shape)
    slope = weight = variance = 0.0
    for side in (-1, 1):
        outer = near & (side * distance > 0.5 * reach)
        terms = np.stack([np.ones(np.count_nonzero(outer)), distance[outer], heights[outer]])
        inverse = np.linalg.pinv(terms @ terms.T)
        level, by_distance, by_height = inverse @ (terms @ light[outer])
        if inverse[1, 1] <= 0:
            continue
        off = light[outer] - (level, by_distance, by_height) @ terms
        slope += level * by_distance / inverse[1, 1]
        weight += level**2 / inverse[1, 1]
        variance += level**2 / inverse[1, 1] * float(np.mean(off**2))
    share = slope / weight if abs(slope) > SURE * np.sqrt(variance) else 0.0
    return 1 + share * distance if abs(share) * reach < MOST_FALL else np.ones_like(light)


def _row_means(values: Floats, chosen: Mask) -> Floats:
    """(N,) of the chosen pixels of each row (N, W); a row without any has the mean of all."""
    count = chosen.sum(axis=1)
    total = np.sum(values, axis=1, where=chosen)
    return np.where(count > 0, total / np.maximum(count, 1), total.sum() / max(count.sum(), 1))
