"""Names beside the points of a chart: each where it covers least, tied to its point where far."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from site_builder.charts.boxes import Box, Segment, hull

SIZE = 14.0
"""Of letters on a phone, where they are largest in the chart's units."""
NARROW, WIDE = frozenset("fijlrt,.;:'|() I"), frozenset("mwMW")
HEIGHT = SIZE + 2.0

COVERED_DOT = 6.0
"""Cost of each unit of area of a dot, or of another name, under a name."""
COVERED_LINE = 8.0
"""Cost of each unit of length of a line that a name interrupts."""
AWAY = 5.0
"""Cost of each unit of distance between a name and its own dots."""
CROSSED = 20.0
"""Cost of each unit of length of another's dot or name under the line between name and dot."""
MISTAKEN = 100.0
"""Cost of standing nearer to another's dot than to one's own."""
OUTSIDE = 20.0
"""Cost of each unit of area outside the frame."""

NEAR = 7.0
"""Gap up to which a name needs no line to its dot."""
SWEEPS = 3
"""How often every name may move again once all have a place."""


@dataclass(frozen=True, slots=True)
class Label:
    """A placed name."""

    text: str
    x: float
    y: float
    """Baseline."""
    anchor: str
    """Which end of the text is at ``x``: the one beside the dot, as widths are estimates."""
    leader: Segment | None
    """A line from the name to its dot, where they are apart or another's dot is nearer."""


@dataclass(frozen=True, slots=True)
class _Surroundings:
    """The dots of a chart, as one name sees them."""

    own: Sequence[Box]
    others: Sequence[Box]
    hulls: Sequence[Box]
    """Around the dots of each of the others."""


def place_labels(
    items: Sequence[tuple[str, Sequence[Box]]], frame: Box, lines: Sequence[Segment] = ()
) -> tuple[Label, ...]:
    """One label for each (name, boxes of its dots).

    Every name in turn takes the cheapest of the places around its dots, given where the others
    are, until no name gains by moving.
    """
    places: dict[int, Box] = {}
    around = [_surroundings(items, index) for index in range(len(items))]
    for _ in range(SWEEPS):
        before = dict(places)
        for index, (name, _) in enumerate(items):
            taken = [box for other, box in places.items() if other != index]
            places[index] = _cheapest(name, around[index], taken, frame, lines)
        if places == before:
            break
    return tuple(
        _label(name, places[index], near)
        for index, ((name, _), near) in enumerate(zip(items, around, strict=True))
    )


def _label(name: str, box: Box, near: _Surroundings) -> Label:
    dot = min(near.own, key=box.gap)
    ends = {
        abs(box.left - dot.right): (box.left, "start"),
        abs(box.right - dot.left): (box.right, "end"),
        abs(box.left + box.right - dot.left - dot.right) / 2: (
            (box.left + box.right) / 2,
            "middle",
        ),
    }
    x, anchor = ends[min(ends)]
    return Label(name, x, box.bottom - 3.0, anchor, _leader(box, near))


def _surroundings(items: Sequence[tuple[str, Sequence[Box]]], index: int) -> _Surroundings:
    others = [dots for other, (_, dots) in enumerate(items) if other != index]
    flat = [dot for dots in others for dot in dots]
    return _Surroundings(items[index][1], flat, [hull(dots) for dots in others])


def _cheapest(
    name: str, near: _Surroundings, taken: Sequence[Box], frame: Box, lines: Sequence[Segment]
) -> Box:
    places = [(_away(box, near), box) for box in _candidates(name, near.own)]
    places.sort(key=lambda place: place[0])
    best, least = places[0][1], math.inf
    for away, box in places:
        if away >= least:
            break
        cost = away + OUTSIDE * box.outside(frame) + _hidden(box, near, taken, lines)
        if cost < least:
            best, least = box, cost
    return best


def _away(box: Box, near: _Surroundings) -> float:
    return AWAY * min(box.gap(dot) for dot in near.own)


def _hidden(box: Box, near: _Surroundings, taken: Sequence[Box], lines: Sequence[Segment]) -> float:
    """What a name there covers, and what the line to its dot would cross."""
    cost = COVERED_DOT * sum(box.overlap(item) for item in (*near.own, *near.others, *taken))
    cost += COVERED_LINE * sum(box.length_inside(line) for line in lines)
    leader = _leader(box, near)
    if leader:
        crossed = sum(item.length_inside(leader) for item in (*near.others, *taken))
        cost += CROSSED * crossed
    return cost + MISTAKEN * _is_mistaken(box, near)


def _is_mistaken(box: Box, near: _Surroundings) -> bool:
    """Whether another tier, from dot to dot, is as near."""
    return any(box.gap(other) < box.gap(hull(near.own)) + 2.0 for other in near.hulls)


def _leader(place: Box, near: _Surroundings) -> Segment | None:
    own = min(near.own, key=place.gap)
    if place.gap(own) <= NEAR and not _is_mistaken(place, near):
        return None
    start = place.nearest(((own.left + own.right) / 2, (own.top + own.bottom) / 2))
    return start, own.nearest(start)


def _candidates(name: str, own: Sequence[Box]) -> Iterator[Box]:
    """Beside and around each dot, then in rings farther out; in no particular order."""
    width, gap = _width(name), 3.0
    for dot in own:
        x, y = (dot.left + dot.right) / 2, (dot.top + dot.bottom) / 2
        lefts = (dot.right + gap, dot.left - gap - width)
        yield from (Box(a, y - HEIGHT / 2, a + width, y + HEIGHT / 2) for a in lefts)
        for out in (0.0, 12.0, 26.0, 44.0):
            tops = (dot.top - HEIGHT - out + 1.0, dot.bottom + out - 1.0)
            starts = (x - width / 2, dot.left, dot.right - width, dot.right, dot.left - width)
            shifts = (0.0,) if out == 0 else (-24.0, 0.0, 24.0)
            yield from (
                Box(a + shift, top, a + shift + width, top + HEIGHT)
                for top in tops
                for a in starts
                for shift in shifts
            )


def _width(name: str) -> float:
    """About as wide as the sans face sets it."""
    return sum(3.9 if sign in NARROW else 11.4 if sign in WIDE else 7.5 for sign in name)
