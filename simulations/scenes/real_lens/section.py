"""The first panel: the lens cut along its axis, to one scale, and the rays through it."""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from simulations.engine.drawing import Point, dot, line, path, polygon, polyline, text
from simulations.models.arrays import Floats
from simulations.models.lens.singlet import (
    LEAVES_BY_RIM,
    MISSES,
    PASSES,
    REFLECTED,
    Rays,
    sag_mm,
)
from simulations.scenes.real_lens.settings import Settings
from simulations.scenes.real_lens.stages import Glass

WIDTH, HEIGHT = 400.0, 300.0
PER_MM = 2.5
MIDDLE = (WIDTH / 2, HEIGHT / 2)
HALF_MM = (WIDTH / 2 / PER_MM, HEIGHT / 2 / PER_MM)
MARK_MM = 12.0
"""How far from the axis the surfaces can be grabbed."""
ENTRY_MM = 20.0
"""How far before the middle the marked ray can."""
BLADE_MM = 25.0
FATES = {
    MISSES: "misses the glass",
    REFLECTED: "totally reflected",
    LEAVES_BY_RIM: "runs into the rim",
}


def at(along_mm: float, height_mm: float) -> tuple[float, float]:
    return MIDDLE[0] + PER_MM * float(along_mm), MIDDLE[1] - PER_MM * float(height_mm)


def millimetres(place: Point) -> tuple[float, float]:
    """The inverse of `at`."""
    return (float(place[0]) - MIDDLE[0]) / PER_MM, (MIDDLE[1] - float(place[1])) / PER_MM


def draw(settings: Settings, glass: Glass, fan: Rays, marked: Rays, heights: Floats) -> str:
    """The glass, the opening, the fan of rays, and the marked one over them."""
    height = np.array([settings.height])
    return "".join(
        (
            line((4, MIDDLE[1]), (WIDTH - 4, MIDDLE[1]), "muted thin dashed"),
            polygon(outline(glass), "camera fill"),
            path(ways(glass, fan, heights), "light thin"),
            *_failures(fan, heights, glass, small=True),
            path(ways(glass, marked, height), "ray bold"),
            *_failures(marked, height, glass, small=False),
            *_normals(glass, marked),
            *_stop(settings.opening),
            *_marks(settings, glass),
            *_image(glass),
        )
    )


def entry_mark(settings: Settings, glass: Glass) -> tuple[float, float]:
    """On the marked ray, before the lens."""
    return at(-ENTRY_MM, settings.height * _narrowed(glass))


def height_of(place: Point, distance_mm: float) -> float:
    return millimetres(place)[1] / (1.0 - ENTRY_MM / distance_mm)


def surface_mark(settings: Settings, *, front: bool) -> tuple[float, float]:
    """Below the axis on one of the surfaces."""
    bulge = settings.front if front else -settings.back
    vertex = settings.thickness / (-2.0 if front else 2.0)
    return at(vertex + float(sag_mm(bulge / 1000.0, MARK_MM)), -MARK_MM)


def bulge_of(place: Point, thickness: float, *, front: bool) -> float:
    """In 1/m, outwards: of the sphere through the vertex and a point at the mark's height."""
    along = millimetres(place)[0]
    sag = along + thickness / 2.0 if front else thickness / 2.0 - along
    return 2000.0 * sag / (sag * sag + MARK_MM**2)


def opening_mark(opening: float) -> tuple[float, float]:
    """Its lower edge."""
    return at(0.0, -opening)


def object_mark(distance: float) -> tuple[float, float]:
    return at(-distance, 0.0)


def outline(glass: Glass) -> list[tuple[float, float]]:
    """Of the lens."""
    lens, half = glass.lens, glass.lens.thickness_mm / 2.0
    heights = np.linspace(-glass.rim_mm, glass.rim_mm, 41)
    front = sag_mm(lens.front_per_mm, heights) - half
    back = sag_mm(lens.back_per_mm, heights) + half
    there = [at(x, h) for x, h in zip(front, heights, strict=True)]
    return there + [at(x, h) for x, h in zip(back[::-1], heights[::-1], strict=True)]


def ways(glass: Glass, rays: Rays, heights: Floats) -> list[list[tuple[float, float]]]:
    """Each ray from the left to where it ends, or to the border of the panel."""
    drawn = []
    for front, back, slope, height in zip(rays.front, rays.back, rays.slope, heights, strict=True):
        places = [_start(glass, float(height))]
        places += [(float(x), float(y)) for x, y in (front, back) if math.isfinite(x)]
        if math.isfinite(slope):
            places.append(_border(places[-1], float(slope)))
        elif len(places) == 1:
            places.append(_border((0.0, float(height)), float(height) / glass.distance_mm))
        drawn.append([at(*place) for place in places])
    return drawn


def _narrowed(glass: Glass) -> float:
    """Height of a ray where it can be grabbed, to that in the middle."""
    return 1.0 - ENTRY_MM / glass.distance_mm


def _start(glass: Glass, height: float) -> tuple[float, float]:
    if glass.distance_mm <= HALF_MM[0]:
        return -glass.distance_mm, 0.0
    return -HALF_MM[0], height * (1.0 - HALF_MM[0] / glass.distance_mm)


def _border(place: tuple[float, float], slope: float) -> tuple[float, float]:
    """Where a line from there to the right leaves the panel."""
    x, y = place
    along = HALF_MM[0] - x
    if abs(y + slope * along) > HALF_MM[1]:
        along = max((math.copysign(HALF_MM[1], slope) - y) / slope, 0.0)
    return x + along, y + slope * along


def _failures(rays: Rays, heights: Floats, glass: Glass, *, small: bool) -> Iterator[str]:
    """A mark where a ray ends, and for the marked one the reason."""
    for fate, front, back, height in zip(rays.fate, rays.front, rays.back, heights, strict=True):
        if fate == PASSES:
            continue
        places = [place for place in (back, front) if math.isfinite(place[0])]
        place = places[0] if places else (0.0, float(height))
        yield dot(at(*place), "error", 2.5 if small else 4)
        if not small:
            above = at(0.0, min(max(glass.rim_mm, float(height)) + 6.0, HALF_MM[1] - 6.0))
            yield text(above, FATES[int(fate)], "error halo", "middle")


def _normals(glass: Glass, marked: Rays) -> Iterator[str]:
    """Through each place where the marked ray is bent, at a right angle to the glass."""
    curvatures = (glass.lens.front_per_mm, glass.lens.back_per_mm)
    vertices = (-glass.lens.thickness_mm / 2.0, glass.lens.thickness_mm / 2.0)
    for place, c, vertex in zip(
        (marked.front[0], marked.back[0]), curvatures, vertices, strict=True
    ):
        x, y = (float(value) for value in place)
        # Only what meets the sphere itself has a normal there; the simple models bend at planes.
        if math.isfinite(x) and abs(c * ((x - vertex) ** 2 + y * y) - 2.0 * (x - vertex)) < 1e-6:
            across, up = 1.0 - c * (x - vertex), -c * y
            ends: Sequence[tuple[float, float]] = [
                (x + side * 7.0 * across, y + side * 7.0 * up) for side in (-1, 1)
            ]
            yield polyline([at(*end) for end in ends], "muted thin dashed")


def _stop(opening: float) -> Iterator[str]:
    for side in (-1, 1):
        yield line(at(0.0, side * opening), at(0.0, side * BLADE_MM), "bold")
    yield dot(opening_mark(opening))


def _marks(settings: Settings, glass: Glass) -> Iterator[str]:
    for front in (True, False):
        yield dot(surface_mark(settings, front=front), "camera", 5)
    yield dot(entry_mark(settings, glass), "ray", 5)
    x, y = entry_mark(settings, glass)
    yield text((x - 4, y - 9), "h", "ray italic halo", "end")
    if glass.distance_mm <= HALF_MM[0]:
        yield dot(object_mark(glass.distance_mm), "world", 5)
    yield text(at(0.0, -BLADE_MM - 6.0), "opening", "halo", "middle")


def _image(glass: Glass) -> Iterator[str]:
    """Where the simple models have it."""
    for place, style, row in ((glass.thin_mm, "muted", 18.0), (glass.paraxial_mm, "image", -9.0)):
        if 0.0 < place <= HALF_MM[0]:
            x = at(place, 0.0)[0]
            yield line((x, MIDDLE[1] - 7), (x, MIDDLE[1] + 7), f"{style} bold")
            name = "thin" if style == "muted" else "thick"
            yield text((min(x, WIDTH - 16), MIDDLE[1] + row), name, f"{style} small halo", "middle")
