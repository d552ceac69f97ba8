"""From a spectrum to three numbers: what a sensor makes of a surface, and the intended colour.

The computation is in `simulations.scenes.spectrum_to_rgb.stages`.
"""

from collections.abc import Sequence

import numpy as np

from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.color.srgb import encode_srgb
from simulations.models.sensor.camera_colour import exposed
from simulations.scenes._spectra import axes, patches
from simulations.scenes._spectra.choices import NAMES
from simulations.scenes._spectra.words import lit_surface
from simulations.scenes.spectrum_to_rgb.handles import HANDLES
from simulations.scenes.spectrum_to_rgb.sensed import HEIGHT, PLOT, sensed
from simulations.scenes.spectrum_to_rgb.settings import Settings
from simulations.scenes.spectrum_to_rgb.stages import CHART, STAGES, Colours


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The patches step by step, and the sensor's part of the light."""
    colours: Colours = outputs["colours"]
    chosen = NAMES.index(settings.surface)
    back = outputs["pairs"][0, chosen]
    areas = sensed(
        outputs["light"], back, outputs["curves"], settings.sensor, colours.raw[0, chosen]
    )
    return Frame(
        panels=(
            Panel(
                "patches",
                "Twelve surfaces, step by step",
                patches.WIDTH,
                patches.HEIGHT,
                outputs["picture"],
                CHART.overlay(settings.surface),
                pixelated=True,
                lead=True,
            ),
            Panel(
                "sensor",
                "What the sensor takes of the light",
                axes.WIDTH,
                HEIGHT,
                axes.colours_below(PLOT),
                areas,
            ),
        ),
        readouts=_readouts(colours, chosen),
        description=describe(settings, colours, chosen),
    )


def _readouts(colours: Colours, chosen: int) -> tuple[Readout, ...]:
    errors = colours.error[0]
    return (
        readout("gain_red", "Factor for red", colours.gains[0], role="light"),
        readout("gain_blue", "Factor for blue", colours.gains[2], role="light"),
        readout("error", "Colour error", errors[chosen], "ΔE", digits=1, role="error"),
        readout("mean", "Mean error of the chart", errors[1:].mean(), "ΔE", digits=1, role="error"),
        Readout("raw", "Raw R / G / B", _triple(colours.raw[0, chosen]), role="camera"),
        Readout("codes", "sRGB", _codes(colours.srgb[0, chosen]), "of 255", "image"),
    )


def _triple(values: Sequence[float] | np.ndarray) -> str:
    return " / ".join(format_number(float(value), 3) for value in values)


def _codes(linear: np.ndarray) -> str:
    """Encoded for a display, clipped to its gamut."""
    codes = np.rint(255.0 * np.clip(encode_srgb(linear), 0.0, 1.0))
    return " / ".join(f"{code:.0f}" for code in codes)


def describe(settings: Settings, colours: Colours, chosen: int) -> str:
    """The picture in one sentence."""
    error = format_number(float(colours.error[0, chosen]), 1)
    outside = bool((np.abs(colours.meant[0, chosen] - 0.5) > 0.5).any())
    sentence = (
        f"{lit_surface(settings)}: the sensor’s raw values are "
        f"{_triple(colours.raw[0, chosen])}, balanced and through the matrix they are the sRGB "
        f"codes {_codes(colours.srgb[0, chosen])}, {error} ΔE from the colour by daylight"
    )
    if outside:
        sentence += ", which no display can show"
    return f"{sentence}."


# A few sums over 81 wavelengths: no tiers.
SCENE = Scene(
    id="spectrum-to-rgb",
    title="From Spectrum to RGB",
    settings=Settings,
    draw=draw,
    formula=exposed,
    stages=STAGES,
    handles=HANDLES,
)
