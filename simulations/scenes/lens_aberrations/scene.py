"""A simple lens in front of a test chart: colours of unlike size and sharpness, dark corners.

A single element of 24 mm focal length, focused at infinity for the d line. The three channels
are bands about the Fraunhofer lines C, d and F. Corners lie 45° from the axis, 200 px from the
centre.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider, toggle
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.lens.chromatic_aberration import axial_chromatic_mm, lateral_chromatic_scale
from simulations.scenes.lens_aberrations import drawing
from simulations.scenes.lens_aberrations.error import (
    CLOSE_LEFT,
    CLOSE_TOP,
    corner_in,
    corner_light,
    judge,
)
from simulations.scenes.lens_aberrations.spectrum import BANDS, LINES_UM
from simulations.scenes.lens_aberrations.stages import (
    FOCAL_MM,
    GLASSES,
    HEIGHT_PX,
    PITCH_MM,
    STAGES,
    WIDTH_PX,
    light,
)

CORNER_PX = 200.0
"""From the centre to the corners."""


@dataclass(frozen=True, slots=True)
class Settings:
    """What the reader may change."""

    glass: str = choice(
        "Glass",
        {"ideal": "Without dispersion", "crown": "Crown, V = 64.2", "flint": "Flint, V = 36.4"},
        "crown",
    )
    stop: float = slider("Stop before the lens", 12, -15, 15, 1, unit="mm")
    aperture: float = slider("Aperture", 2.8, 1.4, 16, 0.1, prefix="f/")
    rim: float = slider("Rim before the stop", 6, 0, 12, 0.5, unit="mm")
    natural: bool = toggle("Natural vignetting, cos⁴", True)


@dataclass(frozen=True, slots=True)
class Colours:
    """What the middle of each channel suffers; three entries for red, green, blue."""

    scale: Floats
    """Size of the image relative to the green one."""
    disc_px: Floats
    """Diameter of the disc that a point becomes."""


def colours(glass: str, stop_mm: float, f_number: float) -> Colours:
    """Lateral and axial chromatic aberration of the lens at the three lines."""
    kind, lines = GLASSES[glass], np.array(LINES_UM)
    return Colours(
        lateral_chromatic_scale(kind, FOCAL_MM, stop_mm, lines),
        axial_chromatic_mm(kind, FOCAL_MM, f_number, lines) / PITCH_MM,
    )


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The chart through the lens, its corner, and the two profiles."""
    picture: Raster = outputs["encoded"]
    lens = colours(settings.glass, settings.stop, settings.aperture)
    shifts_px = CORNER_PX * (lens.scale - 1)
    tangents = np.linspace(0.0, 1.0, 61)
    cos4, open_share = light(tangents, settings.aperture, settings.rim, settings.natural)
    corner = (float(cos4[-1]), float(open_share[-1]))
    close = np.ascontiguousarray(picture[CLOSE_TOP:, CLOSE_LEFT:])
    width, height = drawing.WIDTH, drawing.HEIGHT
    frame = drawing.close_up_frame(CLOSE_LEFT / WIDTH_PX, CLOSE_TOP / HEIGHT_PX)
    plot = drawing.profile(tangents, cos4, open_share, (float(shifts_px[0]), float(shifts_px[2])))
    return Frame(
        panels=(
            Panel("picture", "Through the lens", width, height, picture, frame),
            Panel("corner", "The corner, enlarged", width, height, close, pixelated=True),
            Panel("profile", "From the centre to the corner", width, height, overlay=plot),
        ),
        readouts=(
            readout(
                "lateral", "Red to blue, corner", shifts_px[2] - shifts_px[0], "px", role="error"
            ),
            readout("red_disc", "Red disc", lens.disc_px[0], "px"),
            readout("blue_disc", "Blue disc", lens.disc_px[2], "px"),
            readout("natural_stops", "Natural falloff", stops(corner[0]), "stops", role="light"),
            readout("rim_stops", "Cut by the rim", stops(corner[1]), "stops", role="camera"),
            readout("corner_stops", "Corner, together", stops(corner[0] * corner[1]), "stops"),
        ),
        description=describe(settings.aperture, lens, corner),
    )


def stops(factor: float) -> float:
    """A factor of light in powers of two; no light is −∞ stops."""
    return math.log2(factor) if factor > 0 else -math.inf


def describe(f_number: float, lens: Colours, corner: tuple[float, float]) -> str:
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
        f"A test chart through a simple lens at f/{f_number:.1f}: {fringe}, "
        f"{soft}, and {100 * share:.0f}\u00a0% of the centre’s light in the corners."
    )


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """How far the enlarged corner is from the sum over the whole spectrum."""
    corner_of = partial(
        corner_in, outputs["chart"], settings.glass, settings.stop, settings.aperture
    )
    factor = corner_light(settings.aperture, settings.rim, settings.natural)
    return judge(outputs["encoded"], corner_of, factor)


SCENE = Scene(
    id="lens-aberrations",
    title="Lens Aberrations",
    settings=Settings,
    draw=draw,
    stages=STAGES,
    tiers=tuple(BANDS),
    default_tier="even-16",
    draft_tier="gauss-3",
    drafted=("stop",),
    ladder="chromatic-aberration",
    estimate=estimate,
)
