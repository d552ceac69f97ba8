"""Slanted Edge: one picture of an edge, and the MTF measured from it."""

import math
from collections.abc import Iterator, Mapping, Sequence
from textwrap import wrap

import numpy as np

from simulations.engine.controls import PointLists, Value
from simulations.engine.drafting import swatch
from simulations.engine.drawing import dot, line, path, rectangle, text
from simulations.engine.frame import Frame, Panel, format_number, value_with_error
from simulations.engine.handles import Handle, Point
from simulations.engine.photograph import Whole
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats, centred
from simulations.models.color.srgb import encode_srgb
from simulations.models.sampling.slanted_edge import FREQUENCIES, EdgeReading, measure
from simulations.models.sampling.slanted_edge_line import EdgeLine
from simulations.models.sampling.slanted_edge_pixels import EdgePixels
from simulations.scenes.slanted_edge.edge import (
    DARK,
    HEIGHT,
    MOST_KEPT,
    STAGES,
    STEP,
    WAVELENGTH_UM,
    WIDTH,
    Box,
    KeptEdge,
    Settings,
    Sharpness,
)
from simulations.scenes.slanted_edge.results import EXPORTS, contrast_of, per_mm, readouts, sheet

SIZE = WIDTH, HEIGHT
# Pixels either side of the edge that the second panel may show, at least so many times the width
# over which the light rises from a tenth to nine tenths.
REACHES, RISES = (4.0, 8.0, 16.0, 32.0, 64.0), 2.0
SPOT_UM, MOST_APERTURE = (
    1.22 * WAVELENGTH_UM,
    22.0,
)  # radius of Airy's disc at f/1; the smallest hole
OF_LINE = Axis(-1.0, 1.2, 222.0, 12.0)
FREQUENCY = Axis(0.0, 1.0, 34.0, 388.0)
NYQUIST = 0.5
HANDLE_ROW = 20.0  # height of the edge's handle
SPECK, MOST_SPECKS = 1.4, 800  # length of the stroke for a pixel, and how many are drawn
WORDS, LINE, ROOM = 42, 20.0, 80.0  # letters in a line of a refusal, heights of a line and of all


def edge_at(angle_deg: float, row: float) -> tuple[float, float]:
    """The point of the simulated edge at a height of the panel."""
    return WIDTH / 2 + (HEIGHT / 2 - row) * math.tan(math.radians(angle_deg)), row


def over_picture(
    settings: Settings, box: Box, pixels: EdgePixels | str, simulated: bool, refusal: str
) -> Iterator[str]:
    """The edge, the rectangle, the row whose pixels are set off, the handles, and a refusal."""
    (left, top), (right, bottom) = settings.opposite, settings.corner
    frame = ((left, top), right - left, bottom - top)
    found = pixels.line if isinstance(pixels, EdgePixels) else None
    if simulated:
        ends = (edge_at(settings.angle, HEIGHT), edge_at(settings.angle, 0.0))
        yield from cased(ends, "world dashed")
    elif found:
        y = centred(found.picture.shape[0])[found.rows[[0, -1]]]
        points = zip(found.column(y), y, strict=True)
        yield from cased([in_panel(found, box, *point) for point in points], "world dashed")
    yield rectangle(*frame, "casing")
    yield rectangle(*frame, "error" if refusal else "image")
    if found:  # the row, or column, in the middle
        end = 0.5 * found.picture.shape[1]
        middle = found.rows[len(found.rows) // 2]
        row = float(centred(found.picture.shape[0])[middle])
        yield from cased([in_panel(found, box, x, row) for x in (-end, end)], "camera")
    yield dot(settings.centre, "image", 4)
    yield dot(settings.corner, "image", 5)
    if simulated:
        yield dot(edge_at(settings.angle, HANDLE_ROW), "world", 5)
    # A refusal is at the foot of the picture, or at its top if the rectangle is there.
    lines, below = wrap(refusal, WORDS), bottom < HEIGHT - ROOM
    first = HEIGHT - 14.0 - LINE * (len(lines) - 1) if below else HANDLE_ROW + 30.0
    for number, words in enumerate(lines):
        yield text((WIDTH / 2, first + LINE * number), words, "error ground", "middle")


def kept_places(places: Sequence[KeptEdge]) -> Iterator[str]:
    """The rectangles that were kept, each with its MTF50 in cycles per pixel."""
    for place in places:
        box, half = place.box, place.sharpness.half.frequency
        wide, high = box.size
        x, y = box.at(0.5 * wide, 0.5 * high)
        frame = box.at(0, 0), wide / box.per_unit, high / box.per_unit
        words = "no MTF" if place.sharpness.refusal else format_number(half, 3)
        yield rectangle(*frame, "casing")
        yield rectangle(*frame, "image thin")
        yield text((x, y + 5.0), words, "image small ground", "middle")


def cased(ends: Sequence[Point], style: str) -> Iterator[str]:
    yield line(ends[0], ends[1], "casing")
    yield line(ends[0], ends[1], style)


def in_panel(edge: EdgeLine, box: Box, x: float, y: float) -> Point:
    """A place from the middle of the picture as it was turned, in the panel."""
    across = -x if edge.mirrored else x
    column, row = (y, across) if edge.turned else (across, y)
    width, height = box.size
    return box.at(0.5 * width + column, 0.5 * height + row)


def axis_across(settings: Settings, reading: EdgeReading | None, simulated: bool) -> Axis:
    """Distances from the edge, in two panels; in the simulated picture for all apertures alike."""
    wanted = SPOT_UM * MOST_APERTURE / settings.pitch
    if not simulated:
        wanted = min(RISES * reading.rise, 0.5 * reading.pixels.reach) if reading else 0.0
    reach = next(reach for reach in REACHES if reach >= wanted)
    return Axis(-reach, reach, 34.0, 388.0)


def light_across(pixels: EdgePixels | str, reading: EdgeReading | None, x: Axis) -> Iterator[str]:
    """A sharp edge, a row of its picture, and each pixel by its distance from the edge."""
    plot = Plot(x, Axis(-0.15, 1.15, 222.0, 92.0))
    across = Scale("distance from the edge", "px", (x.low, 0, x.high), style="small")
    yield plot.frame(across, Scale(ticks=(0, 1), grid=(0, 1), tick_style="muted small"))
    if reading is not None:
        place = places_shown(x, reading)
        yield plot.curve(place, reading.curve.spread(place), "image thin")
    if isinstance(pixels, EdgePixels):
        inside = np.abs(pixels.distance) < plot.x.high
        yield specks(plot, pixels.distance[inside], pixels.value[inside])
        row = inside & (pixels.row == len(pixels.line.rows) // 2)
        distance, value = pixels.distance[row], pixels.value[row]
        yield text((plot.x.start, 14), "before the lens", "muted small")
        yield from strip(plot, 20.0, 0.5 * np.array((x.low, x.high)), np.array((0.0, 1.0)), x.high)
        yield text((plot.x.start, 54), "one row of pixels", "camera small")
        yield from strip(plot, 60.0, distance, value, math.cos(pixels.line.angle_rad))
        for place, light in zip(distance.tolist(), value.tolist(), strict=True):
            yield plot.mark(place, light, "camera", 3.5)
    entries = Entry("all pixels", "image", "dot"), Entry("one row", "camera", "dot")
    yield legend((plot.x.start, 288), entries, "small")


def strip(plot: Plot, top: float, middle: Floats, value: Floats, width: float) -> Iterator[str]:
    """Greys (N,) between dark and light, around places (N,) of the plot."""
    greys = encode_srgb(np.clip(DARK + STEP * value, 0.0, 1.0)).tolist()
    for x, grey in zip(middle.tolist(), greys, strict=True):
        left, right = plot.x.clamped(x - 0.5 * width), plot.x.clamped(x + 0.5 * width)
        yield swatch((left, top), right - left, 20.0, (grey,) * 3)


def places_shown(x: Axis, reading: EdgeReading) -> Floats:
    """Distances from the edge, close enough for a wave of one cycle per pixel."""
    reach = min(x.high, reading.pixels.reach - 1.0)
    return np.linspace(-reach, reach, round(40 * reach) + 1)


def line_and_wave(sharpness: Sharpness, frequency: float, x: Axis) -> Iterator[str]:
    """The slope of the light, a wave, and their product: its area is the contrast that is left."""
    plot, reading = Plot(x, OF_LINE), sharpness.reading
    across = Scale("distance from the edge", "px", (x.low, 0, x.high), style="small")
    yield plot.frame(across, Scale(ticks=(-1, 0, 1), grid=(0,), tick_style="muted small"))
    if reading is not None:
        place = places_shown(x, reading)
        slope, turns = reading.curve.slope(place), 2.0 * np.pi * frequency * place
        # Of all shifts of the wave, the one with the largest area.
        wave = np.cos(turns + np.angle(np.sum(slope * np.exp(-1j * turns))))
        yield plot.curve(place, wave, "world thin")
        yield plot.between(place, slope * wave, np.zeros_like(place), "image fill thin")
        yield plot.curve(place, slope, "light bold")
        area = f"area {format_number(contrast_of(reading, frequency), 2)}"
        yield text((plot.x.end, 22), area, "image small ground", "end")
    entries = (
        Entry("slope, per px", "light bold"),
        Entry("wave", "world thin"),
        Entry("their product", "image fill", "area"),
    )
    yield legend((plot.x.start, 288), entries, "small")


def specks(plot: Plot, distance: Floats, value: Floats) -> str:
    some = slice(None, None, max(1, math.ceil(distance.size / MOST_SPECKS)))
    x = plot.x.position(distance[some]).tolist()
    y = plot.y.position(np.clip(value[some], plot.y.low, plot.y.high)).tolist()
    half = SPECK / 2
    return path([[(u - half, v), (u + half, v)] for u, v in zip(x, y, strict=True)], "image bold")


def contrast_plot(sharpness: Sharpness) -> Plot:
    most = 1.05 if sharpness.refusal else max(1.05, float(sharpness.contrast.max()) + 0.05)
    return Plot(FREQUENCY, Axis(0.0, most, 222.0, 40.0))


def waves_left(sharpness: Sharpness, true: Floats) -> Iterator[str]:
    """The MTF as measured from the picture, and by the formulae if they are known."""
    known, plot = not np.isnan(true).any(), contrast_plot(sharpness)
    contrast = Scale(ticks=(0, 0.5, 1), grid=(0.5, 1), tick_style="muted small")
    yield plot.region(x=(NYQUIST, 1.0))
    yield plot.frame(Scale("frequency", "cycles per px", (0.5, 1), style="small"), contrast)
    yield plot.upright(NYQUIST, "camera thin dashed")
    yield text((plot.x.place(NYQUIST), 28), "Nyquist", "camera small ground", "middle")
    if known:
        yield plot.curve(FREQUENCIES, true, "ray bold")
    if not sharpness.refusal:
        yield from measured_contrast(plot, sharpness)
    entries = (
        Entry("lens × pixel", "ray bold", shown=known),
        Entry("from the edge ± 2 errors", "image", "dot"),
    )
    yield legend((plot.x.start, 288), entries, "small")


def measured_contrast(plot: Plot, sharpness: Sharpness) -> Iterator[str]:
    """The contrast with twice its standard error, and MTF50."""
    numbers = FREQUENCIES, sharpness.contrast, 2.0 * sharpness.error
    points = list(zip(*(each[::4].tolist() for each in numbers), strict=True))
    yield path([[plot.clamped(f, c - e), plot.clamped(f, c + e)] for f, c, e in points], "image")
    for f, left, _ in points:
        yield plot.mark(f, left, "image", 2.5)
    if np.isfinite(sharpness.half.frequency):
        yield plot.drop(sharpness.half.frequency, 0.5, "image thin dashed", "xy")


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture, the light across the edge, and the contrast of waves."""
    sharpness: Sharpness = outputs["sharpness"]
    pixels, simulated = outputs["pixels"], outputs["photograph"] is None
    kept, refusal = kept_places(outputs["places"]), sharpness.refusal
    frame = over_picture(settings, outputs["box"], pixels, simulated, refusal)
    picture, over = outputs["shown"], "".join((*kept, *frame))
    x = axis_across(settings, sharpness.reading, simulated)
    across = "".join(light_across(pixels, sharpness.reading, x))
    product = "".join(line_and_wave(sharpness, settings.wave, x))
    waves, title = waves_left(sharpness, outputs["true"]), "What is left of a wave’s contrast: MTF"
    return Frame(
        (
            Panel("picture", "The picture of an edge", *SIZE, picture, over, True, True),
            Panel("across", "Light across the edge: ESF", *SIZE, overlay=across),
            Panel("line", "Its slope, the image of a line: LSF", *SIZE, overlay=product),
            Panel("waves", title, *SIZE, overlay="".join(waves)),
        ),
        readouts(settings, outputs),
        describe(settings, outputs),
    )


def describe(settings: Settings, outputs: Outputs) -> str:
    """The measurement of the edge, or why there is none."""
    sharpness: Sharpness = outputs["sharpness"]
    slant = "A rectangle on a photograph"
    if outputs["photograph"] is None:
        degrees = format_number(settings.angle, 1)
        slant = f"A soft edge between dark and light, slanted by {degrees}°"
    if sharpness.refusal:
        return f"{slant}, gives no MTF. {sharpness.refusal}"
    scale, half = per_mm(settings, outputs), sharpness.half
    found = value_with_error(scale * half.frequency, scale * half.error)
    return f"{slant}: waves of {found} cycles per mm keep half of their contrast."


def end_at(settings: Settings, outputs: Outputs) -> Point | None:
    return None if outputs["photograph"] else edge_at(settings.angle, HANDLE_ROW)


def end_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    angle = math.atan2(place[0] - WIDTH / 2, HEIGHT / 2 - HANDLE_ROW)
    return {"angle": math.degrees(angle)}


def spot_at(settings: Settings, outputs: Outputs) -> Point | None:
    if outputs["photograph"] is not None:
        return None
    x = axis_across(settings, None, True)
    return x.place(SPOT_UM * settings.aperture / settings.pitch), OF_LINE.place(0.0)


def spot_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    x = axis_across(settings, None, True)
    return {"aperture": x.value(place[0]) * settings.pitch / SPOT_UM}


def wave_at(settings: Settings, outputs: Outputs) -> Point | None:
    sharpness: Sharpness = outputs["sharpness"]
    if sharpness.reading is None:
        return None
    contrast = contrast_of(sharpness.reading, settings.wave)
    return contrast_plot(sharpness).at(settings.wave, contrast)


def wave_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"wave": FREQUENCY.value(place[0])}


def corner_at(settings: Settings, _outputs: Outputs) -> Point:
    return settings.corner


def corner_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    (x, y), share = settings.centre, 200.0 / WIDTH
    return {"width": share * (place[0] - x), "height": share * (place[1] - y)}


def middle_at(settings: Settings, _outputs: Outputs) -> Point:
    return settings.centre


def middle_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"x": 100.0 * place[0] / WIDTH, "y": 100.0 * place[1] / WIDTH}


def nowhere(_settings: Settings, _outputs: Outputs) -> None:
    return None


def keep(settings: Settings, _place: Point) -> Mapping[str, Value]:
    """The rectangle is kept, in place of the oldest one if there are too many."""
    before = PointLists.from_text(settings.kept).lists[0] if settings.kept else ()
    corners = settings.opposite, settings.corner
    new = tuple((min(max(x / WIDTH, 0.0), 1.0), min(max(y / HEIGHT, 0.0), 1.0)) for x, y in corners)
    return {"kept": PointLists("", 0, ((*before, *new)[-2 * MOST_KEPT :],)).text}


def forget(_settings: Settings, _place: Point) -> Mapping[str, Value]:
    return {"kept": ""}


CORNER, MIDDLE = ("width", "height"), ("x", "y")
SCENE = Scene(
    "slanted-edge",
    "Slanted Edge",
    Settings,
    draw,
    STAGES,
    (
        Handle("end", "picture", "Edge", ("angle",), end_at, end_pulled, role="world"),
        Handle("corner", "picture", "Corner", CORNER, corner_at, corner_pulled, role="image"),
        Handle(
            "rectangle", "picture", "Rectangle", MIDDLE, middle_at, middle_pulled, "press", "image"
        ),
        Handle("spot", "line", "Lens’s spot", ("aperture",), spot_at, spot_pulled, role="light"),
        Handle("wave", "waves", "Wave", ("wave",), wave_at, wave_pulled, role="image"),
        Handle("keep", "across", "This place", ("kept",), nowhere, keep, "aim"),
        Handle("forget", "waves", "All places", ("kept",), nowhere, forget, "aim"),
    ),
    Whole(24),
    exports=EXPORTS,
    sheet=sheet,
    formula=measure,
)
