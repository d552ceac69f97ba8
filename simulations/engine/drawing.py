"""SVG markup for overlays: functions from coordinates to strings.

Coordinates are view box units, x right, y down. ``style`` is a list of CSS classes: a colour role
(world, camera, ray, image, light, error, muted) and, if wanted, a manner (dashed, thin, bold, fill,
solid, faint). Numbers are rounded to 1/100 unit, so that two machines whose libm differ in the last
place draw the same markup.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from simulations.engine.letters import width_em

if TYPE_CHECKING:
    from numpy.typing import NDArray

type Points = NDArray[np.floating]
type Point = Sequence[float] | Points

PAIR = "%.2f,%.2f"
SHORTER = (("-0.00", "0"), (".00", ""), *((f".{digit}0", f".{digit}") for digit in range(1, 10)))
"""Replacements that shorten numbers of two decimals; the order matters."""

MOST_POINTS = 50_000
"""Limit of one line: a panel is a few hundred units wide."""
GROUND_PAD_EM = 0.28
"""Room on both sides of a label on its ground."""
BEFORE = {"start": 0.0, "middle": 0.5, "end": 1.0}
"""The part of a label that lies to the left of its place, by its anchor."""


def coordinate(value: float) -> str:
    """A number for an SVG attribute. Raises `ValueError` if it is not finite."""
    if not math.isfinite(value):
        raise ValueError(f"cannot draw at {value!r}: clip or mask before drawing")
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def check_count(count: int) -> None:
    """Raises `ValueError` where a line has more points than a page can draw."""
    if count > MOST_POINTS:
        raise ValueError(f"a line through {count:,} points; legal: at most {MOST_POINTS:,}")


def point_list(points: Iterable[Point], joint: str = " ") -> str:
    """The numbers of an attribute ``points``."""
    rows = points.tolist() if isinstance(points, np.ndarray) else [*points]
    check_count(len(rows))
    return _written(joint.join([PAIR] * len(rows)), [value for row in rows for value in row[:2]])


def _written(form: str, numbers: list[float]) -> str:
    """`coordinate` of all numbers at once, which is faster for the hundreds of a curve."""
    if not math.isfinite(sum(numbers)):
        for number in numbers:
            coordinate(number)
    text = form % tuple(numbers)
    for written, meant in SHORTER:
        text = text.replace(written, meant)
    return text


def line(start: Point, end: Point, style: str = "") -> str:
    x1, y1, x2, y2 = (coordinate(value) for value in (start[0], start[1], end[0], end[1]))
    return f'<line class="{style}" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"/>'


def polyline(points: Iterable[Point], style: str = "") -> str:
    return f'<polyline class="{style}" points="{point_list(points)}"/>'


def polygon(points: Iterable[Point], style: str = "") -> str:
    return f'<polygon class="{style}" points="{point_list(points)}"/>'


def path(subpaths: Iterable[Iterable[Point]], style: str = "") -> str:
    """Many open polylines in one element: cheaper to paint than one element each. Thousands are
    fastest as one array (N, points, 2) of finite numbers."""
    if isinstance(subpaths, np.ndarray):
        check_count(subpaths.size)
        forms = ["M" + "L".join([PAIR] * subpaths.shape[1])] * len(subpaths)
        numbers = subpaths.ravel().tolist()
    else:
        runs = [run.tolist() if isinstance(run, np.ndarray) else [*run] for run in subpaths]
        for run in runs:
            check_count(len(run))
        forms = ["M" + "L".join([PAIR] * len(run)) for run in runs]
        numbers = [value for run in runs for point in run for value in point[:2]]
    return f'<path class="{style}" d="{_written("".join(forms), numbers)}"/>'


def circle(centre: Point, radius: float, style: str = "") -> str:
    cx, cy, r = coordinate(centre[0]), coordinate(centre[1]), coordinate(radius)
    return f'<circle class="{style}" cx="{cx}" cy="{cy}" r="{r}"/>'


def ellipse(centre: Point, radii: Point, style: str = "") -> str:
    cx, cy, rx, ry = (coordinate(value) for value in (centre[0], centre[1], radii[0], radii[1]))
    return f'<ellipse class="{style}" cx="{cx}" cy="{cy}" rx="{rx}" ry="{ry}"/>'


def rectangle(corner: Point, width: float, height: float, style: str = "") -> str:
    x, y, w, h = (coordinate(value) for value in (corner[0], corner[1], width, height))
    return f'<rect class="{style}" x="{x}" y="{y}" width="{w}" height="{h}"/>'


def dot(centre: Point, style: str = "", radius: float = 4.0) -> str:
    """A filled point."""
    return circle(centre, radius, f"{style} solid".strip())


def cased(shape: Callable[..., str], *place: Any, style: str) -> str:
    """A shape over its outline in the colour of paper, so that it is seen on any picture."""
    return shape(*place, "casing") + shape(*place, style)


def escaped(content: str) -> str:
    """Escape text for SVG. `html.escape` would load a table of all HTML entities in the browser."""
    return content.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def text(position: Point, content: str, style: str = "", anchor: str = "start") -> str:
    """A label; ``anchor`` is start, middle or end. The content is escaped."""
    x, y = coordinate(position[0]), coordinate(position[1])
    below = ground(position, content, style, anchor)
    words = escaped(content)
    return f'{below}<text class="{style}" x="{x}" y="{y}" text-anchor="{anchor}">{words}</text>'


def ground(position: Point, content: str, style: str = "", anchor: str = "start") -> str:
    """The ground of a label whose style is ``ground``; its sizes are relative to the letters."""
    classes = style.split()
    if "ground" not in classes or not content:
        return ""
    words = width_em(content, strong="strong" in classes)
    left, width = -BEFORE[anchor] * words - GROUND_PAD_EM, words + 2 * GROUND_PAD_EM
    x, y = coordinate(position[0]), coordinate(position[1])
    sizes = " ".join(
        ("ground", *(size for size in ("small", "large", "italic") if size in classes))
    )
    return (
        f'<rect class="{sizes}" transform="translate({x} {y})" x="{left:.2f}em" y="-0.98em"'
        f' width="{width:.2f}em" height="1.32em" rx="0.3em"/>'
    )


def arrow(start: Point, end: Point, style: str = "", head: float = 8.0) -> str:
    """A line with a filled head at ``end``; without the head if the line is shorter than that."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    if length <= head:
        return line(start, end, style)
    ux, uy = dx / length, dy / length
    neck = (x, y) = (end[0] - head * ux, end[1] - head * uy)
    aside, down = head * 0.38 * uy, head * 0.38 * ux
    corners = (end, (x - aside, y + down), (x + aside, y - down))
    return line(start, neck, style) + polygon(corners, f"{style} solid".strip())


def group(children: Iterable[str], style: str = "") -> str:
    return f'<g class="{style}">{"".join(children)}</g>'
