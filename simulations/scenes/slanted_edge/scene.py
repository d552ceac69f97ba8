"""Slanted Edge: one picture of an edge, and the MTF measured from it."""

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from textwrap import wrap

from simulations.engine.controls import PointLists, Value
from simulations.engine.drawing import cased, dot, line, rectangle, text
from simulations.engine.frame import Frame, Panel, format_number, value_with_error
from simulations.engine.handles import Handle, Point
from simulations.engine.instrument import Instrument
from simulations.engine.photograph import MOST_MEGAPIXELS, Codes, Photograph, Whole
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.arrays import centred
from simulations.models.sampling.slanted_edge import measure
from simulations.models.sampling.slanted_edge_line import EdgeLine
from simulations.models.sampling.slanted_edge_pixels import EdgePixels
from simulations.scenes._wipe import over_wipe
from simulations.scenes.slanted_edge.edge import (
    HEIGHT,
    MOST_KEPT,
    STAGES,
    WIDTH,
    Box,
    KeptEdge,
    Settings,
    Sharpness,
    found_rectangle,
    light,
    simulated,
)
from simulations.scenes.slanted_edge.plots import (
    FREQUENCY,
    OF_LINE,
    SPOT_UM,
    axis_across,
    contrast_plot,
    light_across,
    line_and_wave,
    waves_left,
)
from simulations.scenes.slanted_edge.results import EXPORTS, contrast_of, per_mm, readouts, sheet

SIZE = WIDTH, HEIGHT
HANDLE_ROW = 20.0  # height of the edge's handle
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
        ends = [edge_at(settings.angle, HEIGHT), edge_at(settings.angle, 0.0)]
        yield cased(line, *ends, style="world dashed")
    elif found:
        y = centred(found.picture.shape[0])[found.rows[[0, -1]]]
        points = zip(found.column(y), y, strict=True)
        ends = [in_panel(found, box, *point) for point in points]
        yield cased(line, *ends, style="world dashed")
    yield cased(rectangle, *frame, style="error" if refusal else "image")
    if found:  # the row, or column, in the middle
        end = 0.5 * found.picture.shape[1]
        middle = found.rows[len(found.rows) // 2]
        row = float(centred(found.picture.shape[0])[middle])
        ends = [in_panel(found, box, x, row) for x in (-end, end)]
        yield cased(line, *ends, style="camera")
    yield dot(settings.centre, "image", 4)
    yield dot(settings.corner, "image", 5)
    if simulated:
        yield dot(edge_at(settings.angle, HANDLE_ROW), "world", 5)
    # A refusal is at the foot of the picture, or at its top if the rectangle is there.
    lines, below = wrap(refusal, WORDS), bottom < HEIGHT - ROOM
    first = HEIGHT - 14.0 - LINE * (len(lines) - 1) if below else HANDLE_ROW + 30.0
    for number, words in enumerate(lines):
        yield text((WIDTH / 2, first + LINE * number), words, "error ground", "middle")


def largest(sharpness: Sharpness) -> str:
    """MTF50 with its error."""
    if sharpness.refusal:
        return ""
    half = sharpness.half
    words = f"{value_with_error(half.frequency, half.error)} cycles/px"
    return text((12, HEIGHT - 16), words, "image large strong ground")


def kept_places(places: Sequence[KeptEdge]) -> Iterator[str]:
    """The rectangles that were kept, each with its MTF50 in cycles per pixel."""
    for place in places:
        box, half = place.box, place.sharpness.half.frequency
        wide, high = box.size
        x, y = box.at(0.5 * wide, 0.5 * high)
        frame = box.at(0, 0), wide / box.per_unit, high / box.per_unit
        words = "no MTF" if place.sharpness.refusal else format_number(half, 3)
        yield cased(rectangle, *frame, style="image thin")
        yield text((x, y + 5.0), words, "image small ground", "middle")


def in_panel(edge: EdgeLine, box: Box, x: float, y: float) -> Point:
    """A place from the middle of the picture as it was turned, in the panel."""
    across = -x if edge.mirrored else x
    column, row = (y, across) if edge.turned else (across, y)
    width, height = box.size
    return box.at(0.5 * width + column, 0.5 * height + row)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture, the light across the edge, and the contrast of waves."""
    sharpness: Sharpness = outputs["sharpness"]
    pixels, simulated = outputs["pixels"], outputs["photograph"] is None
    kept, refusal = kept_places(outputs["places"]), sharpness.refusal
    frame = over_picture(settings, outputs["box"], pixels, simulated, refusal)
    picture, over = outputs["shown"], "".join((*kept, *frame, largest(sharpness)))
    over_crop = over_wipe(0.5, WIDTH, HEIGHT, ("before", "after" if not refusal else "unknown"))
    x = axis_across(settings, sharpness.reading, simulated)
    across = "".join(light_across(pixels, sharpness.reading, x))
    product = "".join(line_and_wave(sharpness, settings.wave, x))
    waves, title = waves_left(sharpness, outputs["true"]), "What is left of a wave’s contrast: MTF"
    return Frame(
        (
            Panel(
                "picture", "The picture of an edge", *SIZE, picture, over, pixelated=True, lead=True
            ),
            Panel(
                "crop",
                "A cat’s eye, before and after",
                *SIZE,
                outputs["crop"],
                overlay=over_crop,
                pixelated=True,
            ),
            Panel("line", "Light across the edge, and its slope", *SIZE, overlay=across + product),
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
    scale, half = per_mm(settings), sharpness.half
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


def middle_pulled(
    _settings: Settings, place: Point, photograph: Photograph | None = None
) -> Mapping[str, Value]:
    """On a photograph, the middle of the edge near the place."""
    found = found_rectangle(photograph.codes, place) if photograph else {}
    here = {"x": 100.0 * place[0] / WIDTH, "y": 100.0 * place[1] / WIDTH}
    return {name: found.get(name, value) for name, value in here.items()}


def found(settings: Settings, outputs: Outputs) -> Mapping[str, Value]:
    """A rectangle over the edge near the middle of the present one."""
    return found_rectangle(outputs["codes"], settings.centre)


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


def sample(aperture: float, sharpening: float) -> Codes:
    """(480, 640, 3) a photograph of an edge with pixels of 4 µm."""
    return simulated(light(5.0, aperture, 4.0, size=(480, 640)), 1.0, sharpening)


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
            "rectangle",
            "picture",
            "Rectangle",
            drives=MIDDLE,
            at=middle_at,
            pull=middle_pulled,
            reach="press",
            role="image",
        ),
        Handle("spot", "line", "Lens’s spot", ("aperture",), spot_at, spot_pulled, role="light"),
        Handle("wave", "waves", "Wave", ("wave",), wave_at, wave_pulled, role="image"),
        Handle("keep", "line", "This place", ("kept",), nowhere, keep, reach="aim"),
        Handle("forget", "waves", "All places", ("kept",), nowhere, forget, reach="aim"),
    ),
    instrument=Instrument(
        photograph=Whole(MOST_MEGAPIXELS, mosaic=True),
        samples={
            f"at f-{aperture}, {what}.png": partial(sample, float(aperture), sharpening)
            for aperture in (4, 8, 16)
            for what, sharpening in (("as taken", 0.0), ("sharpened", 1.0))
        },
        exports=EXPORTS,
        sheet=sheet,
    ),
    sets={"find": found},
    formula=measure,
)
