"""A simple lens in front of a test chart: colours of different size and sharpness, dark corners.

A single element of 24 mm focal length, focused at infinity for the d line. The three channels are
bands about the Fraunhofer lines C, d and F. Corners are 45° from the axis, 200 px from the centre.
"""

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.lens.chromatic_aberration import lateral_chromatic_scale
from simulations.scenes.lens_aberrations import drawing
from simulations.scenes.lens_aberrations.colours import CORNER_PX, Colours, colours, shifts_px
from simulations.scenes.lens_aberrations.error import (
    CLOSE_LEFT,
    CLOSE_TOP,
    corner_in,
    corner_light,
    estimates,
)
from simulations.scenes.lens_aberrations.handles import HANDLES
from simulations.scenes.lens_aberrations.section import section
from simulations.scenes.lens_aberrations.settings import Settings
from simulations.scenes.lens_aberrations.spectrum import BANDS
from simulations.scenes.lens_aberrations.stages import HEIGHT_PX, STAGES, WIDTH_PX, light


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The corner of a chart through the lens, the lens from the side, and the whole chart."""
    picture: Raster = outputs["encoded"]
    lens = colours(settings.glass, settings.stop, settings.aperture)
    shifts = shifts_px(settings.glass, settings.stop)
    cos4, open_share = light(np.ones(1), settings.aperture, settings.rim, settings.natural)
    corner = (float(cos4[0]), float(open_share[0]))
    close = np.ascontiguousarray(picture[CLOSE_TOP:, CLOSE_LEFT:])
    width, height = drawing.WIDTH, drawing.HEIGHT
    frame = drawing.close_up_frame(CLOSE_LEFT / WIDTH_PX, CLOSE_TOP / HEIGHT_PX)
    cut = section(settings.glass, settings.stop, settings.aperture, settings.rim)
    return Frame(
        panels=(
            Panel(
                "corner",
                "The corner of the picture, enlarged",
                width,
                height,
                close,
                pixelated=True,
                lead=True,
            ),
            Panel("lens", "The light of that corner, from the side", width, height, overlay=cut),
            Panel("picture", "The whole picture", width, height, picture, frame),
        ),
        readouts=(
            readout("lateral", "Red to blue, corner", shifts[2] - shifts[0], "px", role="error"),
            readout("red_disc", "Red disc", lens.disc_px[0], "px"),
            readout("blue_disc", "Blue disc", lens.disc_px[2], "px"),
            readout("natural_stops", "Natural vignetting", stops(corner[0]), "stops", role="light"),
            readout("rim_stops", "Cut by the rim", stops(corner[1]), "stops", role="camera"),
            readout("corner_stops", "Corner in all", stops(corner[0] * corner[1]), "stops"),
        ),
        description=describe(settings, lens, corner),
    )


def stops(factor: float) -> float:
    """A factor of light in powers of two; no light is −∞ stops."""
    return math.log2(factor) if factor > 0 else -math.inf


def describe(settings: Settings, lens: Colours, corner: tuple[float, float]) -> str:
    """The picture in one sentence."""
    shift = CORNER_PX * float(lens.scale[2] - lens.scale[0])
    if abs(shift) < 0.005:
        fringe = "no coloured fringes in the corners"
    else:
        larger = "blue larger than red" if shift > 0 else "red larger than blue"
        fringe = f"{larger}, {format_number(abs(shift), 1)} pixels apart in the corners"
    widest = float(lens.disc_px.max())
    soft = f"discs of up to {widest:.1f} pixels" if widest > 1 else "all colours sharp"
    share = corner[0] * corner[1]
    return (
        f"A test chart through a simple lens at f/{settings.aperture:.1f}, "
        f"{_where(settings.stop)}: {fringe}, "
        f"{soft}, and {100 * share:.0f}\u00a0% of the centre’s light in the corners."
    )


def _where(stop: float) -> str:
    side = "before" if stop > 0 else "behind"
    where = f"{abs(stop):.0f} mm {side} it" if stop else "in it"
    return f"with the aperture stop {where}"


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """Error of the enlarged corner against the sum over the whole spectrum."""
    corner_of = partial(
        corner_in, outputs["chart"], settings.glass, settings.stop, settings.aperture
    )
    factor = corner_light(settings.aperture, settings.rim, settings.natural)
    return estimates(outputs["encoded"], corner_of, factor)


SCENE = Scene(
    id="lens-aberrations",
    title="Lens Aberrations",
    settings=Settings,
    draw=draw,
    formula=lateral_chromatic_scale,
    stages=STAGES,
    handles=HANDLES,
    tiers=tuple(BANDS),
    default_tier="even-16",
    draft_tier="gauss-1",
    drafted=("stop", "aperture"),
    ladder="chromatic-aberration",
    estimate=estimate,
)
