"""From a spectrum to three numbers: what a sensor makes of a surface, and the intended colour.

Light × surface × sensor → raw → balanced → sRGB; for comparison, the colour that an eye sees in
daylight, which is the intended one. A few sums over 81 wavelengths: no tiers.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from simulations.engine.drafting import tinted
from simulations.engine.drawing import text
from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.settings import choice
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.color.chromaticity import lab_distance
from simulations.models.color.cie import xyz_to_lab, xyz_to_linear_rgb
from simulations.models.color.observer import OBSERVER, tristimulus
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.srgb import encode_srgb
from simulations.models.color.white_balance import white_balance
from simulations.models.sensor.camera_colour import camera_curves, exposed, fit_colour_matrix
from simulations.scenes import _spectra
from simulations.scenes._spectra import DAYLIGHT, MEASURED, NAMES, WIDTH, Chart, LitSurface

SENSORS = {"camera": "A camera's", "eye": "The eye's, x̄ ȳ z̄"}
MATRICES = {"daylight": "Made for daylight", "own": "Made for this light"}
CURVES = {"camera": camera_curves(WAVELENGTHS_NM), "eye": OBSERVER}  # (81, 3)
ROWS = (("raw", "image"), ("balanced", "image"), ("sRGB", "image"), ("eye, by day", "world"))
CHART = Chart(ROWS, 56)

HEIGHT = 500  # the sensor's panel is taller than the other, beside which it is narrower
PLOT = replace(_spectra.PLOT, y=replace(_spectra.PLOT.y, start=float(HEIGHT - _spectra.BELOW)))
CHANNELS = ((0.82, 0.22, 0.18), (0.20, 0.57, 0.20), (0.22, 0.42, 0.88))
"""Colours of the three curves, visible on light and on dark."""
LETTERS = {"camera": ("R", "G", "B"), "eye": ("x̄", "ȳ", "z̄")}


@dataclass(frozen=True, slots=True)
class Settings(LitSurface):
    matrix: str = choice("Colour matrix", MATRICES)
    sensor: str = choice("Curves of the sensor", SENSORS)


@dataclass(frozen=True, slots=True)
class Colours:
    """The colours of twelve surfaces, and of their twins in a second row: (2, 12, 3) each."""

    raw: Floats  # the sensor's values; white has a green of 1
    gains: Floats  # (3,) gains that make white grey
    balanced: Floats
    srgb: Floats  # linear sRGB by the matrix; some outside of [0, 1]
    meant: Floats  # linear sRGB seen in daylight
    error: Floats  # (2, 12) ΔE of ``srgb`` from ``meant``


def curves_of(sensor: str) -> Floats:
    """(81, 3)."""
    return CURVES[sensor]


def fitted(curves: Floats, light: Floats, matrix: str) -> Floats:
    """(3, 3) from balanced values to XYZ in daylight, fitted to the measured patches."""
    source = light if matrix == "own" else DAYLIGHT
    white = exposed(source, curves, source)
    balanced = white_balance(exposed(MEASURED * source, curves, source), white)
    wanted = tristimulus(MEASURED * DAYLIGHT, DAYLIGHT)
    return fit_colour_matrix(balanced, wanted, tristimulus(DAYLIGHT, DAYLIGHT))


def colours_of(light: Floats, pairs: Floats, curves: Floats, fitted: Floats) -> Colours:
    white = exposed(light, curves, light)
    raw = exposed(pairs * light, curves, light)
    balanced = white_balance(raw, white)
    seen = balanced @ fitted.T
    meant = tristimulus(pairs * DAYLIGHT, DAYLIGHT)
    return Colours(
        raw=raw,
        gains=white[1] / white,
        balanced=balanced,
        srgb=xyz_to_linear_rgb(seen),
        meant=xyz_to_linear_rgb(meant),
        error=lab_distance(xyz_to_lab(seen), xyz_to_lab(meant)),
    )


def picture(colours: Colours, twin: bool) -> Raster:
    """The patches: a row for each step, twins in the lower halves."""
    steps = (colours.raw, colours.balanced, colours.srgb, colours.meant)
    return CHART.paint(steps, twin=twin)


STAGES = (
    Stage("light", _spectra.light_of),
    Stage("surfaces", _spectra.surfaces_of),
    Stage("pairs", _spectra.with_twins, ("surfaces",)),
    Stage("curves", curves_of),
    Stage("matrix", fitted, ("curves", "light")),
    Stage("colours", colours_of, ("light", "pairs", "curves", "matrix")),
    Stage("picture", picture, ("colours",)),
)


def sensed(light: Floats, reflectance: Floats, curves: Floats, sensor: str, raw: Floats) -> str:
    """The sensor's curves (81, 3), and their products with the light from a surface."""
    back = light / light.max() * reflectance
    scale, letters = curves.max(), LETTERS[sensor]
    parts = [_spectra.axes(PLOT)]
    for each, colour in zip(curves.T / scale, CHANNELS, strict=True):
        area = PLOT.area(WAVELENGTHS_NM, back * each, "fill thin")
        parts.append(tinted((area, _spectra.curve(each, "", PLOT)), colour))
    sums = ", ".join(f"{letter} {value:.2f}" for letter, value in zip(letters, raw, strict=True))
    return "".join(
        (
            *parts,
            *curve_letters(curves / scale, letters),
            text((40, 24.0), f"areas: {sums}", "strong"),
        )
    )


def curve_letters(curves: Floats, letters: tuple[str, ...]) -> Iterator[str]:
    """The name of each curve above its peak."""
    for each, letter, colour in zip(curves.T, letters, CHANNELS, strict=True):
        peak = int(each.argmax())
        x, y = PLOT.at(float(WAVELENGTHS_NM[peak]), float(each[peak]))
        yield tinted([text((x, y - 6), letter, "strong ground", "middle")], colour)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    colours: Colours = outputs["colours"]
    chosen = NAMES.index(settings.surface)
    errors, back = colours.error[0], outputs["pairs"][0, chosen]
    raw = " / ".join(format_number(float(value), 3) for value in colours.raw[0, chosen])
    # Encoded for a display, clipped to its gamut.
    srgb = np.rint(255.0 * np.clip(encode_srgb(colours.srgb[0, chosen]), 0.0, 1.0))
    codes = " / ".join(f"{code:.0f}" for code in srgb)
    areas = sensed(
        outputs["light"], back, outputs["curves"], settings.sensor, colours.raw[0, chosen]
    )
    beyond = _spectra.outside_gamut(colours.meant[0, chosen])
    return Frame(
        (
            Panel(
                "patches",
                "Twelve surfaces, step by step",
                WIDTH,
                _spectra.HEIGHT,
                outputs["picture"],
                CHART.overlay(settings.surface),
                pixelated=True,
                lead=True,
            ),
            Panel(
                "sensor",
                "What the sensor takes of the light",
                WIDTH,
                HEIGHT,
                _spectra.colours_below(PLOT),
                areas,
            ),
        ),
        (
            readout("gain_red", "Factor for red", colours.gains[0], role="light"),
            readout("gain_blue", "Factor for blue", colours.gains[2], role="light"),
            readout("error", "Colour error", errors[chosen], "ΔE", digits=1, role="error"),
            readout(
                "mean", "Mean error of the chart", errors[1:].mean(), "ΔE", digits=1, role="error"
            ),
            Readout("raw", "Raw R / G / B", raw, role="camera"),
            Readout("codes", "sRGB", codes, "of 255", "image"),
        ),
        f"{_spectra.lit_surface(settings)}: the sensor’s raw values are {raw}, balanced and "
        f"through the matrix they are the sRGB codes {codes}, "
        f"{format_number(float(errors[chosen]), 1)} ΔE from the colour by daylight"
        f"{', which no display can show' if beyond else ''}.",
    )


SCENE = Scene(
    "spectrum-to-rgb",
    "From Spectrum to RGB",
    Settings,
    draw,
    STAGES,
    (_spectra.SURFACE,),
    formula=exposed,
)
