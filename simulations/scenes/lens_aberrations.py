"""A simple lens in front of a test chart: colours of unlike size and sharpness, dark corners.

A single element of 24 mm focal length, focused at infinity for the d line. The three channels
stand for the Fraunhofer lines C, d and F. Corners lie 45° from the axis, 200 px from the centre.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import Choice, Slider, Toggle, Values
from simulations.engine.frame import Frame, Panel, format_number, readout
from simulations.engine.pipeline import Stage, StageCache, run
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.models.chromatic import (
    LINE_C_UM,
    LINE_D_UM,
    LINE_F_UM,
    Glass,
    axial_chromatic_mm,
    lateral_chromatic_scale,
)
from simulations.models.color import encode_srgb_table
from simulations.models.depth_of_field import Planes, disc_blur
from simulations.models.resampling import KERNELS
from simulations.models.vignetting import mechanical_vignetting, vignetting_cos4
from simulations.pictures.resolution_chart import resolution_chart
from simulations.scenes import lens_aberrations_drawing as drawing

type Floats = NDArray[np.floating]

WIDTH_PX, HEIGHT_PX = 320, 240
FOCAL_MM, FOCAL_PX = 24.0, 200.0
PITCH_MM = FOCAL_MM / FOCAL_PX
CORNER_PX = 200.0
"""From the centre to the corners."""
RIM_MM = 9.0
"""Radius of the lens barrel's front rim: just wider than the widest opening."""
LINES_UM = (LINE_C_UM, LINE_D_UM, LINE_F_UM)
"""Wavelengths of the red, green and blue channel."""
GLASSES = {
    "ideal": Glass(abbe_number=math.inf),
    "crown": Glass(),
    "flint": Glass(index_d=1.62, abbe_number=36.4),
}
CLOSE_TOP, CLOSE_LEFT = HEIGHT_PX - 48, WIDTH_PX - 64
"""The close-up: the last 64 × 48 px."""

CONTROLS = (
    Choice(
        name="glass",
        label="Glass",
        default="crown",
        options={
            "ideal": "Without dispersion",
            "crown": "Crown, V = 64.2",
            "flint": "Flint, V = 36.4",
        },
    ),
    Slider(
        name="stop",
        label="Stop before the lens",
        default=12,
        minimum=-15,
        maximum=15,
        step=1,
        unit="mm",
    ),
    Slider(
        name="aperture",
        label="Aperture",
        default=2.8,
        minimum=1.4,
        maximum=16,
        step=0.1,
        prefix="f/",
    ),
    Slider(
        name="rim",
        label="Rim before the stop",
        default=6,
        minimum=0,
        maximum=12,
        step=0.5,
        unit="mm",
    ),
    Toggle(name="natural", label="Natural vignetting, cos⁴", default=True),
)


@dataclass(frozen=True, slots=True)
class Colours:
    """What each channel suffers; three entries for red, green, blue."""

    scale: Floats
    """Size of the image relative to the green one."""
    disc_px: Floats
    """Diameter of the disc that a point becomes."""


def colours(glass: str, stop_mm: float, f_number: float) -> Colours:
    """Lateral and axial chromatic aberration of the lens."""
    kind, lines = GLASSES[glass], np.array(LINES_UM)
    return Colours(
        lateral_chromatic_scale(kind, FOCAL_MM, stop_mm, lines),
        axial_chromatic_mm(kind, FOCAL_MM, f_number, lines) / PITCH_MM,
    )


def light(
    tan_field: Floats, f_number: float, rim_mm: float, natural: bool
) -> tuple[Floats, Floats]:
    """Natural and mechanical vignetting (...) at tangents of the field angle: factors in [0, 1]."""
    opening_mm = FOCAL_MM / f_number / 2
    cos4 = vignetting_cos4(tan_field) if natural else np.ones_like(tan_field)
    return cos4, mechanical_vignetting(tan_field, opening_mm, RIM_MM, rim_mm)


def magnify(plane: NDArray[np.float32], scale: float) -> NDArray[np.float32]:
    """A plane (H, W) scaled about its centre by bicubic interpolation, one axis after the other."""
    if scale == 1.0:
        return plane
    return _magnify_rows(_magnify_rows(plane, scale).T, scale).T


def _magnify_rows(plane: NDArray[np.float32], scale: float) -> NDArray[np.float32]:
    size, kernel = plane.shape[0], KERNELS["bicubic"]
    middle = 0.5 * (size - 1)
    position = middle + (np.arange(size) - middle) / scale
    base = np.floor(position)
    result = np.zeros_like(plane)
    for tap in range(-1, 3):
        weight = kernel.weigh(base + tap - position).astype(np.float32)
        result += weight[:, None] * plane[np.clip(base.astype(int) + tap, 0, size - 1)]
    return result


def _chart() -> Planes:
    """(3, H, W), 8 px wider all round: no colour is enlarged or reduced beyond that."""
    chart = resolution_chart(WIDTH_PX + 16, HEIGHT_PX + 16, FOCAL_PX)
    return np.ascontiguousarray(chart.transpose(2, 0, 1))


def _lateral(chart: Planes, glass: str, stop: float) -> Planes:
    scales = colours(glass, stop, math.inf).scale
    scaled = [magnify(plane, float(s)) for plane, s in zip(chart, scales, strict=True)]
    return np.stack(scaled)[:, 8:-8, 8:-8]


def _axial(planes: Planes, glass: str, aperture: float) -> Planes:
    discs = colours(glass, 0.0, aperture).disc_px
    blurred = [disc_blur(planes[c : c + 1], float(discs[c]) / 2) for c in range(3)]
    return np.concatenate(blurred)


def _vignetting(aperture: float, rim: float, natural: bool) -> NDArray[np.float32]:
    """(H, W) factor; the tables of a radial function are read at each pixel's radius."""
    tangents = np.linspace(0, 1.01, 256)
    cos4, open_share = light(tangents, aperture, rim, natural)
    x = (np.arange(WIDTH_PX) - 0.5 * (WIDTH_PX - 1)) / FOCAL_PX
    y = (np.arange(HEIGHT_PX) - 0.5 * (HEIGHT_PX - 1)) / FOCAL_PX
    radius = np.hypot(x, y[:, None])
    factor: NDArray[np.float32] = np.interp(radius, tangents, cos4 * open_share).astype(np.float32)
    return factor


def _encode(planes: Planes, factor: NDArray[np.float32]) -> NDArray[np.uint8]:
    return to_rgba8(encode_srgb_table(np.clip(planes * factor, 0, 1).transpose(1, 2, 0)))


def _all_sharp(values: Values) -> str:
    discs = colours(values.choice("glass"), 0.0, values.number("aperture")).disc_px
    return "" if discs.max() > 1 else "no colour's disc is wider than a pixel"


STAGES = (
    Stage("chart", (), _chart),
    Stage("lateral", ("glass", "stop"), _lateral, ("chart",)),
    Stage("axial", ("glass", "aperture"), _axial, ("lateral",), _all_sharp),
    Stage("vignetting", ("aperture", "rim", "natural"), _vignetting),
    Stage("encoded", (), _encode, ("axial", "vignetting")),
)


def render(values: Values, tier: str, cache: StageCache) -> Frame:  # noqa: ARG001 - no tiers
    done = run(STAGES, values, cache)
    picture: NDArray[np.uint8] = done.outputs["encoded"]
    f_number, rim = values.number("aperture"), values.number("rim")
    lens = colours(values.choice("glass"), values.number("stop"), f_number)
    tangents = np.linspace(0.0, 1.0, 61)
    cos4, open_share = light(tangents, f_number, rim, values.toggle("natural"))
    shifts_px = CORNER_PX * (lens.scale - 1)
    close = np.ascontiguousarray(picture[CLOSE_TOP:, CLOSE_LEFT:])
    width, height = drawing.WIDTH, drawing.HEIGHT
    frame = drawing.close_up_frame(CLOSE_LEFT / WIDTH_PX, CLOSE_TOP / HEIGHT_PX)
    plot = drawing.profile(tangents, cos4, open_share, (float(shifts_px[0]), float(shifts_px[2])))
    panels = (
        Panel("picture", "Through the lens", width, height, picture, frame),
        Panel("corner", "The corner, enlarged", width, height, close, pixelated=True),
        Panel("profile", "From the centre to the corner", width, height, overlay=plot),
    )
    corner = (float(cos4[-1]), float(open_share[-1]))
    readouts = (
        readout("lateral", "Red to blue, corner", shifts_px[2] - shifts_px[0], "px", role="error"),
        readout("red_disc", "Red disc", lens.disc_px[0], "px"),
        readout("blue_disc", "Blue disc", lens.disc_px[2], "px"),
        readout("natural_stops", "Natural falloff", stops(corner[0]), "stops", role="light"),
        readout("rim_stops", "Cut by the rim", stops(corner[1]), "stops", role="camera"),
        readout("corner_stops", "Corner, together", stops(corner[0] * corner[1]), "stops"),
    )
    return Frame(panels, readouts, describe(values, lens, corner), done.reports)


def stops(factor: float) -> float:
    """A factor of light in powers of two; no light is −∞ stops."""
    return math.log2(factor) if factor > 0 else -math.inf


def describe(values: Values, lens: Colours, corner: tuple[float, float]) -> str:
    """The picture in one sentence."""
    apart = CORNER_PX * float(lens.scale[2] - lens.scale[0])
    if abs(apart) < 0.005:
        fringe = "no coloured fringes in the corners"
    else:
        larger = "blue larger than red" if apart > 0 else "red larger than blue"
        fringe = f"{larger}, {format_number(abs(apart), 1)} pixels apart in the corners"
    widest = float(lens.disc_px.max())
    soft = f"discs of up to {widest:.1f} pixels" if widest > 1 else "all colours sharp"
    share = corner[0] * corner[1]
    return (
        f"A test chart through a simple lens at f/{values.number('aperture'):.1f}: {fringe}, "
        f"{soft}, and {share:.0%} of the centre's light in the corners."
    )


SCENE = Scene(id="lens-aberrations", title="Lens Aberrations", controls=CONTROLS, render=render)
