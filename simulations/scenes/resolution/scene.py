"""What Resolution Is: a point, waves and a star, through lens, plate and pixels."""

import numpy as np

from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.lens.diffraction import lens_transfer, spot_diameter_um
from simulations.models.sensor.resolution import nyquist_per_mm
from simulations.scenes.resolution import curves
from simulations.scenes.resolution.curves import Links, links
from simulations.scenes.resolution.handles import HANDLES
from simulations.scenes.resolution.sensor import HEIGHT, WIDTH, close_overlay, star_overlay
from simulations.scenes.resolution.settings import Settings
from simulations.scenes.resolution.stages import STAGES, Lens, micrometres

NOTHING = 0.005
"""Contrast below which the eye sees nothing."""


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture of a star, the spot on the pixels, and the transfer functions."""
    lens: Lens = outputs["lens"]
    here = links(settings, lens, np.asarray(settings.frequency))
    return Frame(
        panels=(
            Panel(
                "picture",
                "The picture of a star of 48 rays",
                WIDTH,
                HEIGHT,
                outputs["picture"],
                star_overlay(settings),
                pixelated=True,
                lead=True,
            ),
            Panel(
                "spot",
                "The image of a point, on the pixels",
                WIDTH,
                HEIGHT,
                outputs["close"],
                close_overlay(settings),
            ),
            Panel(
                "curves",
                "What is left of a wave’s contrast",
                WIDTH,
                HEIGHT,
                overlay=curves.draw(settings, lens),
            ),
        ),
        readouts=_readouts(settings, lens, here),
        description=describe(settings, here),
    )


def _readouts(settings: Settings, lens: Lens, here: Links) -> tuple[Readout, ...]:
    nyquist = nyquist_per_mm(settings.pitch)
    at_nyquist = abs(float(links(settings, lens, np.asarray(nyquist)).together))
    spot = spot_diameter_um(micrometres(settings.wavelength), settings.aperture)
    per_mm = "cycles/mm"
    return (
        readout("lens", "Contrast at f: lens", abs(float(here.lens)), role="ray"),
        readout("pixel", "Contrast at f: pixel", abs(float(here.pixel)), role="camera"),
        readout("plate_leaves", "Contrast at f: plate", abs(float(here.plate))),
        readout("together", "Contrast at f: together", abs(float(here.together)), role="image"),
        readout("nyquist", "Nyquist frequency", nyquist, per_mm, digits=1, role="camera"),
        readout("at_nyquist", "Contrast at Nyquist", at_nyquist, role="image"),
        readout(
            "cutoff", "Cut-off frequency", curves.cutoff(settings), per_mm, digits=1, role="ray"
        ),
        readout(
            "mtf50",
            "Half contrast at (MTF50)",
            curves.mtf50(settings, lens),
            per_mm,
            digits=1,
            role="image",
        ),
        readout("spot", "Diameter of the spot", spot, "µm", role="ray"),
    )


def describe(settings: Settings, here: Links) -> str:
    """The contrast of the marked wave, and the link that limits the picture."""
    nyquist, cutoff = nyquist_per_mm(settings.pitch), curves.cutoff(settings)
    left = float(here.together)
    wave = f"Of a wave of {format_number(settings.frequency, 0)} cycles per mm "
    if settings.frequency >= cutoff:
        wave += "nothing passes the lens"
    elif abs(left) < NOTHING:
        wave += "hardly anything is left"
    else:
        wave += f"{format_number(100 * abs(left), 0)} % of the contrast is left"
        if left < 0:
            wave += ", with dark and light exchanged"
    if settings.frequency > nyquist and abs(left) >= NOTHING:
        wave += ", and it shows as a false, coarser one"
    grid = (
        "the lens stops all waves that are too fine for the pixels"
        if cutoff <= nyquist
        else "the lens passes waves that are too fine for the pixels, and false patterns appear "
        "around the middle of the star"
    )
    return f"A star of dark and light rays that fade towards its middle. {wave}; {grid}."


SCENE = Scene(
    id="resolution",
    title="What Resolution Is",
    settings=Settings,
    draw=draw,
    formula=lens_transfer,
    stages=STAGES,
    handles=HANDLES,
)
