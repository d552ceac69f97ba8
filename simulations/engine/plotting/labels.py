"""Labels next to their points: within the panel, without overlap, off the curves if possible.

    place_labels([Label(peak, "peak", "ray"), Label(foot, "Nyquist")], Rectangle(0, 0, 400, 300))

Labels are placed in order, each in the best place that is left: the most important comes first.
Costs are rounded, so that CPython and Pyodide choose alike.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import KW_ONLY, dataclass
from itertools import product

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import Point, line
from simulations.engine.letters import ASCENT, DESCENT, size_of, width_of
from simulations.engine.plotting.plot import Plot

SIDES = {
    "above right": (1, -1),
    "right": (1, 0),
    "above": (0, -1),
    "left": (-1, 0),
    "above left": (-1, -1),
    "below right": (1, 1),
    "below": (0, 1),
    "below left": (-1, 1),
}
"""The sides of a point for its label, the preferred ones first, as directions."""
FARTHER, WITH_LEADER = (1.0, 2.0, 3.5), (5.0, 7.0)
"""Distances to try, in multiples of the label's own; more for labels with a leader line."""
APART = 1.5
"""The multiple from which on a label needs its leader line."""
OUTSIDE, ON_LABEL, ON_CURVE, LATER = 1e3, 1e2, 20.0, 2.0
"""Costs: per unit outside, per unit of overlapping area, per hidden point, per later place."""
CHOICE = 6
"""Points of a curve from one possible place of its name to the next."""
SPACING = 5.0
"""Distance of the points at which a curve is tested."""


@dataclass(frozen=True, slots=True)
class Rectangle:
    """A rectangle in view box units."""

    left: float
    top: float
    right: float
    bottom: float

    def shared(self, other: "Rectangle") -> float:
        """Area of the overlap."""
        width = min(self.right, other.right) - max(self.left, other.left)
        height = min(self.bottom, other.bottom) - max(self.top, other.top)
        return max(width, 0.0) * max(height, 0.0)

    def sticks_out_of(self, other: "Rectangle") -> float:
        """Units by which it exceeds a rectangle, summed over the sides."""
        beyond = (
            (other.left - self.left, self.right - other.right),
            (other.top - self.top, self.bottom - other.bottom),
        )
        return sum(max(units, 0.0) for pair in beyond for units in pair)

    def nearest(self, point: Point) -> tuple[float, float]:
        """The nearest place of the rectangle to a point."""
        x, y = float(point[0]), float(point[1])
        return min(max(x, self.left), self.right), min(max(y, self.top), self.bottom)

    def holds(self, points: np.ndarray) -> int:
        """Count of the points (n, 2) in the rectangle."""
        across = (points[:, 0] > self.left) & (points[:, 0] < self.right)
        return int((across & (points[:, 1] > self.top) & (points[:, 1] < self.bottom)).sum())


@dataclass(frozen=True, slots=True)
class Label:
    """A label of a point."""

    point: Point
    words: str
    style: str = ""
    _: KW_ONLY
    prefer: str = "above right"
    """The side that is tried first; a key of `SIDES`."""
    distance: float = 9.0
    leader: str = ""
    """Style of the leader line to the point, drawn if the label is not next to it; empty for
    none."""
    others: Sequence[Point] = ()
    """Alternative points for the label."""
    scale: float = 1.0
    """Size of its letters, relative to a figure's labels."""

    def __post_init__(self) -> None:
        if self.prefer not in SIDES:
            raise ValueError(f"prefer={self.prefer!r}; legal: {', '.join(map(repr, SIDES))}")


@dataclass(frozen=True, slots=True)
class Placed:
    """A place for a label."""

    baseline: tuple[float, float]
    anchor: str
    box: Rectangle
    point: Point


def place_labels(
    labels: Sequence[Label],
    inside: Rectangle,
    curves: Iterable[Sequence[Point]] = (),
    taken: Sequence[Rectangle] = (),
) -> str:
    """SVG of the labels, which avoid ``curves`` if possible and the rectangles ``taken``."""
    hidden = _along(curves)
    boxes, marks = list(taken), []
    for entry in labels:
        best = _best(_places(entry, inside), inside, boxes, hidden)
        boxes.append(best.box)
        end = best.box.nearest(best.point)
        if entry.leader and math.dist(end, best.point) > APART * entry.distance:
            marks.append(line(end, best.point, entry.leader))
        marks.append(label(best.baseline, entry.words, entry.style, best.anchor))
    return "".join(marks)


def name_curves(plot: Plot, xs: np.ndarray, curves: Sequence[tuple[str, str, np.ndarray]]) -> str:
    """SVG of the names of curves ``(words, style, ys)``, each where its curve is far from the
    others and, if possible, above or below all of them."""
    heights = np.clip([plot.y.position(ys) for *_, ys in curves], plot.y.end, plot.y.start)
    across, labels = plot.x.position(xs), []
    for index, (words, style, _) in enumerate(curves):
        off = np.delete(heights, index, axis=0) - heights[index]
        outer = (off > 0.0).all(axis=0) | (off < 0.0).all(axis=0)
        gap = np.round(np.where(outer, 2.0, 1.0) * np.abs(off).min(axis=0), 1)
        ranked = np.argsort(-gap[CHOICE:-CHOICE:CHOICE], kind="stable") * CHOICE + CHOICE
        ranked = ranked[2.0 * gap[ranked] >= gap[ranked[0]]]
        nearest = off[np.abs(off[:, ranked[0]]).argmin(), ranked[0]]
        first, *others = zip(across[ranked], heights[index, ranked], strict=True)
        rises = heights[index, ranked[0] + 1] < heights[index, ranked[0] - 1]
        side = "above " if nearest > 0.0 else "below "
        side += "left" if rises == (nearest > 0.0) else "right"
        labels.append(
            Label(first, words, f"{style.split()[0]} small ground", prefer=side, others=others)
        )
    inside = Rectangle(plot.x.start + 2, plot.y.end, plot.x.end, plot.y.start - 2)
    return place_labels(labels, inside, [[*zip(across, row, strict=True)] for row in heights])


def _places(entry: Label, inside: Rectangle) -> Iterator[Placed]:
    sides = [SIDES[entry.prefer], *(s for name, s in SIDES.items() if name != entry.prefer)]
    size = entry.scale * size_of(entry.style)
    width, height = entry.scale * width_of(entry.words, entry.style), (ASCENT + DESCENT) * size
    for farther in FARTHER + WITH_LEADER * bool(entry.leader):
        away = entry.distance * farther
        for (right, down), point in product(sides, (entry.point, *entry.others)):
            slant = 0.7 if right and down else 1.0
            x = float(point[0]) + right * away * slant
            middle = float(point[1]) + down * (away * slant + 0.5 * height)
            left = x - width * (0.5 - 0.5 * right)
            if not right:  # above and below the point, a label may be shifted to stay inside
                left = min(max(left, inside.left), inside.right - width)
                x = left + 0.5 * width
            top = middle - 0.5 * height
            anchor = ("end", "middle", "start")[right + 1]
            box = Rectangle(left, top, left + width, top + height)
            yield Placed((x, top + ASCENT * size), anchor, box, point)


def _best(
    places: Iterator[Placed], inside: Rectangle, boxes: Sequence[Rectangle], hidden: np.ndarray
) -> Placed:
    chosen = next(places)
    least = _cost(chosen.box, inside, boxes, hidden, math.inf)
    for later, place in enumerate(places, start=1):
        if least <= LATER * later:
            break  # no later place can cost less
        cost = LATER * later + _cost(place.box, inside, boxes, hidden, least - LATER * later)
        if cost < least:
            chosen, least = place, cost
    return chosen


def _cost(
    box: Rectangle,
    inside: Rectangle,
    boxes: Sequence[Rectangle],
    hidden: np.ndarray,
    enough: float,
) -> float:
    """The cost of a place; if it is ``enough`` without the curves, their points are not counted."""
    cost = OUTSIDE * box.sticks_out_of(inside)
    cost += ON_LABEL * sum(box.shared(other) for other in boxes)
    least = round(cost, 3)
    if least >= enough:
        return least
    return round(cost + ON_CURVE * box.holds(hidden), 3)


def _along(curves: Iterable[Sequence[Point]]) -> np.ndarray:
    """Points (n, 2) along the curves, close enough that no label fits between two of them."""
    found = [np.empty((0, 2))]
    for curve in curves:
        places = np.asarray([(point[0], point[1]) for point in curve], float)
        if len(places) < 2:
            found.append(places.reshape(-1, 2))
            continue
        steps = np.hypot(*np.diff(places, axis=0).T)
        lengths = np.concatenate(([0.0], np.cumsum(steps)))
        at = np.linspace(0.0, lengths[-1], max(2, int(np.ceil(lengths[-1] / SPACING)) + 1))
        found.append(np.stack([np.interp(at, lengths, places[:, n]) for n in (0, 1)], axis=-1))
    return np.concatenate(found)
