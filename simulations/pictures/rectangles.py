"""A wall painted with rectangles, and its exact mean over the footprint of a pixel.

The edges of all rectangles divide the wall into cells of one colour each. The integral of the
colours from a corner of the wall up to a place is bilinear within each cell, so that the mean over
any footprint follows from the integral at the footprint's four corners, whatever edges it contains:
a summed-area table (Crow, "Summed-area tables for texture mapping", SIGGRAPH 1984) whose texels
have the sizes of the pattern.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats, Planes, gathered

type Bounds = tuple[float, float, float, float]
"""u from, to, v from, to: metres."""
type Places = NDArray[np.intp]

PER_M = 200
"""Steps a metre. All edges are at whole steps, so that a table finds the cell of a place."""
MARGIN_M = 1.0
"""The cells at the border go on for so far, for footprints that reach over it."""


@dataclass(frozen=True, slots=True)
class Axis:
    """The edges along one side of a wall."""

    edges: Floats
    """(n + 1,) metres, rising."""
    ends: Planes
    """(n,) the far edge of each cell."""
    cell: Places
    """(m,) the cell of each step from the first edge to the last."""

    def cells(self, places: Floats) -> Places:
        """The cells (...) of places (...) in metres; beyond the ends, the first and the last."""
        steps = (places - places.dtype.type(self.edges[0])) * PER_M
        return self.cell.take(steps.astype(np.intp), mode="clip")

    def ends_of(self, low: Floats, high: Floats) -> tuple[Floats, Places]:
        """Both ends (2, n) of footprints in float64, no farther than the wall, and their cells."""
        first, last, step = self.edges[0], self.edges[-1], 1 / PER_M
        ends = np.stack([np.clip(low, first, last - step), np.clip(high, first + step, last)])
        return ends, self.cells(ends)

    def span(self, low: float, high: float) -> slice:
        """The cells from an edge to another; edges beyond the wall are its ends."""
        bounds, near = self.edges.copy(), 0.5 / PER_M
        bounds[0] += MARGIN_M
        bounds[-1] -= MARGIN_M
        first = max(int(np.searchsorted(bounds, low + near, "right")) - 1, 0)
        return slice(first, int(np.searchsorted(bounds, high - near)))


@dataclass(frozen=True, slots=True)
class Rectangles:
    """A wall in cells of one colour each."""

    u: Axis
    v: Axis
    colours: Planes
    """(channels, cells): all cells along v of the first along u, then of the next."""
    integrals: Floats
    """(4, channels, cells) the integral from the first corner of the wall to a place s, t within
    the cell: the factors of 1, s, t and s t."""

    def means(self, u: Floats, v: Floats, wide: Floats, high: Floats) -> Planes:
        """Mean colours (channels, n) over the footprints about places (n,), metres."""
        half = np.float32(0.5)
        left, bottom = u - half * wide, v - half * high
        right, top = left + wide, bottom + high
        column, row = self.u.cells(left), self.v.cells(bottom)
        several = (right > self.u.ends[column]) | (top > self.v.ends[row])
        column *= len(self.v.edges) - 1
        column += row
        colours = gathered(self.colours, column)
        if (at := np.flatnonzero(several)).size:
            means = self._over_edges(*(end[at] for end in (left, right, bottom, top)))
            for plane, mean in zip(colours, means, strict=True):
                plane[at] = mean
        return colours

    def _over_edges(self, left: Floats, right: Floats, bottom: Floats, top: Floats) -> Planes:
        """Mean colours (channels, n) over footprints that reach over the ends of their cells: those
        of the four corners, by their shares, or of more cells, by the integrals."""
        column, row = self.u.cells(left), self.v.cells(bottom)
        last_column, last_row = self.u.cells(right), self.v.cells(top)
        count = len(self.v.edges) - 1
        first, beside, above, across = (
            gathered(self.colours, i * count + j)
            for j in (row, last_row)
            for i in (column, last_column)
        )
        share_u = np.clip((right - self.u.ends[column]) / (right - left), 0, 1)
        share_v = np.clip((top - self.v.ends[row]) / (top - bottom), 0, 1)
        low = first + share_u * (beside - first)
        high = above + share_u * (across - above)
        means = low + share_v * (high - low)
        many = np.flatnonzero((last_column > column + 1) | (last_row > row + 1))
        if many.size:
            means[:, many] = self._integrated(*(each[many] for each in (left, right, bottom, top)))
        return means

    def _integrated(self, left: Floats, right: Floats, bottom: Floats, top: Floats) -> Planes:
        """Mean colours (channels, n) over footprints, whatever cells they cover."""
        (s, column), (t, row) = self.u.ends_of(left, right), self.v.ends_of(bottom, top)
        cells = column[:, None] * (len(self.v.edges) - 1) + row
        area = (s[1] - s[0]) * (t[1] - t[0])
        s, t = (s - self.u.edges[column])[:, None], t - self.v.edges[row]
        rows = gathered(self.integrals.reshape(-1, self.integrals.shape[-1]), cells)
        once, by_s, by_t, by_both = rows.reshape(4, -1, *cells.shape)
        corners = once + s * by_s + t * (by_t + s * by_both)
        total = corners[:, 1, 1] - corners[:, 1, 0] - corners[:, 0, 1] + corners[:, 0, 0]
        return (total / area).astype(np.float32)


def painted(
    u: tuple[float, float],
    v: tuple[float, float],
    ground: ArrayLike,
    rectangles: Iterable[tuple[Bounds, ArrayLike]],
) -> Rectangles:
    """Rectangles painted over a ground that reaches from u[0] to u[1] and v[0] to v[1], metres,
    one after the other. Their colours have the length of the ground's."""
    painting = list(rectangles)
    across = _axis(*u, [edge for bounds, _ in painting for edge in bounds[:2]])
    along = _axis(*v, [edge for bounds, _ in painting for edge in bounds[2:]])
    shape = len(across.edges) - 1, len(along.edges) - 1
    cells = np.broadcast_to(np.asarray(ground, float), (*shape, np.size(ground))).copy()
    for (left, right, bottom, top), colour in painting:
        cells[across.span(left, right), along.span(bottom, top)] = colour
    colours = np.ascontiguousarray(cells.reshape(-1, np.size(ground)).T, np.float32)
    return Rectangles(across, along, colours, _integrals(across, along, cells))


def _axis(low: float, high: float, edges: Iterable[float]) -> Axis:
    """The axis of a wall from ``low`` to ``high``; edges outside are left out."""
    inner = {round(edge * PER_M) for edge in edges if low < edge < high}
    ends = {round((low - MARGIN_M) * PER_M), round((high + MARGIN_M) * PER_M)}
    steps = np.array(sorted(inner | ends))
    cells = np.repeat(np.arange(len(steps) - 1), np.diff(steps))
    return Axis(steps / PER_M, (steps[1:] / PER_M).astype(np.float32), cells)


def _integrals(u: Axis, v: Axis, cells: Floats) -> Floats:
    wide, high = np.diff(u.edges)[:, None, None], np.diff(v.edges)[:, None]
    below = np.cumsum(cells * high, axis=1) - cells * high  # over v, up to the cell
    beside = np.cumsum(cells * wide, axis=0) - cells * wide
    before = np.cumsum(below * wide, axis=0) - below * wide
    parts = np.stack([before, below, beside, cells]).transpose(0, 3, 1, 2)
    return np.ascontiguousarray(parts.reshape(4, cells.shape[-1], -1))
