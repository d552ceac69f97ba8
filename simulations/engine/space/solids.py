"""Faces, wires, arrows and labels in space, drawn back to front.

    drawn([*box_faces, Wire(track, "ray bold"), Arrow(origin, tip, "camera")], VIEW)

The farthest is drawn first: faces by the mean depth of their corners, wires segment by segment.
This is right for solids that do not intersect and are of similar size; cut long faces if they are
not. Depths are rounded, so that CPython and Pyodide draw in the same order.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate, groupby, pairwise

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine import drawing
from simulations.engine.space.view import Points, View

DIGITS = 9
"""Decimals of the depths that are compared."""
DARKEST = 3
"""Extra layers of colour on a face that is turned away from the light."""


@dataclass(frozen=True, slots=True)
class Face:
    """A flat polygon, seen from both sides."""

    corners: ArrayLike
    """(n, 3) in order around the face."""
    role: str
    washes: int = 1
    """Layers of the role's colour, for shading: see `shaded`."""


@dataclass(frozen=True, slots=True)
class Wire:
    """A curve through points (n, 3)."""

    points: ArrayLike
    style: str


@dataclass(frozen=True, slots=True)
class Arrow:
    """A straight line with an arrow head at its end."""

    start: ArrayLike
    end: ArrayLike
    style: str
    head: float = 8.0


@dataclass(frozen=True, slots=True)
class Words:
    """A label next to a point, drawn in order of depth like the other solids."""

    point: ArrayLike
    words: str
    style: str = "ground"
    offset: tuple[float, float] = (8.0, -6.0)
    anchor: str = "start"


type Solid = Face | Wire | Arrow | Words


@dataclass(frozen=True, slots=True)
class _Piece:
    """A part of a solid, with one depth."""

    depth: float
    index: int
    """Index of its solid."""
    markup: str = ""
    segment: tuple[list[float], list[float]] | None = None
    """The segment of a wire, instead of markup."""


def draw_solids(solids: Sequence[Solid], view: View) -> str:
    """SVG of the solids, without the parts that are too near to the eye."""
    pieces = [
        piece
        for n, (solid, places) in enumerate(zip(solids, _placed(solids, view), strict=True))
        for piece in _pieces(n, solid, places)
    ]
    pieces.sort(key=lambda piece: -round(piece.depth, DIGITS))  # stable: equals keep their order
    parts: list[str] = []
    for index, group in groupby(pieces, key=lambda piece: piece.index):
        solid, together = solids[index], list(group)
        if isinstance(solid, Wire):
            segments = [piece.segment for piece in together if piece.segment]
            parts.append(drawing.path(_joined(segments), solid.style))
        else:
            parts += [piece.markup for piece in together]
    return "".join(parts)


def _placed(solids: Sequence[Solid], view: View) -> list[list[list[float]]]:
    """View box x, y and depth of the points of each solid, projected in one call for speed."""
    points = [_points(solid) for solid in solids]
    if not points:
        return []
    places = view.place(np.concatenate(points)).tolist()
    ends = list(accumulate(map(len, points)))
    return [
        places[end - len(solid_points) : end]
        for end, solid_points in zip(ends, points, strict=True)
    ]


def _points(solid: Solid) -> Points:
    match solid:
        case Face(corners):
            return np.asarray(corners, float)
        case Wire(curve):
            return np.asarray(curve, float)
        case Arrow(start, end):
            return np.stack([np.asarray(start, float), np.asarray(end, float)])
        case Words(point):
            return np.asarray(point, float)[None]


def _pieces(n: int, solid: Solid, places: list[list[float]]) -> Iterator[_Piece]:
    if isinstance(solid, Wire):
        for start, end in pairwise(places):
            if math.isfinite(start[0]) and math.isfinite(end[0]):
                yield _Piece((start[2] + end[2]) / 2, n, segment=(start[:2], end[:2]))
        return
    if not all(math.isfinite(place[0]) for place in places):
        return
    depth = sum(place[2] for place in places) / len(places)
    match solid:
        case Face(_, role, washes):
            markup = _face(places, role, washes)
        case Arrow(_, _, style, head):
            markup = drawing.arrow(places[0], places[1], style, head)
        case Words(_, words, style, (right, down), anchor):
            at = (places[0][0] + right, places[0][1] + down)
            markup = drawing.text(at, words, style, anchor)
    yield _Piece(depth, n, markup)


def _face(places: list[list[float]], role: str, washes: int) -> str:
    """The face in the colour of paper, then in ``washes`` layers of the role's colour."""
    shape = drawing.polygon(places, "{}")
    return shape.format("casing solid") + shape.format(f"{role} thin fill") * washes


def _joined(segments: Iterable[tuple[list[float], list[float]]]) -> list[list[list[float]]]:
    """Join segments, in any order, to runs in which each begins at the end of the last."""
    runs: list[list[list[float]]] = []
    for start, end in segments:
        for run in runs:
            if run[-1] == start:
                run.append(end)
                break
            if run[0] == end:
                run.insert(0, start)
                break
        else:
            runs.append([start, end])
    return runs


def shaded(corners: ArrayLike, view: View, towards_light: ArrayLike) -> int:
    """Layers of colour of a face (n, 3): from 1 facing a distant light to 4 facing away.

    The side that faces the viewer counts; a face seen edge on is between them.
    """
    (x0, y0, z0), (x1, y1, z1), (x2, y2, z2) = np.asarray(corners, float)[:3].tolist()
    one, other = (x1 - x0, y1 - y0, z1 - z0), (x2 - x0, y2 - y0, z2 - z0)
    normal = (
        one[1] * other[2] - one[2] * other[1],
        one[2] * other[0] - one[0] * other[2],
        one[0] * other[1] - one[1] * other[0],
    )
    size = max(math.hypot(*normal), 1e-9)
    away = _dot(normal, view.axes[2].tolist())
    light = np.asarray(towards_light, float).tolist()
    lit = -math.copysign(1.0, away) * _dot(normal, light) / size if abs(away) > 1e-9 * size else 0.0
    return 1 + round(0.5 * DARKEST * (1.0 - lit))


def _dot(one: Sequence[float], other: Sequence[float]) -> float:
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
