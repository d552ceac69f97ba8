"""Corners joined to their neighbours along edges, and numbered by column and row.

Two corners are neighbours if an edge of the one leads to the other and back, each is the nearest
on that edge, and the edge between them is dark on one side and light on the other, as their arcs
say. Walking from neighbour to neighbour then gives each corner its column and row. Columns grow
along one edge and rows along the next one clockwise, so that no numbering is mirrored.
"""

from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats, Mask, Planes
from simulations.models.chequerboard.saddle_points import Saddles, sample

NEAREST = 24
"""Candidates about each that are tried as its neighbours."""
AWRY = 0.22
"""Tangent of the largest angle between an edge's direction and its neighbour's."""
LEAST_CONTRAST = 0.25
"""Contrast across the edge between neighbours, as a share of the corner's."""

type Whole = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Grid:
    """Corners with their columns and rows."""

    places: Floats
    """(N, 2) px."""
    indices: Whole
    """(N, 2) column and row; at (0, 0) it is light between the directions in which they grow."""


def link_corners(saddles: Saddles, smooth: Planes) -> Whole:
    """(N, 4) the neighbour along each edge, −1 for none; in the order of `Saddles.rays_rad`."""
    count = len(saddles.places)
    links = np.full((count, 4), -1)
    if count < 4:
        return links
    near = _nearest(saddles.places)
    away = saddles.places[near] - saddles.places[:, None]
    distance = np.hypot(away[..., 0], away[..., 1])
    rays = np.stack([np.cos(saddles.rays_rad), np.sin(saddles.rays_rad)], axis=-1)
    facing = np.full((count, 4), -1)
    for ray in range(4):
        along = (away * rays[:, None, ray]).sum(axis=-1)
        back, straight = _return_edges(near, away, rays, ray)
        fit = straight & (along > distance / np.hypot(1.0, AWRY))
        reach = np.where(fit, distance, np.inf)
        best = reach.argmin(axis=1)
        row = np.arange(count)
        found = np.isfinite(reach[row, best])
        links[found, ray] = near[row, best][found]
        facing[found, ray] = back[row, best][found]
    corner, edge = np.nonzero(links >= 0)
    other = links[corner, edge]
    sure = links[other, facing[corner, edge]] == corner
    sure &= _edge_between(saddles, smooth, corner, other, edge)
    links[corner[~sure], edge[~sure]] = -1
    return links


def _nearest(places: Floats) -> Whole:
    """(N, K) the nearest other candidates, in any order."""
    x, y = places.astype(np.float32).T
    square = (x[:, None] - x) ** 2 + (y[:, None] - y) ** 2
    np.fill_diagonal(square, np.inf)
    count = min(NEAREST, len(places) - 1)
    return np.argpartition(square, count - 1, axis=1)[:, :count]


def _return_edges(near: Whole, away: Floats, rays: Floats, ray: int) -> tuple[Whole, Mask]:
    """(N, K) the edge of the other that leads back, and whether it does so nearly straight.

    As the same side of the edge is light at both ends, an even edge meets an odd one.
    """
    theirs = rays[near][..., 1 - ray % 2 :: 2, :]
    towards = -(theirs * away[:, :, None]).sum(axis=-1)
    best = towards.argmax(axis=-1)
    distance = np.hypot(away[..., 0], away[..., 1])
    straight = towards.max(axis=-1) > distance / np.hypot(1.0, AWRY)
    return 2 * best + 1 - ray % 2, straight


def _edge_between(
    saddles: Saddles, smooth: Planes, corner: Whole, other: Whole, edge: Whole
) -> Mask:
    """(M,) whether the edge has its light on the side that the corner says, all along."""
    start, away = saddles.places[corner], saddles.places[other] - saddles.places[corner]
    length = np.hypot(away[:, 0], away[:, 1])[:, None]
    clockwise = np.stack([-away[:, 1], away[:, 0]], axis=-1) / length
    aside = np.clip(0.2 * length, 1.0, 3.0) * clockwise
    aside *= np.where(edge % 2 == 0, 1.0, -1.0)[:, None]
    sides = [
        sample(smooth, start + share * away + aside) - sample(smooth, start + share * away - aside)
        for share in (0.3, 0.5, 0.7)
    ]
    contrast = np.minimum(saddles.contrast[corner], saddles.contrast[other])
    sure: Mask = np.min(sides, axis=0) > LEAST_CONTRAST * contrast
    return sure


def walk(saddles: Saddles, links: Whole) -> list[Grid]:
    """The connected grids, the largest first."""
    facing = _facing(links)
    visited = np.zeros(len(links), bool)
    grids = []
    for seed in range(len(links)):
        if not visited[seed] and (links[seed] >= 0).sum() >= 2:
            at = _walk_from(seed, links, facing, visited)
            grids.append(Grid(saddles.places[list(at)], np.array(list(at.values()))))
    return sorted(grids, key=lambda grid: -len(grid.places))


def _facing(links: Whole) -> Whole:
    """(N, 4) the edge of the neighbour that leads back; undefined where there is none."""
    matches = links[links] == np.arange(len(links))[:, None, None]
    back: Whole = matches.argmax(axis=-1)
    return back


def _walk_from(seed: int, links: Whole, facing: Whole, visited: Mask) -> dict[int, tuple[int, int]]:
    """Column and row of each corner that is connected to ``seed``."""
    steps = ((1, 0), (0, 1), (-1, 0), (0, -1))
    turned, at, taken = {seed: 0}, {seed: (0, 0)}, {(0, 0)}
    queue = deque([seed])
    visited[seed] = True
    while queue:
        corner = queue.popleft()
        for direction, (right, down) in enumerate(steps):
            edge = (turned[corner] + direction) % 4
            other = int(links[corner, edge])
            place = (at[corner][0] + right, at[corner][1] + down)
            if other < 0 or visited[other] or place in taken:
                continue
            turned[other] = (int(facing[corner, edge]) - direction - 2) % 4
            at[other] = place
            taken.add(place)
            visited[other] = True
            queue.append(other)
    return at
