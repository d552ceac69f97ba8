"""The lens from the side: the bundle of parallel light that forms a corner of the picture.

All lengths are to one scale. Light comes from the left, 45° from above. Things behind the lens are
drawn at their apparent places seen from the front, as in the formulas, with dashed lines.
"""

from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import Point, dot, ellipse, line, path, polygon, text
from simulations.models.lens.chromatic_aberration import focal_length_mm
from simulations.scenes.lens_aberrations.drawing import WIDTH
from simulations.scenes.lens_aberrations.spectrum import LINES_UM
from simulations.scenes.lens_aberrations.stages import FOCAL_MM, GLASSES, RIM_MM

UNITS_PER_MM = 5.0
LENS_X, AXIS_Y = 200.0, 138.0
LENS_MM, SENSOR_MM = 25.0, 26.0
"""Half heights as drawn."""
BLADE_MM, TUBE_MM = 17.5, 14.0
"""Outer ends of the stop and of the rim, with their marks."""
BESIDE_LENS = 28.0
"""Least distance of the name of the stop from the lens, in view box units."""
SPREAD = 5.0
"""Exaggeration of the dispersion, which would be too small to see."""

type Place = tuple[float, float]


def at(along_mm: float, up_mm: float) -> Place:
    """A place behind the lens and above the axis."""
    return LENS_X + UNITS_PER_MM * along_mm, AXIS_Y - UNITS_PER_MM * up_mm


def millimetres(place: Point) -> tuple[float, float]:
    """The inverse of `at`."""
    return (float(place[0]) - LENS_X) / UNITS_PER_MM, (AXIS_Y - float(place[1])) / UNITS_PER_MM


def opening_mm(f_number: float) -> float:
    """Radius of the opening."""
    return FOCAL_MM / f_number / 2.0


def stop_mark(stop: float) -> Place:
    return at(-stop, BLADE_MM)


def opening_mark(stop: float, f_number: float) -> Place:
    """The handle on the lower edge of the opening."""
    return at(-stop, -opening_mm(f_number))


def rim_mark(stop: float, rim: float) -> Place:
    return at(-stop - rim, -TUBE_MM)


def passing(f_number: float, rim: float) -> tuple[float, float] | None:
    """Heights in the stop between which the bundle passes the rim; None if nothing passes."""
    opening = opening_mm(f_number)
    highest = min(opening, RIM_MM - rim)
    return (-opening, highest) if highest > -opening else None


def section(glass: str, stop: float, f_number: float, rim: float) -> str:
    """The rim, the stop, the lens and the sensor, and the path of the bundle."""
    dispersive = glass != "ideal"
    open_heights = passing(f_number, rim)
    parts = [line((6, AXIS_Y), (WIDTH - 6, AXIS_Y), "muted thin dashed")]
    if open_heights:
        low, high = open_heights
        parts += _bundle(low, high, stop)
        heights = [low, high] + [0.0] * (low < 0.0 < high)
        for style, shift in _colours(glass) if dispersive else (("light", 0.0),):
            parts.append(path([_refracted(height, stop, shift) for height in heights], style))
    if open_heights is None or open_heights[1] < opening_mm(f_number):
        parts += _stopped(opening_mm(f_number), stop, rim)
    parts += [*_glass(), *_rim(stop, rim), *_stop(stop, f_number), *_notes(stop, dispersive)]
    return "".join(parts)


def _colours(glass: str) -> tuple[tuple[str, float], ...]:
    """Style of red and blue, and the drawn shift of the image per height in the lens."""
    focal = focal_length_mm(GLASSES[glass], FOCAL_MM, np.array(LINES_UM))
    shifts = SPREAD * (1.0 - FOCAL_MM / focal)
    return ("error", float(shifts[0])), ("image", float(shifts[2]))


def _height(height: float, stop: float, along: float) -> float:
    """A point of the ray that meets the stop at ``height``, before refraction, falling by 45°."""
    return height - stop - along


def _start(height: float, stop: float) -> Place:
    """Where a ray enters the drawing: at the top, or at the left."""
    along = max(height - stop - LENS_MM, -LENS_X / UNITS_PER_MM + 1.0)
    return at(along, _height(height, stop, along))


def _bundle(low: float, high: float, stop: float) -> Iterator[str]:
    """The light that passes, up to the lens."""
    starts = [_start(height, stop) for height in (low, high)]
    ends = [at(0.0, _height(height, stop, 0.0)) for height in (low, high)]
    yield polygon((starts[0], ends[0], ends[1], starts[1]), "light fill faint")
    yield path(zip(starts, ends, strict=True), "light")
    if low < 0.0 < high:
        yield line(_start(0.0, stop), at(0.0, _height(0.0, stop, 0.0)), "light thin")
    if stop < 0:
        seen = [at(-stop, height) for height in (low, high)]
        yield path(zip(ends, seen, strict=True), "light thin dashed")


def _refracted(height: float, stop: float, shift: float) -> tuple[Place, Place]:
    """The light from the lens to the sensor, where light of the d line meets in one point."""
    in_lens = _height(height, stop, 0.0)
    return at(0.0, in_lens), at(FOCAL_MM, shift * in_lens - FOCAL_MM)


def _stopped(height: float, stop: float, rim: float) -> Iterator[str]:
    """The outermost ray, which ends on the rim."""
    along = -stop - rim
    end = at(along, _height(height, stop, along))
    yield line(_start(height, stop), end, "error thin dashed")
    yield dot(end, "error", 3)


def _glass() -> Iterator[str]:
    yield ellipse((LENS_X, AXIS_Y), (9, UNITS_PER_MM * LENS_MM), "camera fill")
    yield line(at(FOCAL_MM, SENSOR_MM), at(FOCAL_MM, -SENSOR_MM), "image bold")
    row = AXIS_Y + UNITS_PER_MM * SENSOR_MM + 16
    yield text((LENS_X, row), "lens", "camera", "middle")
    yield text((at(FOCAL_MM, 0)[0] + 8, AXIS_Y - 100), "sensor", "image")
    yield text((at(FOCAL_MM, 0)[0] + 8, AXIS_Y + 124), "corner", "image")


def _stop(stop: float, f_number: float) -> Iterator[str]:
    opening, style = opening_mm(f_number), "bold" if stop >= 0 else "bold dashed"
    for side in (-1, 1):
        yield line(at(-stop, side * opening), at(-stop, side * BLADE_MM), style)
    yield dot(stop_mark(stop))
    yield dot(opening_mark(stop, f_number))
    aside = max(abs(UNITS_PER_MM * stop), BESIDE_LENS)
    column = LENS_X - (aside if stop >= 0 else -aside)
    yield text((column, AXIS_Y - 104), "stop", "ground", "middle")
    x, y = opening_mark(stop, f_number)
    aside, anchor = (-14.0, "end") if stop >= 0 else (14.0, "start")
    yield text((x + aside, y + 10.0), "opening", "ground", anchor)


def _rim(stop: float, rim: float) -> Iterator[str]:
    style = "camera bold" if stop + rim >= 0 else "camera bold dashed"
    for side in (-1, 1):
        yield line(at(-stop - rim, side * RIM_MM), at(-stop - rim, side * TUBE_MM), style)
    x, y = rim_mark(stop, rim)
    yield dot((x, y), "camera")
    yield text((x - 14, y + 4), "rim", "camera ground", "end")


def _notes(stop: float, dispersive: bool) -> Iterator[str]:
    if dispersive:
        yield text((8, AXIS_Y + 156), f"dispersion × {SPREAD:.0f}", "muted small ground")
    if stop < 0:
        yield text((8, 14), "aperture stop as seen from the front", "muted small ground")
