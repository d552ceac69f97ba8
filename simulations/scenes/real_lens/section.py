"""The first panel: the lens cut along its axis, to one scale, and the rays through it."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

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
from simulations.scenes.real_lens.stages import Glass, fan_heights

WIDTH, HEIGHT = 400.0, 300.0
AXIS_Y = HEIGHT / 2
MARK_MM = 16.0
"""Distance of the surfaces' handles from the axis: near the rim, where the glass moves far."""
ENTRY_MM = 20.0
"""Distance of the marked ray's handle before the middle."""
BLADE_MM = 25.0
FATES = {
    MISSES: "misses the glass",
    REFLECTED: "totally reflected",
    LEAVES_BY_RIM: "runs into the rim",
}
STOPPED = "stopped by the opening"


@dataclass(frozen=True, slots=True)
class View:
    """Length of the axis in the panel."""

    per_mm: float
    lens_x: float
    """Column of the lens's middle."""

    @property
    def left_mm(self) -> float:
        return -self.lens_x / self.per_mm

    @property
    def right_mm(self) -> float:
        return (WIDTH - self.lens_x) / self.per_mm

    @property
    def up_mm(self) -> float:
        return AXIS_Y / self.per_mm

    def at(self, along_mm: float, height_mm: float) -> tuple[float, float]:
        return (
            self.lens_x + self.per_mm * float(along_mm),
            AXIS_Y - self.per_mm * float(height_mm),
        )

    def millimetres(self, place: Point) -> tuple[float, float]:
        """The inverse of `at`."""
        return (
            (float(place[0]) - self.lens_x) / self.per_mm,
            (AXIS_Y - float(place[1])) / self.per_mm,
        )


CLOSE, WIDE = View(4.2, 130.0), View(2.5, 200.0)
"""The view for distant light, and for an object within the panel."""


def view_of(distance_mm: float) -> View:
    return WIDE if distance_mm <= -WIDE.left_mm else CLOSE


def draw(settings: Settings, glass: Glass, fan: Rays, marked: Rays, heights: Floats) -> str:
    """The glass, the opening, the fan of rays, and the marked one over them."""
    view, height = view_of(glass.distance_mm), np.array([settings.height])
    return "".join(
        (
            line((4, AXIS_Y), (WIDTH - 4, AXIS_Y), "muted thin dashed"),
            polygon(outline(view, glass), "camera fill"),
            path(ways(view, glass, fan, heights), "light thin"),
            *_failures(view, fan, heights, glass, small=True),
            *_stop(view, settings.opening),
            *_marked(view, settings, glass, marked, height),
            *_normals(view, glass, marked),
            *_marks(view, settings, glass),
            *_image(view, glass),
        )
    )


def stopped(settings: Settings, ray: Rays) -> bool:
    """Whether the marked ray reaches the glass but not the opening."""
    return settings.height > settings.opening and ray.fate[0] != MISSES


def _marked(
    view: View, settings: Settings, glass: Glass, marked: Rays, height: Floats
) -> Iterator[str]:
    """The marked ray: to its end, or to the opening if that stops it."""
    (way,) = ways(view, glass, marked, height)
    if not stopped(settings, marked):
        yield path([way], "ray bold")
        yield from _failures(view, marked, height, glass, small=False)
        return
    end = (view.lens_x, float(np.interp(view.lens_x, *np.transpose(way))))
    yield path([[*(place for place in way if place[0] < view.lens_x), end]], "ray bold")
    yield dot(end, "error", 4)
    yield _reason(view, glass, float(height[0]), STOPPED)


def _reason(view: View, glass: Glass, height: float, words: str) -> str:
    """Why the marked ray ends, above the lens."""
    above = view.at(0.0, min(max(glass.rim_mm, height, BLADE_MM) + 4.0, view.up_mm - 4.0))
    return text(above, words, "error ground", "middle")


def entry_mark(view: View, height: float, distance_mm: float) -> tuple[float, float]:
    """The handle on the marked ray, before the lens."""
    return view.at(-ENTRY_MM, height * (1.0 - ENTRY_MM / distance_mm))


def height_of(view: View, place: Point, distance_mm: float) -> float:
    return view.millimetres(place)[1] / (1.0 - ENTRY_MM / distance_mm)


def surface_mark(view: View, settings: Settings, *, front: bool) -> tuple[float, float]:
    """The handle of a surface: of the front below the axis, of the back above."""
    bulge = settings.front if front else settings.back
    along = settings.thickness / 2.0 - float(sag_mm(bulge / 1000.0, MARK_MM))
    return view.at(-along, -MARK_MM) if front else view.at(along, MARK_MM)


def bulge_of(view: View, place: Point, thickness: float, *, front: bool) -> float:
    """Curvature in 1/m, positive outwards, of the sphere through the vertex and a point at the
    handle's height."""
    along = view.millimetres(place)[0]
    sag = thickness / 2.0 + (along if front else -along)
    return 2000.0 * sag / (sag * sag + MARK_MM**2)


def object_mark(distance_mm: float) -> tuple[float, float] | None:
    """The object, if it is within the panel."""
    view = view_of(distance_mm)
    return view.at(-distance_mm, 0.0) if -distance_mm >= view.left_mm else None


def object_of(place: Point) -> float:
    """The object's distance at a place, at most that of the wide view."""
    return min(max(-WIDE.millimetres(place)[0], 1.0), -WIDE.left_mm)


def outline(view: View, glass: Glass) -> list[tuple[float, float]]:
    """The outline of the lens."""
    lens, half = glass.lens, glass.lens.thickness_mm / 2.0
    heights = np.linspace(-glass.rim_mm, glass.rim_mm, 41)
    front = sag_mm(lens.front_per_mm, heights) - half
    back = sag_mm(lens.back_per_mm, heights) + half
    there = [view.at(x, h) for x, h in zip(front, heights, strict=True)]
    return there + [view.at(x, h) for x, h in zip(back[::-1], heights[::-1], strict=True)]


def ways(view: View, glass: Glass, rays: Rays, heights: Floats) -> list[list[tuple[float, float]]]:
    """Each ray from the left to its end, or to the border of the panel."""
    drawn = []
    for front, back, slope, height in zip(rays.front, rays.back, rays.slope, heights, strict=True):
        places = [_start(view, glass, float(height))]
        places += [(float(x), float(y)) for x, y in (front, back) if math.isfinite(x)]
        if math.isfinite(slope):
            places.append(_border(view, places[-1], float(slope)))
        elif len(places) == 1:
            places.append(_border(view, (0.0, float(height)), float(height) / glass.distance_mm))
        drawn.append([view.at(*place) for place in places])
    return drawn


def _start(view: View, glass: Glass, height: float) -> tuple[float, float]:
    if -glass.distance_mm >= view.left_mm:
        return -glass.distance_mm, 0.0
    return view.left_mm, height * (1.0 + view.left_mm / glass.distance_mm)


def _border(view: View, place: tuple[float, float], slope: float) -> tuple[float, float]:
    """The point where a line to the right leaves the panel."""
    x, y = place
    along = view.right_mm - x
    if abs(y + slope * along) > view.up_mm:
        along = max((math.copysign(view.up_mm, slope) - y) / slope, 0.0)
    return x + along, y + slope * along


def _failures(
    view: View, rays: Rays, heights: Floats, glass: Glass, *, small: bool
) -> Iterator[str]:
    """A mark where a ray ends, and for the marked one the reason."""
    for fate, front, back, height in zip(rays.fate, rays.front, rays.back, heights, strict=True):
        if fate == PASSES:
            continue
        places = [place for place in (back, front) if math.isfinite(place[0])]
        place = places[0] if places else (0.0, float(height))
        yield dot(view.at(*place), "error", 2.5 if small else 4)
        if not small:
            yield _reason(view, glass, float(height), FATES[int(fate)])


def _normals(view: View, glass: Glass, marked: Rays) -> Iterator[str]:
    """The normals of the glass at the points where the marked ray is refracted."""
    curvatures = (glass.lens.front_per_mm, glass.lens.back_per_mm)
    vertices = (-glass.lens.thickness_mm / 2.0, glass.lens.thickness_mm / 2.0)
    for place, c, vertex in zip(
        (marked.front[0], marked.back[0]), curvatures, vertices, strict=True
    ):
        x, y = (float(value) for value in place)
        # Only rays that meet the sphere have a normal; the simple models refract at planes.
        if math.isfinite(x) and abs(c * ((x - vertex) ** 2 + y * y) - 2.0 * (x - vertex)) < 1e-6:
            across, up = 1.0 - c * (x - vertex), -c * y
            ends: Sequence[tuple[float, float]] = [
                (x + side * 7.0 * across, y + side * 7.0 * up) for side in (-1, 1)
            ]
            yield polyline([view.at(*end) for end in ends], "muted thin dashed")


def _stop(view: View, opening: float) -> Iterator[str]:
    for side in (-1, 1):
        yield line(view.at(0.0, side * opening), view.at(0.0, side * BLADE_MM), "bold")


def _marks(view: View, settings: Settings, glass: Glass) -> Iterator[str]:
    for front in (True, False):
        mark = surface_mark(view, settings, front=front)
        if glass.rim_mm < MARK_MM:
            yield polyline(_beyond_rim(view, glass, front=front), "camera thin dashed")
        yield dot(mark, "camera", 5)
        aside, anchor = (-13.0, "end") if front else (13.0, "start")
        row = mark[1] + (14.0 if front else -6.0)
        yield text((mark[0] + aside, row), "front" if front else "back", "camera small", anchor)
    entry = entry_mark(view, settings.height, glass.distance_mm)
    yield dot(entry, "ray", 5)
    foot = (entry[0], AXIS_Y)
    yield line(entry, foot, "ray thin")
    gaps = np.convolve(fan_heights(settings.opening), (0.5, 0.5), "valid")
    gap = float(gaps[np.abs(gaps - 0.5 * settings.height).argmin()])
    row = entry_mark(view, gap, glass.distance_mm)[1]
    yield text((entry[0] - 5, row + 4), "h", "ray italic", "end")
    thing = object_mark(glass.distance_mm)
    if thing:
        yield dot(thing, "world", 5)
    yield text(view.at(0.0, -BLADE_MM - 5.0), "opening", "ground", "middle")


def _beyond_rim(view: View, glass: Glass, *, front: bool) -> list[tuple[float, float]]:
    """A surface from the rim to its handle."""
    lens, side = glass.lens, -1.0 if front else 1.0
    heights = side * np.linspace(glass.rim_mm, MARK_MM, 9)
    sags = sag_mm(lens.front_per_mm if front else lens.back_per_mm, heights)
    middle = side * lens.thickness_mm / 2.0
    return [view.at(middle + s, h) for s, h in zip(sags, heights, strict=True)]


def _image(view: View, glass: Glass) -> Iterator[str]:
    """The image in the simple models, named above the rays."""
    names = (
        ("thin lens", glass.thin_mm, "muted", 70.0),
        ("thick lens", glass.paraxial_mm, "image", 86.0),
    )
    for name, place, style, row in names:
        if 0.0 < place <= view.right_mm:
            x = view.at(place, 0.0)[0]
            yield line((x, AXIS_Y + 7), (x, AXIS_Y - row), f"{style} thin")
            yield line((x, AXIS_Y - 7), (x, AXIS_Y + 7), f"{style} bold")
            yield text((x - 5.0, AXIS_Y - row + 9.0), name, f"{style} small ground", "end")
