"""Twigs against the sky through a simple lens: colours of other sizes and sharpness, dark corners.

A single element of 24 mm focal length, focused at infinity for the d line. Corners are 45° from the
axis, 200 px from the centre. In the drawing of the lens from the side, all lengths are to one
scale and light comes from the left, 45° from above. Things behind the lens are drawn at their
apparent places seen from the front, as in the formulas, with dashed lines.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simulations.engine.accuracy import Accuracy, tiers
from simulations.engine.drawing import cased, dot, ellipse, line, path, polygon, rectangle, text
from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.instrument import Instrument
from simulations.engine.photograph import Photograph
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider, toggle
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.lens.chromatic_aberration import focal_length_mm, lateral_chromatic_scale
from simulations.scenes.lens_aberrations import stages

CORNER_PX = 200.0  # from the centre to the corners
WIDTH, HEIGHT = 400.0, 300.0
UNITS_PER_MM = 5.0
LENS_X, AXIS_Y = 200.0, 138.0
LENS_MM, SENSOR_MM = 25.0, 26.0  # half heights as drawn
BLADE_MM, TUBE_MM = 17.5, 14.0  # outer ends of the stop and of the rim, with their marks
BESIDE_LENS = 28.0  # least distance of the name of the stop from the lens, in view box units
SUBJECTS = {"twigs": "Twigs against the sky", "chart": "A test chart"}
CLOSE_PX = stages.WIDTH_PX - stages.CLOSE_LEFT, stages.HEIGHT_PX - stages.CLOSE_TOP
LOUPE_PX, TIMES = (36, 24), 3  # upper left corner of the loupe, and how much it enlarges
SPREAD = 5.0  # exaggeration of the dispersion, which would be too small to see


@dataclass(frozen=True, slots=True)
class Settings:
    picture: str = choice("Picture", SUBJECTS)
    glass: str = choice(
        "Glass",
        {"ideal": "Without dispersion", "crown": "Crown, V = 64.2", "flint": "Flint, V = 36.4"},
        "crown",
    )
    stop: float = slider("Stop-to-lens distance", 12, -15, 15, 1, unit="mm")
    aperture: float = slider("Aperture", 2.8, 1.4, 16, 0.1, prefix="f/")
    rim: float = slider("Rim-to-stop distance", 6, 0, 12, 0.5, unit="mm")
    natural: bool = toggle("Natural vignetting, cos⁴", True)


def at(along_mm: float, up_mm: float) -> Point:
    """A place behind the lens and above the axis."""
    return LENS_X + UNITS_PER_MM * along_mm, AXIS_Y - UNITS_PER_MM * up_mm


def opening_mm(f_number: float) -> float:
    """Radius of the opening."""
    return stages.FOCAL_MM / f_number / 2.0


def stop_mark(settings: Settings, _outputs: Outputs) -> Point:
    return at(-settings.stop, BLADE_MM)


def opening_mark(settings: Settings, _outputs: Outputs) -> Point:
    """The lower edge of the opening."""
    return at(-settings.stop, -opening_mm(settings.aperture))


def rim_mark(settings: Settings, _outputs: Outputs) -> Point:
    return at(-settings.stop - settings.rim, -TUBE_MM)


def bundle_limits(f_number: float, rim: float) -> tuple[float, float] | None:
    """Heights in the stop between which the bundle passes the rim; None if nothing passes."""
    opening = opening_mm(f_number)
    highest = min(opening, stages.RIM_MM - rim)
    return (-opening, highest) if highest > -opening else None


def section(settings: Settings) -> str:
    """The rim, the stop, the lens and the sensor, and the path of the bundle."""
    stop, opening = settings.stop, opening_mm(settings.aperture)
    dispersive = settings.glass != "ideal"
    open_heights = bundle_limits(settings.aperture, settings.rim)
    parts = [line((6, AXIS_Y), (WIDTH - 6, AXIS_Y), "muted thin dashed")]
    if open_heights:
        low, high = open_heights
        parts += bundle(low, high, stop)
        heights = [low, high] + [0.0] * (low < 0.0 < high)
        for style, shift in colour_shifts(settings.glass) if dispersive else (("light", 0.0),):
            parts.append(path([refracted(height, stop, shift) for height in heights], style))
    if open_heights is None or open_heights[1] < opening:  # the outermost ray ends on the rim
        along = -stop - settings.rim
        end = at(along, height_at(opening, stop, along))
        parts += [line(start(opening, stop), end, "error thin dashed"), dot(end, "error", 3)]
    parts += [*lens_and_sensor(), *rim_edges(settings), *stop_blades(settings)]
    if dispersive:
        parts.append(text((8, AXIS_Y + 156), f"dispersion × {SPREAD:.0f}", "muted small ground"))
    if stop < 0:
        parts.append(text((8, 14), "aperture stop as seen from the front", "muted small ground"))
    return "".join(parts)


def colour_shifts(glass: str) -> tuple[tuple[str, float], ...]:
    """Style of red and blue, and the drawn shift of the image per height in the lens."""
    focal = focal_length_mm(stages.GLASSES[glass], stages.FOCAL_MM, np.array(stages.LINES_UM))
    shifts = SPREAD * (1.0 - stages.FOCAL_MM / focal)
    return ("error", float(shifts[0])), ("image", float(shifts[2]))


def height_at(height: float, stop: float, along: float) -> float:
    """A point of the ray that meets the stop at ``height``, before refraction, falling by 45°."""
    return height - stop - along


def start(height: float, stop: float) -> Point:
    """Where a ray enters the drawing: at the top, or at the left."""
    along = max(height - stop - LENS_MM, -LENS_X / UNITS_PER_MM + 1.0)
    return at(along, height_at(height, stop, along))


def bundle(low: float, high: float, stop: float) -> Iterator[str]:
    """The light that passes, up to the lens."""
    starts = [start(height, stop) for height in (low, high)]
    ends = [at(0.0, height_at(height, stop, 0.0)) for height in (low, high)]
    yield polygon((starts[0], ends[0], ends[1], starts[1]), "light fill faint")
    yield path(zip(starts, ends, strict=True), "light")
    if low < 0.0 < high:
        yield line(start(0.0, stop), at(0.0, height_at(0.0, stop, 0.0)), "light thin")
    if stop < 0:
        edges = [at(-stop, height) for height in (low, high)]
        yield path(zip(ends, edges, strict=True), "light thin dashed")


def refracted(height: float, stop: float, shift: float) -> tuple[Point, Point]:
    """The light from the lens to the sensor, where light of the d line meets in one point."""
    in_lens = height_at(height, stop, 0.0)
    return at(0.0, in_lens), at(stages.FOCAL_MM, shift * in_lens - stages.FOCAL_MM)


def lens_and_sensor() -> Iterator[str]:
    yield ellipse((LENS_X, AXIS_Y), (9, UNITS_PER_MM * LENS_MM), "camera fill")
    yield line(at(stages.FOCAL_MM, SENSOR_MM), at(stages.FOCAL_MM, -SENSOR_MM), "image bold")
    row, beside = AXIS_Y + UNITS_PER_MM * SENSOR_MM + 16, at(stages.FOCAL_MM, 0)[0] + 8
    yield text((LENS_X, row), "lens", "camera", "middle")
    yield text((beside, AXIS_Y - 100), "sensor", "image")
    yield text((beside, AXIS_Y + 124), "corner", "image")


def stop_blades(settings: Settings) -> Iterator[str]:
    stop, opening = settings.stop, opening_mm(settings.aperture)
    for side in (-1, 1):
        ends = at(-stop, side * opening), at(-stop, side * BLADE_MM)
        yield line(*ends, "bold" if stop >= 0 else "bold dashed")
    x, y = opening_mark(settings, {})
    yield dot(stop_mark(settings, {})) + dot((x, y))
    side = 1 if stop >= 0 else -1
    column = LENS_X - side * max(abs(UNITS_PER_MM * stop), BESIDE_LENS)
    yield text((column, AXIS_Y - 104), "stop", "ground", "middle")
    anchor = "end" if stop >= 0 else "start"
    yield text((x - side * 18.0, y + 10.0), "opening", "ground", anchor)


def rim_edges(settings: Settings) -> Iterator[str]:
    along = -settings.stop - settings.rim
    style = "camera bold" if along <= 0 else "camera bold dashed"
    for side in (-1, 1):
        yield line(at(along, side * stages.RIM_MM), at(along, side * TUBE_MM), style)
    x, y = rim_mark(settings, {})
    yield dot((x, y), "camera")
    yield text((x - 18, y + 4), "rim", "camera ground", "end")


def stops(factor: float) -> float:
    """A factor of light in powers of two; no light is −∞ stops."""
    return math.log2(factor) if factor > 0 else -math.inf


def draw(settings: Settings, outputs: Outputs) -> Frame:
    picture: Raster = outputs["encoded"]
    lines = np.array(stages.LINES_UM)
    discs = stages.discs_px(settings.glass, settings.aperture, lines)
    shifts = CORNER_PX * (stages.scales(settings.glass, settings.stop, lines) - 1.0)
    cos4, open_share = stages.light(np.ones(1), settings.aperture, settings.rim, settings.natural)
    natural, cut = float(cos4[0]), float(open_share[0])
    size, title = (WIDTH, HEIGHT), "The picture, its corner enlarged"
    return Frame(
        (
            Panel("picture", title, *size, with_loupe(picture), loupe_rims(), lead=True),
            Panel("lens", "The light of that corner", *size, overlay=section(settings)),
        ),
        (
            readout("lateral", "Red to blue, corner", shifts[2] - shifts[0], "px", role="error"),
            readout("natural_stops", "Natural vignetting", stops(natural), "stops", role="light"),
            readout("corner_stops", "Corner in all", stops(natural * cut), "stops"),
        ),
        describe(settings, shifts[2] - shifts[0], discs, natural * cut, outputs["photograph"]),
    )


def with_loupe(picture: Raster) -> Raster:
    """The picture with its corner enlarged over it."""
    shown = picture.copy()
    (left, top), (wide, high) = LOUPE_PX, CLOSE_PX
    close = picture[-high:, -wide:].repeat(TIMES, axis=0).repeat(TIMES, axis=1)
    shown[top : top + TIMES * high, left : left + TIMES * wide] = close
    return shown


def loupe_rims() -> str:
    """The rims of the loupe and of the corner, and lines that join them."""
    unit = WIDTH / stages.WIDTH_PX
    (left, top), (wide, high) = (unit * np.array(pair) for pair in (LOUPE_PX, CLOSE_PX))
    right, foot = left + TIMES * wide, top + TIMES * high
    joints = [[(right, top), (WIDTH, HEIGHT - high)], [(left, foot), (WIDTH - wide, HEIGHT)]]
    return (
        cased(path, joints, style="camera thin")
        + cased(rectangle, (WIDTH - wide, HEIGHT - high), wide - 1, high - 1, style="camera")
        + cased(rectangle, (left, top), right - left, foot - top, style="camera bold")
    )


def describe(
    settings: Settings, shift: float, discs: Floats, share: float, photograph: Photograph | None
) -> str:
    if abs(shift) < 0.005:
        fringe = "no coloured fringes in the corners"
    else:
        larger = "blue larger than red" if shift > 0 else "red larger than blue"
        fringe = f"{larger}, {format_number(abs(shift), 1)} pixels apart in the corners"
    widest = float(discs.max())
    soft = f"discs of up to {widest:.1f} pixels" if widest > 1 else "all colours sharp"
    side = "before" if settings.stop > 0 else "behind"
    where = f"{abs(settings.stop):.0f} mm {side} it" if settings.stop else "in it"
    subject = "Your own picture" if photograph else SUBJECTS[settings.picture]
    return (
        f"{subject} through a simple lens at f/{settings.aperture:.1f}, with the aperture stop "
        f"{where}: {fringe}, {soft}, and {100 * share:.0f}\u00a0% of the centre’s light in the "
        f"corners."
    )


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    lens = settings.glass, settings.stop, settings.aperture
    vignetting = settings.rim, settings.natural
    return stages.corner_errors(outputs["encoded"], outputs["subject"], *lens, *vignetting)


RIM, STOP = ("rim",), ("stop",)
HANDLES: tuple[Handle[Settings], ...] = (
    Handle("stop", "lens", "Aperture stop", STOP, stop_mark, reversed=STOP),
    Handle("opening", "lens", "Edge of the opening", ("aperture",), opening_mark),
    Handle("rim", "lens", "Rim", RIM, rim_mark, role="camera", reversed=RIM),
)
SCENE = Scene(
    "lens-aberrations",
    "Lens Aberrations",
    Settings,
    draw,
    stages.STAGES,
    HANDLES,
    instrument=Instrument(photograph=stages.PADDED_PX),
    accuracy=Accuracy(
        levels=tiers(*stages.BANDS),
        default="even-16",
        ladder="chromatic-aberration",
        estimate=estimate,
        unit="codes",
    ),
    formula=lateral_chromatic_scale,
)
