"""Names beside the points of a chart: each where it covers least."""

from collections.abc import Sequence
from dataclasses import dataclass

SIZE = 13.0
LETTER = 0.5 * SIZE
"""Mean width of a letter of the sans face."""


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle in view box units."""

    left: float
    top: float
    right: float
    bottom: float

    def overlap(self, other: "Box") -> float:
        """Common area."""
        width = min(self.right, other.right) - max(self.left, other.left)
        height = min(self.bottom, other.bottom) - max(self.top, other.top)
        return max(width, 0.0) * max(height, 0.0)

    def grown(self, margin: float) -> "Box":
        return Box(self.left - margin, self.top - margin, self.right + margin, self.bottom + margin)

    def outside(self, frame: "Box") -> float:
        """Area that sticks out of ``frame``."""
        return (self.right - self.left) * (self.bottom - self.top) - self.overlap(frame)


@dataclass(frozen=True, slots=True)
class Label:
    """A placed name."""

    text: str
    x: float
    """Left edge."""
    y: float
    """Baseline."""


def place_labels(
    items: Sequence[tuple[str, Box]], frame: Box, obstacles: Sequence[Box] = ()
) -> tuple[Label, ...]:
    """One label for each (name, box of its marks), the crowded ones last.

    Greedy: of some fifteen places around its own marks a name takes the one that covers least,
    the first of equals. Names already placed weigh most, then other marks, then ``obstacles``.
    """
    marks = [box for _, box in items]
    placed: list[Box] = []
    labels: dict[int, Label] = {}
    order = sorted(range(len(items)), key=lambda index: _crowding(marks, index))
    for index in order:
        name, own = items[index]
        others = [box for other, box in enumerate(marks) if other != index]
        candidates = _candidates(name, own)

        def cost(box: Box, marks: Sequence[Box] = others) -> float:
            covered = ((1.0, marks), (4.0, placed), (0.3, obstacles))
            hidden = sum(weight * box.overlap(item) for weight, items in covered for item in items)
            return hidden + 20.0 * box.outside(frame)

        best = min(candidates, key=cost)
        placed.append(best)
        labels[index] = Label(name, best.left, best.bottom - 3.0)
    return tuple(labels[index] for index in range(len(items)))


def _crowding(marks: Sequence[Box], index: int) -> float:
    own = marks[index]
    near = Box(own.left - 60, own.top - 30, own.right + 60, own.bottom + 30)
    return sum(near.overlap(box) for box in marks)


def _candidates(name: str, own: Box) -> list[Box]:
    width, height, gap = LETTER * len(name), SIZE + 2.0, 3.0
    middle = (own.top + own.bottom) / 2
    centre = (own.left + own.right) / 2
    right, left = own.right + gap, own.left - gap - width
    above, below = own.top - gap - height + 2.0, own.bottom + gap - 2.0
    beside = [(right, middle - height / 2), (left, middle - height / 2)]
    corners = [
        (x, y)
        for y in (above, below)
        for x in (own.right - 6.0, centre - width / 2, own.left - width + 6.0, own.left)
    ]
    farther = [(x, y) for y in (above - height, below + height) for x in (own.right, left)]
    return [Box(x, y, x + width, y + height) for x, y in (*beside, *corners, *farther)]
