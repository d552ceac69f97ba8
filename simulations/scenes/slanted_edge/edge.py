"""The picture of an edge, the rectangle over it, and the MTF measured in it.

The picture is fitted into the panel, so that settings and handles need not know its size: they are
shares of the panel's width.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from simulations.engine.controls import PointLists
from simulations.engine.frame import Raster
from simulations.engine.handles import Point
from simulations.engine.photograph import Codes, Mosaic, Photograph
from simulations.engine.raster import to_rgba8
from simulations.engine.reading import Readings
from simulations.engine.settings import action, choice, points, slider
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.color.tone_curve import TYPICAL
from simulations.models.lens.diffraction import lens_transfer
from simulations.models.sampling.aliasing import filter_and_sample, gaussian_kernel
from simulations.models.sampling.slanted_edge import FREQUENCIES, EdgeReading, HalfContrast, measure
from simulations.models.sampling.slanted_edge_cells import light_of_cells, line_of_cells
from simulations.models.sampling.slanted_edge_file import light_of_code, light_of_codes
from simulations.models.sampling.slanted_edge_line import UnfitEdgeError
from simulations.models.sampling.slanted_edge_picture import edge_picture, edge_transfer
from simulations.models.sampling.slanted_edge_pixels import EdgePixels, locate_edge, pixels_beside
from simulations.models.sampling.slanted_edge_search import edge_near
from simulations.models.sampling.slanted_edge_tone import tone_error
from simulations.models.sensor.photon_transfer_file import is_grey, model_of
from simulations.models.sensor.resolution import pixel_pitch_um
from simulations.scenes._cat import blurred, sharp
from simulations.scenes._wipe import wiped

WIDTH, HEIGHT = 400.0, 300.0  # of the panel
ROWS, COLUMNS = 120, 160  # of the simulated picture
DARK, STEP = 0.12, 0.7  # light of its dark side, and of the step: room for halos at both ends
HALO_PX = 1.0  # σ of the blur whose difference from the picture sharpens it
WAVELENGTH_UM = 0.55
SHORT_UM, NARROW = 0.5, 0.7  # waves and, in pixels, their width in the limit that no edge exceeds
MOST_SHOWN = 1200  # largest side in px at which a photograph is shown; it is measured in full
SEARCHED = 400  # largest side in px of the picture in which an edge is looked for
MOST_KEPT = 8  # places
CROP = (slice(None), slice(41, 101), slice(31, 111))  # an eye of the cat
UNSEEN = 0.1  # of MTF50: half of the sharpening that may raise it unseen in a developed file
OTHER_COLOURS = (
    "The cells of this file see other colours than red, green and blue: use a JPEG or PNG."
)
SCALED = (
    "This picture was scaled down, which changes its sharpness: save the part around the edge as a "
    "smaller file, without scaling."
)


@dataclass(frozen=True, slots=True)
class Settings:
    """Slant, aperture, noise and sharpening are those of the simulated picture; the rectangle is in
    shares of the panel's width."""

    angle: float = slider("Slant of the edge", 5, 0, 40, 0.5, unit="°")
    aperture: float = slider("Aperture", 8, 2.8, 22, 0.1, prefix="f/")
    pitch: float = slider("Pixel pitch p", 4, 0.5, 10, 0.1, unit="µm")
    wave: float = slider("Wave over the line", 0.25, 0, 1, 0.01, unit="cycles/px")
    noise: float = slider("Noise", 1, 0.3, 3, 0.1, unit="% of the step")
    sharpening: float = slider("Sharpening", 0, 0, 1.5, 0.1)
    response: str = choice(
        "Codes of the file", {"srgb": "sRGB", "linear": "Proportional to the light"}
    )
    x: float = slider("Rectangle, from the left", 50, 0, 100, 0.5, unit="%")
    y: float = slider("Rectangle, from the top", 37.5, 0, 75, 0.5, unit="%")
    width: float = slider("Rectangle, width", 40, 1, 60, 0.5, unit="%")
    height: float = slider("Rectangle, height", 30, 1, 60, 0.5, unit="%")
    find: int = action("Find the edge near it", effect="set")
    kept: str = points(
        "Places kept", 1, 2 * MOST_KEPT, buttons={"keep": "Keep this place", "forget": "Forget all"}
    )

    @property
    def centre(self) -> Point:
        """Place of the rectangle's middle in the panel."""
        return (0.01 * WIDTH * self.x, 0.01 * WIDTH * self.y)

    @property
    def corner(self) -> Point:
        """Place of its lower right corner."""
        across, down = self.centre
        return (across + 0.005 * WIDTH * self.width, down + 0.005 * WIDTH * self.height)

    @property
    def opposite(self) -> Point:
        """Place of its upper left corner."""
        (across, down), (right, bottom) = self.centre, self.corner
        return (2 * across - right, 2 * down - bottom)


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle of whole pixels in a picture that is fitted into the panel."""

    left: int
    top: int
    right: int
    bottom: int
    per_unit: float
    """Pixels of the picture per unit of the panel."""
    corner: tuple[float, float]
    """Place of the picture's upper left corner in the panel."""

    @property
    def off_middle(self) -> float:
        """Distance from the middle of the picture, in % of its half diagonal."""
        (across, down), (left, top) = self.at(0.5 * self.size[0], 0.5 * self.size[1]), self.corner
        away = math.hypot(across - 0.5 * WIDTH, down - 0.5 * HEIGHT)
        return 100.0 * away / math.hypot(0.5 * WIDTH - left, 0.5 * HEIGHT - top)

    @property
    def rows(self) -> slice:
        """Of the picture."""
        return slice(self.top, self.bottom)

    @property
    def columns(self) -> slice:
        """Of the picture."""
        return slice(self.left, self.right)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self.right - self.left, self.bottom - self.top

    def at(self, column: float, row: float) -> Point:
        """A place in the panel, given from the box's upper left corner, in pixels."""
        (across, down), unit = self.corner, self.per_unit
        return across + (self.left + column) / unit, down + (self.top + row) / unit


def box_in(picture: tuple[int, int], centre: tuple[float, float], size: tuple[float, float]) -> Box:
    """The pixels of a picture (width, height) under a rectangle in % of the panel's width.

    They end where the picture does; there may be none.
    """
    width, height = picture
    per_unit = max(width / WIDTH, height / HEIGHT)
    corner = (0.5 * (WIDTH - width / per_unit), 0.5 * (HEIGHT - height / per_unit))
    ends = [
        min(max(round((0.01 * WIDTH * (middle + side * whole) - start) * per_unit), 0), pixels)
        for middle, whole, start, pixels in zip(centre, size, corner, picture, strict=True)
        for side in (-0.5, 0.5)
    ]
    return Box(ends[0], ends[2], ends[1], ends[3], per_unit, corner)


@dataclass(frozen=True, slots=True)
class Sharpness:
    """The measurement of an edge, or why there is none."""

    reading: EdgeReading | None
    half: HalfContrast
    contrast: Floats
    """(51,) MTF at `FREQUENCIES`; NaN where there is none."""
    error: Floats
    """(51,) its standard error."""
    refusal: str = ""
    """The fault of the rectangle; empty if there is none."""
    tone: float = 0.0
    """Part of the error of MTF50 that is due to an unknown tone curve, in cycles per pixel."""
    sharpened: bool = False
    unseen: float = 0.0
    """Part of the error of MTF50 that is due to sharpening that a file may have and not show."""
    channels: tuple[EdgeReading, ...] = ()
    """Measurements of red, green and blue in a colour photograph."""
    colour: float = 0.0
    """Part of the error of MTF50 by which a colour differs from the luminance, beyond its own
    error: lateral colour blurs the luminance, and sharpens no colour. 0 for the green cells of a
    raw file."""


@dataclass(frozen=True, slots=True)
class KeptEdge:
    """A rectangle that was kept, and the measurement of its edge."""

    box: Box
    sharpness: Sharpness


def lens_factor(frequency: Floats, aperture: float, pitch: float) -> Floats:
    """Factor (...) of the lens on waves (...) in cycles per pixel."""
    return lens_transfer(1000.0 / pitch * frequency, WAVELENGTH_UM, aperture)


def light(
    angle: float, aperture: float, pitch: float, size: tuple[int, int] = (ROWS, COLUMNS)
) -> Floats:
    """(H, W) light in each pixel of a picture of this height and width, without noise."""
    slant = math.radians(angle)
    edge = edge_picture(*size, slant, lambda f: lens_factor(f, aperture, pitch))
    return DARK + STEP * edge


def simulated(light: Floats, noise: float, sharpening: float) -> Codes:
    """(H, W, 3) the file, with the same noise each time."""
    taken = light + np.random.default_rng(0).normal(0.0, 0.01 * noise * STEP, light.shape)
    soft = filter_and_sample(taken, 1, gaussian_kernel(HALO_PX))
    taken += sharpening * (taken - soft)
    return to_rgba8(encode_srgb(np.clip(taken, 0.0, 1.0)))[..., :3]


def reader_codes(photograph: Photograph) -> Codes:
    """(H, W, 3) the reader's file."""
    return photograph.codes


def none_given(photograph: Photograph | None) -> str:
    return "" if photograph else "no photograph was chosen"


def panel_picture(codes: Codes) -> Codes:
    """(H', W', 4) the picture in the panel, on a transparent ground: small enough to be painted."""
    apart = math.ceil(max(codes.shape[:2]) / MOST_SHOWN)
    small = codes if apart == 1 else reduced(codes, apart)
    height, width = small.shape[:2]
    wide = max(width, round(height * WIDTH / HEIGHT))
    high = max(height, round(width * HEIGHT / WIDTH))
    picture = np.zeros((high, wide, 4), np.uint8)
    top, left = (high - height) // 2, (wide - width) // 2
    picture[top : top + height, left : left + width, :3] = small
    picture[top : top + height, left : left + width, 3] = 255
    return picture


def reduced(codes: Codes, apart: int) -> Codes:
    """Means over squares of so many pixels a side."""
    height, width = (side // apart * apart for side in codes.shape[:2])
    total = np.zeros((height // apart, width // apart, 3), np.uint16)
    for down in range(apart):
        for across in range(apart):
            total += codes[down:height:apart, across:width:apart]
    return (total // (apart * apart)).astype(np.uint8)


def found_rectangle(codes: Codes, place: Point) -> dict[str, float]:
    """The settings of a rectangle over the edge near a place of the panel; none if there is no
    edge."""
    apart = math.ceil(max(codes.shape[:2]) / SEARCHED)
    small = reduced(codes, apart)
    whole = box_in((small.shape[1], small.shape[0]), (0.0, 0.0), (0.0, 0.0))
    (left, top), unit = whole.corner, whole.per_unit
    grey = decode_srgb(small.mean(axis=2) / 255)
    near = edge_near(grey, unit * (place[0] - left), unit * (place[1] - top))
    if near is None:
        return {}
    x, y, width, height = (side / unit for side in near)
    found = {"x": x + left, "y": y + top, "width": width, "height": height}
    return {name: 100.0 * side / WIDTH for name, side in found.items()}


def chosen_box(
    codes: Codes, x: float, y: float, width: float, height: float, photograph: Photograph | None
) -> Box:
    """Of a raw file its cells, whole quads of them."""
    if photograph is None or photograph.mosaic is None:
        return box_in((codes.shape[1], codes.shape[0]), (x, y), (width, height))
    rows, columns = photograph.mosaic.codes.shape
    quads = box_in((columns // 2, rows // 2), (x, y), (width, height))
    (left, top), (right, bottom) = (quads.left, quads.top), (quads.right, quads.bottom)
    return Box(2 * left, 2 * top, 2 * right, 2 * bottom, 2 * quads.per_unit, quads.corner)


@dataclass(frozen=True, slots=True)
class Tone:
    """A camera's tone curve on top of sRGB."""

    strength: float = 0.0
    error: float = 0.0


def tone_of(photograph: Photograph | None, response: str, readings: Readings) -> Tone:
    """The curve of the same camera that exposures told on this page, or an unknown one; none in raw
    files, developed by the page."""
    if photograph is None or response != "srgb" or "raw" in photograph.facts:
        return Tone()
    for reading in readings:
        curve = reading.data["tone_curve"]
        is_same = reading.data["model"] == model_of(photograph.facts)
        if is_same and curve.get("standard_error", TYPICAL) < TYPICAL:
            return Tone(curve["value"], curve["standard_error"])
    return Tone(error=TYPICAL)


def edge_pixels(
    codes: Codes, box: Box, tone: Tone, response: str, photograph: Photograph | None
) -> EdgePixels | str:
    """The pixels of the edge in the rectangle, or the fault of the picture or the rectangle; of a
    raw file the green cells."""
    mosaic = photograph.mosaic if photograph else None
    try:
        if mosaic is not None:
            light = cells_in(box, mosaic)
            return pixels_beside(line_of_cells(light).on(light[..., 1]))
        if photograph is not None and photograph.is_scaled:
            return SCALED
        cut = codes[box.rows, box.columns]
        return locate_edge(light_of_codes(cut, srgb=response == "srgb", tone=tone.strength))
    except UnfitEdgeError as problem:
        return str(problem)


def cells_in(box: Box, mosaic: Mosaic) -> Floats:
    """(H, W, 3) light of a raw file's cells."""
    if set(mosaic.colours) != set("RGB"):
        raise UnfitEdgeError(OTHER_COLOURS)
    cut = mosaic.codes[box.rows, box.columns]
    return light_of_cells(cut, mosaic.colours, mosaic.black, mosaic.white)


def most_contrast(aperture: float, pitch: float, photograph: Photograph | None) -> Floats | float:
    """(51,) what diffraction lets through, generously; 1 if the file says no aperture or pitch."""
    if photograph is not None:
        aperture = float(photograph.facts.get("f_number", 0.0))
        pitch = pitch_um(photograph) or 0.0
    if not (aperture > 0.0 and pitch > 0.0):
        return 1.0
    through = lens_transfer(1000.0 / pitch * FREQUENCIES, SHORT_UM, aperture)
    return np.asarray(through * np.sinc(NARROW * FREQUENCIES))


def pitch_um(photograph: Photograph | None) -> float | None:
    """The pixel pitch, if the file gives the focal length and its full-frame equivalent."""
    names = ("focal_mm", "focal_35mm_mm", "full_width", "full_height")
    facts = {} if photograph is None else photograph.facts
    given = [float(facts[name]) for name in names if name in facts]
    return pixel_pitch_um(*given) if len(given) == len(names) and min(given) > 0 else None


def channels(
    codes: Codes,
    box: Box,
    pixels: EdgePixels,
    tone: Tone,
    response: str,
    photograph: Photograph | None,
) -> tuple[EdgeReading, ...]:
    """Red, green and blue, along the line that was found; none for a grey file."""
    cut = codes[box.rows, box.columns]
    if photograph is None or (photograph.mosaic is None and is_grey(cut)):
        return ()
    try:
        light = (
            cells_in(box, photograph.mosaic)
            if photograph.mosaic
            else light_of_code(srgb=response == "srgb", tone=tone.strength)[cut]
        )
        return tuple(measure(pixels_beside(pixels.line.on(light[..., k]))) for k in range(3))
    except UnfitEdgeError:
        return ()


def sharpness(
    codes: Codes,
    box: Box,
    pixels: EdgePixels | str,
    tone: Tone,
    response: str,
    aperture: float,
    pitch: float,
    photograph: Photograph | None,
) -> Sharpness:
    """Sharpness of the edge in a box of a photograph, or the reason why there is none."""
    unknown = np.full(FREQUENCIES.shape, np.nan)
    nothing = Sharpness(None, HalfContrast(np.nan, np.nan), unknown, unknown)
    if isinstance(pixels, str):
        return replace(nothing, refusal=pixels)
    try:
        reading = measure(pixels)
    except UnfitEdgeError as problem:
        return replace(nothing, refusal=str(problem))
    half = reading.half_contrast()
    by_tone = tone_error(reading, tone.error) if tone.error else 0.0
    each = channels(codes, box, pixels, tone, response, photograph)
    mixed = () if photograph and photograph.mosaic else each
    halves = [one.half_contrast() for one in mixed]
    apart = [abs(one.frequency - half.frequency) - one.error for one in halves]
    by_colour = max((off for off in apart if math.isfinite(off)), default=0.0)
    by_colour = max(by_colour, 0.0)
    sharpened = reading.is_sharpened(most_contrast(aperture, pitch, photograph))
    is_known = sharpened or not tone.error or math.isinf(half.frequency)
    unseen = 0.0 if is_known else UNSEEN * half.frequency
    return Sharpness(
        reading,
        replace(half, error=math.hypot(half.error, by_tone, by_colour, unseen)),
        *reading.transfer(FREQUENCIES),
        tone=by_tone,
        sharpened=sharpened,
        unseen=unseen,
        channels=each,
        colour=by_colour,
    )


def kept_edges(
    codes: Codes,
    tone: Tone,
    kept: str,
    response: str,
    aperture: float,
    pitch: float,
    photograph: Photograph | None,
) -> tuple[KeptEdge, ...]:
    """The rectangles that were kept: pairs of opposite corners, as shares of the panel."""
    corners = PointLists.from_text(kept).lists[0] if kept else ()
    tall, found = 100.0 * HEIGHT / WIDTH, []
    for (left, top), (right, bottom) in zip(corners[::2], corners[1::2], strict=False):
        centre = 50.0 * (left + right), 0.5 * tall * (top + bottom)
        sides = 100.0 * (right - left), tall * (bottom - top)
        box = chosen_box(codes, *centre, *sides, photograph)
        pixels = edge_pixels(codes, box, tone, response, photograph)
        by = response, aperture, pitch, photograph
        found.append(KeptEdge(box, sharpness(codes, box, pixels, tone, *by)))
    return tuple(found)


def through(sharpness: Sharpness) -> Raster:
    """(60, 80, 4) an eye of a cat, its right half with the contrast that the edge has kept.

    Waves of all directions are weakened alike.
    """

    def weakened(down: Floats, across: Floats) -> Floats:
        return np.interp(np.hypot(down, across), FREQUENCIES, sharpness.contrast)

    planes = sharp(), sharp() if sharpness.refusal else blurred(weakened)
    before, after = (to_rgba8(encode_srgb(each[CROP].transpose(1, 2, 0))) for each in planes)
    return wiped(before, after, 0.5)


def true_transfer(
    angle: float, aperture: float, pitch: float, photograph: Photograph | None
) -> Floats:
    """(51,) MTF by the formulae of lens and pixel; NaN for a photograph."""
    if photograph is not None:
        return np.full(FREQUENCIES.shape, np.nan)
    pixel = edge_transfer(FREQUENCIES, math.radians(angle))
    return np.abs(lens_factor(FREQUENCIES, aperture, pitch) * pixel)


STAGES = (
    Stage("light", light),
    Stage("simulated", simulated, ("light",)),
    Stage("codes", reader_codes, neutral=none_given, passes_on="simulated"),
    Stage("shown", panel_picture, ("codes",)),
    Stage("box", chosen_box, ("codes",)),
    Stage("tone", tone_of),
    Stage("pixels", edge_pixels, ("codes", "box", "tone")),
    Stage("sharpness", sharpness, ("codes", "box", "pixels", "tone")),
    Stage("places", kept_edges, ("codes", "tone")),
    Stage("crop", through, ("sharpness",)),
    Stage("true", true_transfer),
)
