"""A legend: the signs of a plot's series in one row."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from simulations.engine.drafting import label
from simulations.engine.drawing import Point, dot, line, rectangle
from simulations.engine.letters import width_of

type Sign = Literal["line", "dot", "area"]

LENGTH, GAP, BETWEEN = 20.0, 6.0, 12.0
"""Length of a line as a sign; gap between a sign and its words; least gap between two entries."""


@dataclass(frozen=True, slots=True)
class Entry:
    """The legend's entry for a series."""

    words: str
    style: str
    """CSS classes of the sign; the first, the role, is also the colour of the words."""
    sign: Sign = "line"
    visible: bool = True
    """If not visible, its place stays empty, so that the others do not move."""


def legend(start: Point, entries: Sequence[Entry], style: str = "", room: float = 0.0) -> str:
    """Entries from ``start``, the left end of the baseline, evenly spaced over ``room`` if given.

    ``style`` is the CSS classes of the words, in addition to the role.
    """
    x, y = float(start[0]), float(start[1])
    widths = [_sign_width(entry) + GAP + width_of(entry.words, style) for entry in entries]
    spare = (room - sum(widths)) / max(len(entries) - 1, 1)
    parts = []
    for entry, width in zip(entries, widths, strict=True):
        if entry.visible:
            role = f"{entry.style.partition(' ')[0]} {style}".strip()
            parts += [
                _sign(entry, x, y - 4.5),
                label((x + _sign_width(entry) + GAP, y), entry.words, role),
            ]
        x += width + max(spare, BETWEEN)
    return "".join(parts)


def _sign_width(entry: Entry) -> float:
    return 8.0 if entry.sign == "dot" else LENGTH


def _sign(entry: Entry, x: float, y: float) -> str:
    match entry.sign:
        case "line":
            return line((x, y), (x + LENGTH, y), entry.style)
        case "dot":
            return dot((x + 4.0, y), entry.style, 4.0)
        case "area":
            return rectangle((x, y - 5.0), LENGTH, 10.0, entry.style)
