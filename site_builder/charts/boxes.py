"""Rectangles in a drawing: what they share, how far they are apart, what they hide of a line."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

type Point = tuple[float, float]
type Segment = tuple[Point, Point]


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

    def outside(self, frame: "Box") -> float:
        """Area that sticks out of ``frame``."""
        return (self.right - self.left) * (self.bottom - self.top) - self.overlap(frame)

    def gap(self, other: "Box") -> float:
        """Distance between the two; 0 where they touch."""
        across = max(other.left - self.right, self.left - other.right, 0.0)
        down = max(other.top - self.bottom, self.top - other.bottom, 0.0)
        return math.hypot(across, down)

    def nearest(self, point: Point) -> Point:
        """The point of the box that lies nearest to ``point``."""
        x, y = point
        return min(max(x, self.left), self.right), min(max(y, self.top), self.bottom)

    def length_inside(self, segment: Segment) -> float:
        """Length of the part of a segment that lies in the box (Liang and Barsky's clipping)."""
        (x, y), (x2, y2) = segment
        first, last = 0.0, 1.0
        for start, step, low, high in (
            (x, x2 - x, self.left, self.right),
            (y, y2 - y, self.top, self.bottom),
        ):
            if step == 0:
                if not low < start < high:
                    return 0.0
                continue
            ends = sorted(((low - start) / step, (high - start) / step))
            first, last = max(first, ends[0]), min(last, ends[1])
        return max(last - first, 0.0) * math.hypot(x2 - x, y2 - y)


def hull(boxes: Sequence[Box]) -> Box:
    """The smallest box around all of them."""
    return Box(
        min(box.left for box in boxes),
        min(box.top for box in boxes),
        max(box.right for box in boxes),
        max(box.bottom for box in boxes),
    )
