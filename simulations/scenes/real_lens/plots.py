"""The second and third panel: the rays close to the image, and where each crosses the axis.

Both show the same piece of the axis, so that what lies above one another in their columns is the
same place.
"""

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from simulations.engine.drawing import Point, dot, line, path, text
from simulations.engine.frame import format_number
from simulations.models.arrays import Floats
from simulations.models.lens.singlet import Rays
from simulations.scenes.real_lens.stages import HEIGHTS_MM, Glass

WIDTH = 400.0
LEFT, RIGHT, TOP, FLOOR = 40.0, 388.0, 26.0, 240.0
BEFORE_MM, BEHIND_MM = 20.0, 9.0
"""How much of the axis is shown on either side of the thick lens's image."""
ASIDE_MM = 3.0
"""How far from the axis the second panel reaches."""
HIGHEST_MM = 20.0


def column(glass: Glass, along_mm: float) -> float | None:
    """Of a place on the axis; None outside the plots, or where there is no image."""
    if not glass.real:
        return None
    share = (along_mm - glass.paraxial_mm + BEFORE_MM) / (BEFORE_MM + BEHIND_MM)
    return LEFT + (RIGHT - LEFT) * share if 0.0 <= share <= 1.0 else None


def row(height_mm: float) -> float:
    """Of a ray's height, in the third panel."""
    return FLOOR - (FLOOR - TOP) * height_mm / HIGHEST_MM


def height_at(place: Point) -> float:
    """The inverse of `row`."""
    return HIGHEST_MM * (FLOOR - float(place[1])) / (FLOOR - TOP)


def close(glass: Glass, fan: Rays, marked: Rays) -> str:
    """The rays around the image; heights are drawn larger than lengths."""
    middle = 0.5 * (TOP + FLOOR)
    parts = [
        *_frame(glass),
        line((LEFT, middle), (RIGHT, middle), "muted thin dashed"),
        text((LEFT - 28, TOP - 10), "mm from the axis", "small"),
    ]
    if glass.real:
        parts += [
            path(_close_ways(glass, fan), "light thin"),
            path(_close_ways(glass, marked), "ray bold"),
            *_models(glass),
            *_crossing(glass, marked, middle),
        ]
        for up in (-2, 2):
            y = middle - up * (FLOOR - TOP) / (2.0 * ASIDE_MM)
            parts.append(text((LEFT - 6, y + 4), format_number(up, 0), "muted small", "end"))
    return "".join(parts)


def aberration(glass: Glass, curve: Floats, height: float, marked: Rays, opening: float) -> str:
    """Where rays cross the axis, by their height: a real lens, and the two lines of the models."""
    parts = [*_frame(glass)]
    for tick in (0, 5, 10, 15, 20):
        parts.append(text((LEFT - 6, row(tick) + 4), f"{tick}", "muted small", "end"))
    parts.append(line((LEFT, row(opening)), (RIGHT, row(opening)), "thin dashed"))
    parts.append(text((RIGHT, row(opening) - 5), "opening", "small halo", "end"))
    if glass.real:
        parts += [*_models(glass), path(_stretches(glass, curve), "light bold")]
    parts += [*_crossing(glass, marked, row(height))]
    parts.append(text((LEFT - 28, TOP - 10), "height h, mm", "small"))
    return "".join(parts)


def mark(glass: Glass, marked: Rays, height: float) -> tuple[float, float]:
    """Of the marked ray in the third panel: on the axis of heights where it does not cross."""
    place = _column_of(glass, marked)
    return (LEFT if place is None else place, row(height))


def _column_of(glass: Glass, marked: Rays) -> float | None:
    along = float(marked.crossing_mm[0])
    return column(glass, along) if math.isfinite(along) else None


def _frame(glass: Glass) -> Iterator[str]:
    yield path([[(LEFT, TOP), (LEFT, FLOOR), (RIGHT, FLOOR)]], "muted")
    if not glass.real:
        middle = (0.5 * (LEFT + RIGHT), 0.5 * (TOP + FLOOR) - 16)
        yield text(middle, "no image behind this lens", "error halo", "middle")
        return
    first = math.ceil((glass.paraxial_mm - BEFORE_MM) / 5.0)
    last = math.floor((glass.paraxial_mm + BEHIND_MM) / 5.0)
    for tick in range(first, last + 1):
        x = column(glass, 5.0 * tick)
        if x is not None:
            yield line((x, FLOOR), (x, FLOOR + 5), "muted thin")
            yield text((x, FLOOR + 20), f"{5 * tick}", "muted small", "middle")
    yield text((RIGHT, FLOOR + 42), "mm behind the lens’s middle", "small", "end")


def _models(glass: Glass) -> Iterator[str]:
    """The images of the thin lens and of the thick one."""
    names = (("thin", glass.thin_mm, "muted"), ("thick", glass.paraxial_mm, "image"))
    for name, along, role in names:
        x = column(glass, along)
        if x is not None:
            yield line((x, TOP), (x, FLOOR), f"{role} dashed")
            side = "end" if glass.thin_mm < glass.paraxial_mm else "start"
            anchor = side if name == "thin" else {"end": "start", "start": "end"}[side]
            shift = 4 if anchor == "start" else -4
            yield text((x + shift, FLOOR - 6), name, f"{role} small halo", anchor)


def _crossing(glass: Glass, marked: Rays, y: float) -> Iterator[str]:
    x = _column_of(glass, marked)
    if x is not None:
        yield dot((x, y), "ray", 5)


def _close_ways(glass: Glass, rays: Rays) -> list[list[tuple[float, float]]]:
    """Of each ray the piece that lies in the second panel."""
    middle, per_mm = 0.5 * (TOP + FLOOR), (FLOOR - TOP) / (2.0 * ASIDE_MM)
    first = max(glass.paraxial_mm - BEFORE_MM, glass.lens.thickness_mm / 2.0)
    last = glass.paraxial_mm + BEHIND_MM
    pieces = []
    for (x, y), slope in zip(rays.back, rays.slope, strict=True):
        if not math.isfinite(slope):
            continue
        start, end = max(first, float(x)), last
        if abs(slope) > 1e-12:
            bounds = sorted(
                float(x) + (side * ASIDE_MM - float(y)) / float(slope) for side in (-1, 1)
            )
            start, end = max(start, bounds[0]), min(end, bounds[1])
        elif abs(y) > ASIDE_MM:
            continue
        if end > start:
            ends = [(column(glass, a), float(y + slope * (a - x))) for a in (start, end)]
            pieces.append([(c, middle - per_mm * h) for c, h in ends if c is not None])
    return [piece for piece in pieces if len(piece) == 2]


def _stretches(glass: Glass, curve: Floats) -> list[list[tuple[float, float]]]:
    """The pieces of the curve that lie in the plot."""
    places = [
        (column(glass, along) if np.isfinite(along) else None, row(height))
        for along, height in zip(curve.tolist(), HEIGHTS_MM.tolist(), strict=True)
    ]
    return [
        [(one[0], one[1]), (other[0], other[1])]
        for one, other in pairwise(places)
        if one[0] is not None and other[0] is not None
    ]
