"""A light on a surface: the spectrum that comes back, and its colour to the eye.

A few sums over 81 wavelengths: no tiers.
"""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np

from simulations.engine.drawing import circle, dot, polygon, polyline, text
from simulations.engine.frame import Frame, Panel, Raster, format_number, readout
from simulations.engine.handles import Handle
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.color import cie
from simulations.models.color.chromatic_adaptation import adapt
from simulations.models.color.chromaticity import lab_distance, xyz_to_xyy
from simulations.models.color.illuminants import DAYLIGHT_K
from simulations.models.color.observer import matching_functions, tristimulus
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.srgb import encode_srgb
from simulations.models.color.surfaces import LEAST, MOST
from simulations.scenes import _spectra
from simulations.scenes._spectra import (
    CELL,
    DAYLIGHT,
    HEIGHT,
    LEFT,
    NAMES,
    UNIT,
    WIDTH,
    Chart,
    LitSurface,
)

ROWS = (("this light", "world"), ("by day", "world"))
VISIBLE = 2.0  # just noticeable ΔE

HALF_HEIGHT = math.sqrt(2.0 * math.log(2.0))
"""Standard deviations from the peak of a bell to half its height."""
LEGEND = 24.0  # row of the names of the curves

UNITS = 310.0  # of the view box per unit of x and of y
DIAGRAM = Plot(Axis(0.0, 0.82, 44.0, 298.2), Axis(0.0, 0.88, 284.0, 11.2))
TICKS = Scale(ticks=(0.4, 0.8), grid=(0.2, 0.4, 0.6, 0.8))
PURE_NM = np.arange(444.0, 641.0, 4.0)
"""Wavelengths of the edge of all colours: beyond these it hardly moves, and the fits are
inaccurate."""
MARKED_NM = (490, 600)


@dataclass(frozen=True, slots=True)
class EyeResponse:
    """Twelve surfaces to the eye, and their twins in a second row: (2, 12, 3) each."""

    xyz: Floats  # XYZ in this light; white has Y = 1
    white_xy: tuple[float, float]  # chromaticity of the light itself
    here: Floats  # linear sRGB seen by an eye that is adapted to this light
    by_day: Floats  # linear sRGB seen in daylight
    apart: Floats  # (12,) ΔE of the twins in this light


def chart(twin: bool) -> Chart:
    """Rows that touch, so that the edge between two patches is their difference; with a twin below
    each surface, the difference of these is that edge."""
    return Chart(ROWS, 120) if twin else Chart(ROWS, 128, gap=0)


def eye_response(light: Floats, pairs: Floats) -> EyeResponse:
    xyz = tristimulus(pairs * light, light)
    x, y = white_xy(light)
    original, twin = cie.xyz_to_lab(xyz, (x, y))
    return EyeResponse(
        xyz=xyz,
        white_xy=(x, y),
        here=cie.xyz_to_linear_rgb(adapt(xyz, (x, y), cie.D65_XY)),
        by_day=cie.xyz_to_linear_rgb(tristimulus(pairs * DAYLIGHT, DAYLIGHT)),
        apart=lab_distance(original, twin),
    )


def white_xy(light: Floats) -> tuple[float, float]:
    x, y = xyz_to_xyy(tristimulus(light, light))[:2].tolist()
    return x, y


def picture(response: EyeResponse, twin: bool) -> Raster:
    """The surfaces, hung side by side like cloths; twins in the lower halves."""
    flat = chart(twin).paint((response.here, response.by_day), twin=twin)
    cloths = flat.repeat(UNIT, axis=0).repeat(UNIT, axis=1)
    for channel in range(3):  # faster than all channels in one product
        cloths[..., channel] = np.rint(cloths[..., channel] * folds())
    return cloths


@cache
def folds() -> Floats:
    """(H, W) by how much the folds darken the cloths; not at all along the middle of each."""
    down, across = np.mgrid[:HEIGHT, :WIDTH] + 0.5
    aside = 2.0 * ((across - LEFT) / CELL % 1.0) - 1.0
    swing = aside + 0.22 * (1.0 - aside**2) * np.sin(down / 37.0 + 2.6 * ((across - LEFT) // CELL))
    return np.asarray(1.0 - 0.34 * np.abs(swing) ** 2.5)


STAGES = (
    Stage("light", _spectra.light_of),
    Stage("surfaces", _spectra.surfaces_of),
    Stage("pairs", _spectra.with_twins, ("surfaces",)),
    Stage("seen", eye_response, ("light", "pairs")),
    Stage("picture", picture, ("seen",)),
)


def spectra(light: Floats, pair: Floats, *, twin: bool, cloth: bool) -> str:
    """The light, the reflectance (2, 81) of a surface and its twin, and the reflected light."""
    height = light / light.max()
    parts = [
        _spectra.axes(),
        _spectra.curve(height * pair[0], "ray"),
        _spectra.curve(height, "light"),
        _spectra.curve(pair[1], "world dashed") if twin else "",
        _spectra.curve(pair[0], "world bold"),
        text((40, LEGEND), "light", "light strong"),
        text((80, LEGEND), "× surface", "world strong"),
        text((154, LEGEND), "= what it sends back", "ray strong"),
    ]
    if twin:
        parts.append(text((386, LEGEND + 17), "twin, dashed", "world small ground", "end"))
    if cloth:
        band = float(WAVELENGTHS_NM[pair[0].argmax()])
        parts.append(dot(_spectra.PLOT.at(band, MOST), "world", 4.5))
    return "".join(parts)


@cache
def whites(light: str) -> Floats:
    """Chromaticities (N, 2) of one kind of light, by steps of its slider of temperature."""
    kelvin = np.arange(_spectra.COOLEST_K, _spectra.HOTTEST_K + 1.0, _spectra.STEP_K)
    if light == "daylight":
        kelvin = kelvin[kelvin >= DAYLIGHT_K[0]]
    return np.array([white_xy(_spectra.light_of(light, each)) for each in kelvin.tolist()])


def diagram(light: str, response: EyeResponse, chosen: int, *, twin: bool) -> str:
    """Chromaticities of pure colours, the display's gamut, the whites, and the surfaces."""
    pairs = xyz_to_xyy(response.xyz)[..., :2]
    line = whites(light if light == "daylight" else "planck")
    here = DIAGRAM.at(*pairs[0, chosen])
    parts = [
        diagram_ground(),
        *(polyline([DIAGRAM.at(*xy) for xy in line[::4]], style) for style in ("casing", "light")),
        *(circle(DIAGRAM.at(*xy), 3, "casing") for xy in pairs[0]),
        *(dot(DIAGRAM.at(*xy), "world", 3) for xy in pairs[0]),
        *(circle(DIAGRAM.at(*cie.D65_XY), 4, style) for style in ("casing", "")),
        dot(DIAGRAM.at(*response.white_xy), "light", 5),
    ]
    if twin:
        other = DIAGRAM.at(*pairs[1, chosen])
        parts += [circle(other, 5.5, style) for style in ("casing", "world bold")]
    return "".join((*parts, circle(here, 5, "casing"), dot(here, "ray", 5)))


@cache
def diagram_ground() -> str:
    """Axes, the edge of all colours, and the display's triangle."""
    edge = xyz_to_xyy(matching_functions(PURE_NM))[:, :2]
    marked = xyz_to_xyy(matching_functions(np.array(MARKED_NM)))[:, :2]
    corner = DIAGRAM.at(0, 0)
    parts = [
        DIAGRAM.frame(TICKS, TICKS),
        text((DIAGRAM.x.end + 8, corner[1] + 19), "x", "italic"),
        text((corner[0] - 8, DIAGRAM.y.end + 2), "y", "italic", "end"),
        polygon([DIAGRAM.at(*xy) for xy in edge], "world thin"),
        polygon([DIAGRAM.at(*xy) for xy in cie.SRGB_PRIMARIES_XY], "casing"),
        polygon([DIAGRAM.at(*xy) for xy in cie.SRGB_PRIMARIES_XY], "image"),
        text(DIAGRAM.at(0.24, 0.14), "sRGB", "image small ground", "middle"),
    ]
    for nm, xy in zip(MARKED_NM, marked, strict=True):
        x, y = DIAGRAM.at(*xy)
        parts.append(dot((x, y), "world", 2))
        parts.append(text((x + 9, y - 4), f"{nm} nm", "world small ground"))
    return "".join(parts)


@cache
def horseshoe() -> Raster:
    """(H, W, 4) each chromaticity as a display shows it, or the nearest that it can."""
    across, down = np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5
    right, up = across - DIAGRAM.x.start, DIAGRAM.y.start - down
    x, y = np.meshgrid(right / UNITS, up / UNITS)
    edge = xyz_to_xyy(matching_functions(PURE_NM))[:, :2]
    ahead = np.roll(edge, -1, axis=0) - edge
    inside = np.full(x.shape, np.inf)
    for (x_0, y_0), (dx, dy) in zip(edge.tolist(), ahead.tolist(), strict=True):
        off = (dy * (x - x_0) - dx * (y - y_0)) / math.hypot(dx, dy)
        inside = np.minimum(inside, off)
    xyz = np.stack([x, y, 1.0 - x - y], axis=-1)
    linear = np.maximum(cie.xyz_to_linear_rgb(xyz), 0.0)
    bright = linear / np.maximum(linear.max(axis=-1, keepdims=True), 1e-9)
    return to_rgba8(encode_srgb(bright), np.clip(0.5 + UNITS * inside, 0.0, 1.0))


def draw(settings: LitSurface, outputs: Outputs) -> Frame:
    response: EyeResponse = outputs["seen"]
    chosen = NAMES.index(settings.surface)
    pair, light = outputs["pairs"][:, chosen], outputs["light"]
    curves = spectra(light, pair, twin=settings.twin, cloth=settings.surface == "cloth")
    sent_back = _spectra.colours_under(light / light.max() * pair[0])
    colours = diagram(settings.light, response, chosen, twin=settings.twin)
    patches, names = outputs["picture"], chart(settings.twin).overlay(settings.surface)
    size = WIDTH, HEIGHT
    x, y, luminance = xyz_to_xyy(response.xyz[0, chosen]).tolist()
    return Frame(
        (
            Panel("light", "Light × cloth", *size, sent_back, curves, lead=True),
            Panel("patches", "What the eye sees", *size, patches, names),
            Panel("diagram", "Colours without brightness", *size, horseshoe(), colours),
        ),
        (
            readout("x", "Chromaticity x", x, digits=3, role="world"),
            readout("y", "Chromaticity y", y, digits=3, role="world"),
            readout("luminance", "Luminance Y", luminance, "of white", digits=3, role="world"),
            readout("apart", "Difference from the twin", response.apart[chosen], "ΔE", digits=1),
        ),
        describe(settings, response, chosen),
    )


def describe(settings: LitSurface, response: EyeResponse, chosen: int) -> str:
    x, y = (format_number(float(each), 3) for each in xyz_to_xyy(response.xyz[0, chosen])[:2])
    sentence = f"{_spectra.lit_surface(settings)} has the chromaticity x = {x}, y = {y}"
    if _spectra.outside_gamut(response.by_day[0, chosen]):
        sentence += ", and by day a colour that no display can show"
    if settings.twin:
        another = "another" if response.apart[chosen] > VISIBLE else "the same"
        sentence += f"; its twin is {another} colour to the eye"
    return f"{sentence}."


def band_mark(settings: LitSurface, _outputs: Outputs) -> tuple[float, float] | None:
    """The peak of the cloth's band."""
    return _spectra.PLOT.at(settings.band, MOST) if settings.surface == "cloth" else None


def width_mark(settings: LitSurface, _outputs: Outputs) -> tuple[float, float] | None:
    """Half the height of the band, on the right."""
    if settings.surface != "cloth":
        return None
    beside = settings.band + HALF_HEIGHT * settings.width
    return _spectra.PLOT.at(beside, 0.5 * (LEAST + MOST))


def white_mark(settings: LitSurface, _outputs: Outputs) -> tuple[float, float] | None:
    if settings.light not in ("planck", "daylight"):
        return None
    return DIAGRAM.at(*white_xy(_spectra.light_of(settings.light, settings.temperature)))


TEMPERATURE = ("temperature",)
HANDLES: tuple[Handle[LitSurface], ...] = (
    Handle("band", "light", "Band of the cloth", ("band",), band_mark, role="world"),
    Handle("width", "light", "Width of the band", ("width",), width_mark, role="world"),
    _spectra.SURFACE,
    Handle(
        "white",
        "diagram",
        "White of the light",
        drives=TEMPERATURE,
        at=white_mark,
        role="light",
        reversed=TEMPERATURE,
    ),
)
SCENE = Scene(
    "light-and-cloth", "Light on a Cloth", LitSurface, draw, STAGES, HANDLES, formula=tristimulus
)
