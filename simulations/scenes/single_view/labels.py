"""Where labels of lengths stand: by their lines, clear of the ends to grab and of each other."""

from collections.abc import Sequence

from simulations.engine import drawing
from simulations.engine.letters import width_em
from simulations.scenes.single_view.fields import HEIGHT, WIDTH, Point

LETTER = 15.5
"""Size of the letters in units, where the panel is as small as on a phone."""
HALF_HEIGHT = 12.0
HANDLE = 17.0
"""Half the side of a handle's mark there."""
ALONG = (0.5, 0.35, 0.65, 0.2, 0.8)
"""Shares of the line at which a label may stand ..."""
BESIDE = (0.0, 24.0, -24.0)
"""... and by how much it may be moved down from there."""


def beside_lines(
    wanted: Sequence[tuple[Point, Point, str]], handles: Sequence[Point], style: str
) -> str:
    """Labels by their lines (start, end, words), each at the first place that is free, or at the
    one that is least covered."""
    taken = [(x, y, HANDLE, HANDLE) for x, y in handles]
    made = []
    for start, end, words in wanted:
        half = 0.5 * LETTER * width_em(words, strong=False) + 5.0
        places = [
            (*_inside(start, end, share, beside, half), half, HALF_HEIGHT)
            for beside in BESIDE
            for share in ALONG
        ]
        best = min(places, key=lambda place: sum(_common(place, other) for other in taken))
        taken.append(best)
        made.append(drawing.text((best[0], best[1] + 4.0), words, style, "middle"))
    return "".join(made)


type Box = tuple[float, float, float, float]
"""Middle, half the width, half the height."""


def _inside(start: Point, end: Point, share: float, beside: float, half: float) -> Point:
    """A place by the line at which the label is wholly in the panel."""
    x = start[0] + share * (end[0] - start[0])
    y = start[1] + share * (end[1] - start[1]) + beside
    room = HALF_HEIGHT + 3.0
    return min(max(x, half), WIDTH - half), min(max(y, room), HEIGHT - room)


def _common(one: Box, other: Box) -> float:
    """The area that two boxes have in common."""
    across = one[2] + other[2] - abs(one[0] - other[0])
    down = one[3] + other[3] - abs(one[1] - other[1])
    return max(across, 0.0) * max(down, 0.0)
