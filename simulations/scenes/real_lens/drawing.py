"""The panels of a real lens: the lens cut along its axis, to one scale, with the rays through it;
the spot that they make on a sheet at the image; and where each crosses the axis."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from simulations.engine.drawing import cased, dot, line, path, polygon, polyline, text
from simulations.engine.frame import Raster
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.engine.raster import of_planes
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb_codes
from simulations.models.lens import singlet
from simulations.models.lens.singlet import Rays, sag_mm

WIDTH, HEIGHT = 400.0, 300.0
AXIS_Y = HEIGHT / 2
MARK_MM = 16.0  # from the axis to the surfaces' handles: near the rim, where the glass moves far
ENTRY_MM = 20.0  # from the middle back to the marked ray's handle
BLADE_MM = 25.0
FAN = 5  # rays drawn above the axis, and as many below
FATES = {
    singlet.MISSES: "misses the glass",
    singlet.REFLECTED: "totally reflected",
    singlet.LEAVES_BY_RIM: "runs into the rim",
}
STOPPED = "stopped by the opening"

LEFT, RIGHT, TOP, FLOOR = 40.0, 388.0, 26.0, 240.0
BEFORE_MM, BEHIND_MM = 20.0, 9.0  # of the axis, on either side of the thick lens's image
SPOT_PER_MM = 60.0  # view box units, of the sheet in the second panel
RINGS = 4_000  # of the opening, whose light is counted on the sheet
BRIGHT = 250.0
"""Light on the sheet that is shown at 63 % of white, as a multiple of that in the opening."""
HEIGHTS = Axis(0.0, 20.0, FLOOR, TOP)  # of rays in the third panel, mm
HEIGHTS_MM = np.linspace(0.25, 20.0, 80)  # of the curve of aberration
ALONG = Scale("mm behind the lens’s middle", ticks=4, style="small", tick_style="muted small")


@dataclass(frozen=True, slots=True)
class Glass:
    """The lens, and its image in simpler models."""

    lens: singlet.Singlet
    rim_mm: float
    distance_mm: float  # distance of the object; inf for parallel light
    thin_mm: float
    paraxial_mm: float
    """Place of the image on the axis behind the lens's middle; negative or infinite if there is
    none."""

    @property
    def real(self) -> bool:
        """Whether the thick lens has an image behind it."""
        return self.lens.thickness_mm / 2.0 < self.paraxial_mm < math.inf


@dataclass(frozen=True, slots=True)
class Section:
    """The part of the axis in the first panel."""

    per_mm: float
    lens_x: float  # column of the lens's middle

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
        return self.lens_x + self.per_mm * float(along_mm), AXIS_Y - self.per_mm * float(height_mm)


CLOSE, WIDE = Section(4.2, 130.0), Section(2.5, 200.0)
"""For distant light, and for an object within the panel."""


def section_for(distance_mm: float) -> Section:
    return WIDE if distance_mm <= -WIDE.left_mm else CLOSE


def fan_heights(opening: float) -> Floats:
    """Heights (n,) evenly spaced over the opening, without the axis."""
    upper = opening * np.arange(1, FAN + 1) / FAN
    return np.concatenate((-upper[::-1], upper))


def is_stopped(height: float, opening: float, ray: Rays) -> bool:
    """Whether the marked ray reaches the glass but not the opening."""
    return height > opening and bool(ray.fate[0] != singlet.MISSES)


def from_side(glass: Glass, fan: Rays, marked: Rays, height: float, opening: float) -> str:
    """The glass, the opening, the fan of rays, and the marked one over them."""
    view, heights = section_for(glass.distance_mm), fan_heights(opening)
    rays = ray_polylines(view, glass, fan, heights)
    return "".join(
        (
            line((4, AXIS_Y), (WIDTH - 4, AXIS_Y), "muted thin dashed"),
            polygon(outline(view, glass), "camera fill"),
            path(rays, "light bold faint"),  # a glow
            path(rays, "light thin"),
            *failures(view, fan, heights, 2.5),
            *(
                line(view.at(0.0, side * opening), view.at(0.0, side * BLADE_MM), "bold")
                for side in (-1, 1)
            ),
            *draw_marked_ray(view, glass, marked, height, opening),
            *normals(view, glass, marked),
            *marks(view, glass, height, opening),
            *images(view, glass),
        )
    )


def draw_marked_ray(
    view: Section, glass: Glass, marked: Rays, height: float, opening: float
) -> Iterator[str]:
    """The marked ray to its end, or to the opening if that stops it, and why it ends."""
    (points,) = ray_polylines(view, glass, marked, np.array([height]))
    fate, words = int(marked.fate[0]), STOPPED
    if is_stopped(height, opening, marked):
        end = (view.lens_x, float(np.interp(view.lens_x, *np.transpose(points))))
        yield path([[*(place for place in points if place[0] < view.lens_x), end]], "ray bold")
        yield dot(end, "error", 4)
    else:
        yield path([points], "ray bold")
        yield from failures(view, marked, np.array([height]), 4)
        words = FATES.get(fate, "")
    if words:
        above = view.at(0.0, min(max(glass.rim_mm, height, BLADE_MM) + 4.0, view.up_mm - 4.0))
        yield text(above, words, "error ground", "middle")


def entry_mark(distance_mm: float, height: float) -> tuple[float, float]:
    """The handle on the marked ray, before the lens."""
    return section_for(distance_mm).at(-ENTRY_MM, height * (1.0 - ENTRY_MM / distance_mm))


def surface_mark(
    distance_mm: float, bulge: float, thickness: float, *, front: bool
) -> tuple[float, float]:
    """The handle of a surface, whose curvature is in 1/m, positive outwards: of the front below
    the axis, of the back above."""
    along = thickness / 2.0 - float(sag_mm(bulge / 1000.0, MARK_MM))
    side = -1.0 if front else 1.0
    return section_for(distance_mm).at(side * along, side * MARK_MM)


def object_mark(distance_mm: float) -> tuple[float, float] | None:
    """The object, if it is within the panel."""
    view = section_for(distance_mm)
    return view.at(-distance_mm, 0.0) if -distance_mm >= view.left_mm else None


def outline(view: Section, glass: Glass) -> list[tuple[float, float]]:
    lens, half = glass.lens, glass.lens.thickness_mm / 2.0
    heights = np.linspace(-glass.rim_mm, glass.rim_mm, 41)
    front = sag_mm(lens.front_per_mm, heights) - half
    back = sag_mm(lens.back_per_mm, heights) + half
    there = [view.at(x, h) for x, h in zip(front, heights, strict=True)]
    return there + [view.at(x, h) for x, h in zip(back[::-1], heights[::-1], strict=True)]


def ray_polylines(
    view: Section, glass: Glass, rays: Rays, heights: Floats
) -> list[list[tuple[float, float]]]:
    """Each ray from the left to its end, or to the border of the panel."""
    drawn = []
    far = glass.distance_mm
    within = -far >= view.left_mm
    for front, back, slope, height in zip(rays.front, rays.back, rays.slope, heights, strict=True):
        start = (view.left_mm, float(height) * (1.0 + view.left_mm / far))
        places = [(-far, 0.0) if within else start]
        places += [(float(x), float(y)) for x, y in (front, back) if math.isfinite(x)]
        if math.isfinite(slope):
            places.append(at_border(view, places[-1], float(slope)))
        elif len(places) == 1:
            places.append(at_border(view, (0.0, float(height)), float(height) / far))
        drawn.append([view.at(*place) for place in places])
    return drawn


def at_border(view: Section, place: tuple[float, float], slope: float) -> tuple[float, float]:
    """The point where a line to the right leaves the panel."""
    x, y = place
    along = view.right_mm - x
    if abs(y + slope * along) > view.up_mm:
        along = max((math.copysign(view.up_mm, slope) - y) / slope, 0.0)
    return x + along, y + slope * along


def failures(view: Section, rays: Rays, heights: Floats, radius: float) -> Iterator[str]:
    """A mark where a ray ends."""
    for fate, front, back, height in zip(rays.fate, rays.front, rays.back, heights, strict=True):
        if fate != singlet.PASSES:
            places = [place for place in (back, front) if math.isfinite(place[0])]
            place = places[0] if places else (0.0, float(height))
            yield dot(view.at(*place), "error", radius)


def normals(view: Section, glass: Glass, marked: Rays) -> Iterator[str]:
    """The normals of the glass at the points where the marked ray is refracted."""
    half = glass.lens.thickness_mm / 2.0
    front = marked.front[0], glass.lens.front_per_mm, -half
    back = marked.back[0], glass.lens.back_per_mm, half
    for place, c, vertex in (front, back):
        x, y = (float(value) for value in place)
        # Only rays that meet the sphere have a normal; the simple models refract at planes.
        if math.isfinite(x) and abs(c * ((x - vertex) ** 2 + y * y) - 2.0 * (x - vertex)) < 1e-6:
            across, up = 7.0 * (1.0 - c * (x - vertex)), 7.0 * -c * y
            ends = (view.at(x + side * across, y + side * up) for side in (-1, 1))
            yield polyline(ends, "muted thin dashed")


def marks(view: Section, glass: Glass, height: float, opening: float) -> Iterator[str]:
    """The handles, and the height of the marked ray."""
    lens, far = glass.lens, glass.distance_mm
    front = ("front", lens.front_per_mm, -1.0, -13.0, 14.0, "end")
    back = ("back", lens.back_per_mm, 1.0, 13.0, -6.0, "start")
    for name, per_mm, side, aside, below, anchor in (front, back):
        bulge = -1000.0 * side * per_mm
        mark = surface_mark(far, bulge, lens.thickness_mm, front=side < 0)
        if glass.rim_mm < MARK_MM:  # the surface from the rim to its handle
            heights = side * np.linspace(glass.rim_mm, MARK_MM, 9)
            along = side * lens.thickness_mm / 2.0 + sag_mm(per_mm, heights)
            beyond = [view.at(x, h) for x, h in zip(along, heights, strict=True)]
            yield polyline(beyond, "camera thin dashed")
        yield dot(mark, "camera", 5)
        yield text((mark[0] + aside, mark[1] + below), name, "camera small", anchor)
    entry = entry_mark(far, height)
    yield dot(entry, "ray", 5)
    yield line(entry, (entry[0], AXIS_Y), "ray thin")
    gaps = np.convolve(fan_heights(opening), (0.5, 0.5), "valid")
    gap = float(gaps[np.abs(gaps - 0.5 * height).argmin()])
    aside = 5 if abs(entry[1] - AXIS_Y) > 40 else 18  # beside the ring of the handle
    yield text((entry[0] - aside, entry_mark(far, gap)[1] + 4), "h", "ray italic ground", "end")
    speck = object_mark(far)
    if speck:
        yield dot(speck, "world", 5)
    yield text(view.at(0.0, -BLADE_MM - 5.0), "opening", "ground", "middle")


def images(view: Section, glass: Glass) -> Iterator[str]:
    """The image in the simple models, named above the rays."""
    thin = ("thin lens", glass.thin_mm, "muted", 70.0)
    thick = ("thick lens", glass.paraxial_mm, "image", 86.0)
    for name, place, style, row in (thin, thick):
        if 0.0 < place <= view.right_mm:
            x = view.at(place, 0.0)[0]
            yield line((x, AXIS_Y + 7), (x, AXIS_Y - row), f"{style} thin")
            yield line((x, AXIS_Y - 7), (x, AXIS_Y + 7), f"{style} bold")
            yield text((x - 5.0, AXIS_Y - row + 9.0), name, f"{style} small ground", "end")


def opening_mark(opening: float) -> tuple[float, float]:
    """The right end of the line of the opening."""
    return RIGHT - 10.0, HEIGHTS.place(opening)


def spot(glass: Glass, rays: Rays, heights: Floats) -> Raster:
    """The light of rays at evenly spaced heights, all round the axis, on a sheet at the image."""
    away = from_middle()
    edges = np.arange(away.max() + 2.0)
    landing = SPOT_PER_MM * np.abs(at_image(glass, rays))
    seen = landing < edges[-1]  # not of NaN
    light, _ = np.histogram(landing[seen], edges, weights=heights[seen])
    light *= 2.0 * SPOT_PER_MM**2 * (heights[1] - heights[0])
    shown = 1.0 - np.exp(-light / np.diff(edges**2) / BRIGHT)
    return of_planes([encode_srgb_codes(np.interp(away, edges[:-1] + 0.5, shown))] * 3)


@cache
def from_middle() -> Floats:
    """(H, W) distances of pixels two units wide from the middle of the second panel, in units."""
    rows, columns = np.mgrid[1.0:HEIGHT:2.0, 1.0:WIDTH:2.0]
    return np.hypot(columns - WIDTH / 2.0, rows - HEIGHT / 2.0)


def at_image(glass: Glass, rays: Rays) -> Floats:
    """(n,) mm above the axis where rays meet a sheet at the thick lens's image, or NaN."""
    if not glass.real:
        return np.full(len(rays.slope), math.nan)
    return rays.back[:, 1] + rays.slope * (glass.paraxial_mm - rays.back[:, 0])


def over_spot(glass: Glass, marked: Rays | None) -> str:
    """The place of the marked ray, None if it is stopped, and a millimetre."""
    x, y = WIDTH / 2.0, AXIS_Y
    if not glass.real:
        return text((x, y - 16.0), "no image behind this lens", "error ground", "middle")
    foot = HEIGHT - 14.0
    scale = cased(line, (14.0, foot), (14.0 + SPOT_PER_MM, foot), style="bold")
    parts = [scale, text((22.0 + SPOT_PER_MM, foot + 4.0), "1 mm", "small ground")]
    hit = y - SPOT_PER_MM * float(at_image(glass, marked)[0]) if marked else math.nan
    if 0.0 < hit < HEIGHT:
        parts.append(dot((x, hit), "ray", 3.5))
    return "".join(parts)


def aberration(glass: Glass, curve: Floats, height: float, marked: Rays, opening: float) -> str:
    """Places where rays cross the axis, by their height: a real lens, and the two lines of the
    models."""
    plot = plot_of(glass, HEIGHTS)
    parts = [
        *plot_frame(glass, plot, "height h, mm", (0, 10, 20)),
        plot.level(opening, "thin dashed"),
        text((RIGHT - 28, HEIGHTS.place(opening) - 5), "opening", "small ground", "end"),
        dot(opening_mark(opening)),
    ]
    if glass.real:
        within, beyond = opening >= HEIGHTS_MM, opening <= HEIGHTS_MM
        parts += [
            *model_images(glass, plot),
            plot.curve(curve[beyond], HEIGHTS_MM[beyond], "light thin dashed"),
            plot.curve(curve[within], HEIGHTS_MM[within], "light bold"),
            *crossing(plot, marked, height),
        ]
    return "".join(parts)


def curve_mark(glass: Glass, marked: Rays, height: float) -> tuple[float, float]:
    """The marked ray in the third panel, on the axis of heights if it does not cross."""
    plot = plot_of(glass, HEIGHTS)
    crosses = crosses_within(plot, marked) if glass.real else None
    return plot.at(plot.x.low if crosses is None else crosses, height)


def plot_of(glass: Glass, up: Axis) -> Plot:
    """The axis around the image, if there is one."""
    image_mm = glass.paraxial_mm if glass.real else 0.0
    return Plot(Axis(image_mm - BEFORE_MM, image_mm + BEHIND_MM, LEFT, RIGHT), up)


def plot_frame(glass: Glass, plot: Plot, name: str, ticks: Sequence[float]) -> Iterator[str]:
    yield plot.axes()
    yield plot.y_axis(Scale(name, ticks=ticks, style="small", tick_style="muted small"))
    yield plot.x_axis(ALONG if glass.real else replace(ALONG, name="", ticks=()))
    if not glass.real:
        middle = (0.5 * (LEFT + RIGHT), 0.5 * (TOP + FLOOR) - 16)
        yield text(middle, "no image behind this lens", "error ground", "middle")


def model_images(glass: Glass, plot: Plot) -> Iterator[str]:
    """The images of the thin lens and of the thick one, named on the sides away from each other."""
    thin_before = glass.thin_mm < glass.paraxial_mm
    thin = ("thin", glass.thin_mm, "muted", thin_before)
    thick = ("thick", glass.paraxial_mm, "image", not thin_before)
    for name, along, role, before in (thin, thick):
        if plot.x.low <= along <= plot.x.high:
            yield plot.upright(along, f"{role} dashed")
            place = (plot.x.place(along) + (-4 if before else 4), FLOOR - 6)
            yield text(place, name, f"{role} small ground", "end" if before else "start")


def crosses_within(plot: Plot, marked: Rays) -> float | None:
    """The point where the marked ray crosses the axis, if it is within the plot."""
    along = float(marked.crossing_mm[0])
    return along if plot.x.low <= along <= plot.x.high else None


def crossing(plot: Plot, marked: Rays, height: float) -> Iterator[str]:
    along = crosses_within(plot, marked)
    if along is not None:
        yield dot(plot.at(along, height), "ray", 5)
