"""From a spectrum to three numbers: a light, a surface and a sensor, and the intended colour.

The computation is in `simulations.scenes.spectrum_to_rgb.stages`.
"""

from collections.abc import Sequence

import numpy as np

from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.color.chromaticity import xyz_to_xyy
from simulations.models.color.srgb import encode_srgb
from simulations.scenes.spectrum_to_rgb import axes, diagram, patches, spectra
from simulations.scenes.spectrum_to_rgb.handles import HANDLES
from simulations.scenes.spectrum_to_rgb.settings import Settings
from simulations.scenes.spectrum_to_rgb.stages import NAMES, STAGES, Colours, daylight_temperature

VISIBLE = 2.0
"""Just noticeable ΔE."""
LIGHTS = {
    "planck": "a glowing body of {:.0f} K",
    "daylight": "daylight of {:.0f} K",
    "fluorescent": "a fluorescent tube",
    "diode": "a white LED",
}
SURFACES = {"cloth": "A dyed cloth", "sky": "A patch like blue sky", "white": "A white patch"}


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """Spectra, the sensor's part of them, the patches, and the chromaticities."""
    colours: Colours = outputs["colours"]
    chosen = NAMES.index(settings.surface)
    pair = outputs["pairs"][:, chosen]
    light, raw = outputs["light"], colours.raw[0, chosen]
    first = spectra.light_and_surface(
        light, pair, twin=settings.twin, cloth=settings.surface == "cloth"
    )
    second = spectra.sensed(light, pair[0], outputs["curves"], settings.sensor, raw)
    fourth = diagram.diagram(
        settings.light, colours.white_xy, colours.xyz, chosen, twin=settings.twin
    )
    width, height, strip = axes.WIDTH, axes.HEIGHT, axes.colours_below()
    return Frame(
        panels=(
            Panel("light", "Light × surface", width, height, strip, first),
            Panel("sensor", "What the sensor takes of it", width, height, strip, second),
            Panel(
                "patches",
                "Twelve surfaces, step by step",
                patches.WIDTH,
                patches.HEIGHT,
                outputs["picture"],
                patches.overlay(settings.surface),
                pixelated=True,
            ),
            Panel("diagram", "Chromaticity, by the eye", width, height, overlay=fourth),
        ),
        readouts=_readouts(colours, chosen),
        description=describe(settings, colours, chosen),
    )


def _readouts(colours: Colours, chosen: int) -> tuple[Readout, ...]:
    xyz = colours.xyz[0, chosen]
    return (
        Readout("xyz", "X / Y / Z", _triple(xyz), role="world"),
        Readout("xy", "x / y", _triple(xyz_to_xyy(xyz)[:2]), role="world"),
        Readout("raw", "Raw R / G / B", _triple(colours.raw[0, chosen]), role="camera"),
        readout("gain_red", "Factor for red", colours.gains[0], role="light"),
        readout("gain_blue", "Factor for blue", colours.gains[2], role="light"),
        Readout("codes", "sRGB", _codes(colours.srgb[0, chosen]), "of 255", "image"),
        readout("error", "Colour error", colours.error[0, chosen], "ΔE", digits=1, role="error"),
        readout(
            "mean", "Mean of the chart", colours.error[0, 1:].mean(), "ΔE", digits=1, role="error"
        ),
        readout(
            "apart", "To its twin, for the eye", colours.apart[chosen], "ΔE", digits=1, role="world"
        ),
    )


def _triple(values: Sequence[float] | np.ndarray) -> str:
    return " / ".join(format_number(float(value), 3) for value in values)


def _codes(linear: np.ndarray) -> str:
    """Encoded for a display, clipped to its gamut."""
    codes = np.rint(255.0 * np.clip(encode_srgb(linear), 0.0, 1.0))
    return " / ".join(f"{code:.0f}" for code in codes)


def describe(settings: Settings, colours: Colours, chosen: int) -> str:
    """The picture in one sentence."""
    kelvin = (
        daylight_temperature(settings.temperature)
        if settings.light == "daylight"
        else settings.temperature
    )
    light = LIGHTS[settings.light].format(kelvin)
    name = settings.surface.replace("-", " ")
    surface = SURFACES.get(settings.surface, f"A patch of the colour {name}")
    if settings.surface == "cloth":
        surface += f" that sends back light about {settings.band:.0f} nm"
    error = format_number(float(colours.error[0, chosen]), 1)
    outside = bool((np.abs(colours.meant[0, chosen] - 0.5) > 0.5).any())
    sentence = (
        f"{surface} in the light of {light}: the sensor’s raw values are "
        f"{_triple(colours.raw[0, chosen])}, balanced and through the matrix they are the sRGB "
        f"codes {_codes(colours.srgb[0, chosen])}, {error} ΔE from the colour by daylight"
    )
    if outside:
        sentence += ", which no display can show"
    if settings.twin:
        apart = float(colours.apart[chosen])
        sentence += (
            f"; its twin is {'another' if apart > VISIBLE else 'the same'} colour to the eye"
        )
    return f"{sentence}."


# A few sums over 81 wavelengths: no tiers.
SCENE = Scene(
    id="spectrum-to-rgb",
    title="From Spectrum to RGB",
    settings=Settings,
    draw=draw,
    stages=STAGES,
    handles=HANDLES,
)
