"""Labels with indices, dimension lines, arcs and lenses, by the rules of
`simulations.engine.drawing`: view box units, x right, y down; ``style`` is a list of CSS classes.
Angles are counter-clockwise as seen, from the right.
"""

import math
from base64 import b64encode
from collections.abc import Iterable, Sequence

import numpy as np

from simulations.engine.drawing import (
    Point,
    arrow,
    coordinate,
    escaped,
    ground,
    path,
    point_list,
    polygon,
    polyline,
)
from simulations.engine.frame import Raster
from simulations.engine.letters import SCRIPT, SCRIPT_SIZE
from simulations.engine.raster import png

HEIGHTS = {"_": ("sub", 0.22), "^": ("super", -0.37)}
"""Class of a script, and its distance below the baseline in letter heights of the label."""


def label(position: Point, content: str, style: str = "", anchor: str = "start") -> str:
    """A text in which ``_`` lowers and ``^`` raises the next character or ``{group}``."""
    x, y = coordinate(position[0]), coordinate(position[1])
    below = ground(position, content, style, anchor)
    words = _spans(content)
    return f'{below}<text class="{style}" x="{x}" y="{y}" text-anchor="{anchor}">{words}</text>'


def _spans(content: str) -> str:
    parts, rest, height = [], 0, 0.0
    for found in SCRIPT.finditer(content):
        if plain := content[rest : found.start()]:
            parts.append(_span(plain, "", -height))
            height = 0.0
        kind, target = HEIGHTS[found[1]]
        parts.append(_span(found[2] or found[3], kind, (target - height) / SCRIPT_SIZE))
        rest, height = found.end(), target
    return "".join([*parts, _span(content[rest:], "", -height)])


def _span(content: str, kind: str, down_em: float) -> str:
    """Words shifted down by so many of their own letter heights."""
    words = escaped(content)
    if not words or not (kind or down_em):
        return words
    style = f' class="{kind}"' if kind else ""
    return f'<tspan{style} dy="{coordinate(down_em)}em">{words}</tspan>'


def swatch(corner: Point, width: float, height: float, srgb: Sequence[float]) -> str:
    """A rectangle in a computed colour, 0 to 1, the same in all themes."""
    x, y, w, h = (coordinate(value) for value in (corner[0], corner[1], width, height))
    return f'<rect class="swatch" x="{x}" y="{y}" width="{w}" height="{h}" fill="{_hex(srgb)}"/>'


def swatch_polygon(points: Iterable[Point], srgb: Sequence[float]) -> str:
    """A polygon in a computed colour, the same in all themes."""
    return f'<polygon class="swatch" points="{point_list(points)}" fill="{_hex(srgb)}"/>'


def picture(corner: Point, width: float, height: float, raster: Raster) -> str:
    """A raster (H, W, 4) over a rectangle, its pixels as squares, the same in all themes."""
    x, y, w, h = (coordinate(value) for value in (corner[0], corner[1], width, height))
    data = f"data:image/png;base64,{b64encode(png(raster)).decode()}"
    size = f'x="{x}" y="{y}" width="{w}" height="{h}" preserveAspectRatio="none"'
    return f'<image class="pixelated" {size} href="{data}"/>'


def tinted(children: Iterable[str], srgb: Sequence[float]) -> str:
    """Drawings without a role, all in a computed colour, the same in all themes."""
    return f'<g color="{_hex(srgb)}">{"".join(children)}</g>'


def _hex(srgb: Sequence[float]) -> str:
    red, green, blue = (round(255 * min(max(float(value), 0.0), 1.0)) for value in srgb)
    return f"#{red:02x}{green:02x}{blue:02x}"


def polar(centre: Point, radius: float, angle_rad: float) -> tuple[float, float]:
    """The point at a distance and an angle from ``centre``."""
    return (
        float(centre[0]) + radius * math.cos(angle_rad),
        float(centre[1]) - radius * math.sin(angle_rad),
    )


def arc(centre: Point, radius: float, start_rad: float, end_rad: float, style: str = "") -> str:
    """An open arc of a circle, in steps of at most 3°."""
    steps = max(2, math.ceil(abs(end_rad - start_rad) / math.radians(3)))
    angles = np.linspace(start_rad, end_rad, steps + 1)
    return polyline([polar(centre, radius, float(angle)) for angle in angles], style)


def double_arrow(start: Point, end: Point, style: str = "", head: float = 7.0) -> str:
    """A line with a head at each end."""
    middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
    return arrow(middle, start, style, head) + arrow(middle, end, style, head)


def dimension(start: Point, end: Point, style: str = "") -> str:
    """A dimension line: arrow heads at both ends, each at a short cross stroke."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    across = (-5.0 * dy / length, 5.0 * dx / length)
    strokes = [
        [(place[0] - across[0], place[1] - across[1]), (place[0] + across[0], place[1] + across[1])]
        for place in (start, end)
    ]
    return double_arrow(start, end, f"{style} thin", 6.0) + path(strokes, f"{style} thin")


def glass(centre: Point, half_height: float, half_width: float, style: str = "camera fill") -> str:
    """A lens of two equal faces, seen from the side."""
    x, y = float(centre[0]), float(centre[1])
    radius = (half_height**2 + half_width**2) / (2 * half_width)
    heights = np.linspace(-half_height, half_height, 33)
    bulge = np.sqrt(radius**2 - heights**2) - (radius - half_width)
    right = [(x + b, y + h) for b, h in zip(bulge, heights, strict=True)]
    return polygon([*right, *((2 * x - px, py) for px, py in reversed(right))], style)


def box(corner: Point, width: float, height: float, radius: float = 3.0, style: str = "") -> str:
    """A rectangle with rounded corners."""
    x, y, w, h, r = (coordinate(v) for v in (corner[0], corner[1], width, height, radius))
    return f'<rect class="{style}" x="{x}" y="{y}" width="{w}" height="{h}" rx="{r}"/>'
