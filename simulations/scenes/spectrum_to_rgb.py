"""From a spectrum to three numbers: a sensor's values of a surface, and the intended colour.

Light × surface × sensor → raw → balanced → sRGB; for comparison, the colour that an eye sees in
daylight, which is the intended one. A few sums over 81 wavelengths: no tiers.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simulations.engine.drafting import tinted
from simulations.engine.drawing import text
from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.instrument import Instrument
from simulations.engine.photograph import Codes, Photograph
from simulations.engine.raster import opaque
from simulations.engine.scene import Scene
from simulations.engine.settings import choice
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.color.chromaticity import lab_distance
from simulations.models.color.cie import xyz_to_lab, xyz_to_linear_rgb
from simulations.models.color.observer import OBSERVER, tristimulus
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.srgb import decode_srgb, encode_srgb, encode_srgb_codes
from simulations.models.color.white_balance import white_balance
from simulations.models.sensor.camera_colour import camera_curves, exposed, fit_colour_matrix
from simulations.pictures.photographs import coffee
from simulations.scenes import _spectra
from simulations.scenes._spectra import DAYLIGHT, MEASURED, NAMES, WIDTH, Chart, LitSurface

SENSORS = {"camera": "A camera's", "eye": "The eye's, x̄ ȳ z̄"}
MATRICES = {"daylight": "Made for daylight", "own": "Made for this light"}
CURVES = {"camera": camera_curves(WAVELENGTHS_NM), "eye": OBSERVER}  # (81, 3)
ROWS = (("raw", "image"), ("balanced", "image"), ("sRGB", "image"), ("eye, by day", "world"))
CHART = Chart(ROWS, 56)

PHOTOGRAPH_PX = (200, 160)
PAINTS = np.linalg.svd(MEASURED, full_matrices=False)[2][:3]
"""(3, 81) mixed, they come nearest to the reflectances of the chart."""
CHANNELS = ((0.82, 0.22, 0.18), (0.20, 0.57, 0.20), (0.22, 0.42, 0.88))
"""Colours of the three curves, visible on light and on dark."""
LETTERS = {"camera": ("R", "G", "B"), "eye": ("x̄", "ȳ", "z̄")}


@dataclass(frozen=True, slots=True)
class Settings(LitSurface):
    matrix: str = choice("Colour matrix", MATRICES)
    sensor: str = choice("Curves of the sensor", SENSORS)


@dataclass(frozen=True, slots=True, kw_only=True)
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
    target = tristimulus(MEASURED * DAYLIGHT, DAYLIGHT)
    return fit_colour_matrix(balanced, target, tristimulus(DAYLIGHT, DAYLIGHT))


def colours_of(light: Floats, pairs: Floats, curves: Floats, fitted: Floats) -> Colours:
    white = exposed(light, curves, light)
    raw = exposed(pairs * light, curves, light)
    balanced = white_balance(raw, white)
    corrected = balanced @ fitted.T
    meant = tristimulus(pairs * DAYLIGHT, DAYLIGHT)
    return Colours(
        raw=raw,
        gains=white[1] / white,
        balanced=balanced,
        srgb=xyz_to_linear_rgb(corrected),
        meant=xyz_to_linear_rgb(meant),
        error=lab_distance(xyz_to_lab(corrected), xyz_to_lab(meant)),
    )


def picture(colours: Colours, twin: bool) -> Raster:
    """The patches: a row for each step, twins in the lower halves."""
    steps = (colours.raw, colours.balanced, colours.srgb, colours.meant)
    return CHART.paint(steps, twin=twin)


def photograph_by_day(photograph: Photograph | None) -> tuple[Codes, Floats]:
    """(160, 200, 3) codes of a photograph, and its linear sRGB."""
    codes = photograph.codes if photograph else coffee.codes()
    return codes, decode_srgb(np.float32(1 / 255) * codes)


def pictures(
    by_day: tuple[Codes, Floats],
    light: Floats,
    curves: Floats,
    fitted: Floats,
    colours: Colours,
) -> Raster:
    """(320, 400, 4) a photograph in the four steps of `ROWS`.

    Each of its pixels is taken for the mixture of `PAINTS` that looks so by day. The three numbers
    of any other sensor, in any light, are then a matrix times the values of the pixel.
    """
    mixture = np.linalg.inv(xyz_to_linear_rgb(tristimulus(PAINTS * DAYLIGHT, DAYLIGHT)))
    codes, linear = by_day
    raw = linear @ (mixture @ exposed(PAINTS * light, curves, light)).astype(np.float32)
    balanced = raw * colours.gains.astype(np.float32)
    srgb = balanced @ xyz_to_linear_rgb(fitted.T).astype(np.float32)
    shown = [encode_srgb_codes(step) for step in (raw, balanced, srgb)]
    return opaque(np.vstack((np.hstack(shown[:2]), np.hstack((shown[2], codes)))))


def step_names() -> str:
    """The names of the four pictures."""
    places = ((8, 24), (WIDTH // 2 + 8, 24), (8, 184), (WIDTH // 2 + 8, 184))
    return "".join(
        text(place, name, f"{role} small ground")
        for place, (name, role) in zip(places, ROWS, strict=True)
    )


STAGES = (
    Stage("light", _spectra.light_of),
    Stage("surfaces", _spectra.surfaces_of),
    Stage("pairs", _spectra.with_twins, ("surfaces",)),
    Stage("curves", curves_of),
    Stage("matrix", fitted, ("curves", "light")),
    Stage("colours", colours_of, ("light", "pairs", "curves", "matrix")),
    Stage("picture", picture, ("colours",)),
    Stage("by day", photograph_by_day),
    Stage("photographs", pictures, ("by day", "light", "curves", "matrix", "colours")),
)


def sensed(light: Floats, reflectance: Floats, curves: Floats, sensor: str, raw: Floats) -> str:
    """The sensor's curves (81, 3), and their products with the light from a surface."""
    back = light / light.max() * reflectance
    scale, letters = curves.max(), LETTERS[sensor]
    parts = [_spectra.axes()]
    for each, colour in zip(curves.T / scale, CHANNELS, strict=True):
        area = _spectra.PLOT.area(WAVELENGTHS_NM, back * each, "fill thin")
        parts.append(tinted((area, _spectra.curve(each, "")), colour))
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
        x, y = _spectra.PLOT.at(float(WAVELENGTHS_NM[peak]), float(each[peak]))
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
    size, ground = (WIDTH, _spectra.HEIGHT), _spectra.colours_below()
    beyond = _spectra.outside_gamut(colours.meant[0, chosen])
    return Frame(
        (
            Panel(
                "photographs",
                "A photograph, step by step",
                *size,
                outputs["photographs"],
                overlay=step_names(),
                lead=True,
            ),
            Panel(
                "patches",
                "Twelve surfaces, step by step",
                *size,
                outputs["picture"],
                overlay=CHART.overlay(settings.surface),
                pixelated=True,
            ),
            Panel("sensor", "What the sensor takes of the light", *size, ground, areas),
        ),
        (
            readout("gain_red", "Factor for red", colours.gains[0], role="light"),
            readout("gain_blue", "Factor for blue", colours.gains[2], role="light"),
            readout("error", "Colour error", errors[chosen], "ΔE", digits=1, role="error"),
            readout(
                "mean", "Mean error of the chart", errors[1:].mean(), "ΔE", digits=1, role="error"
            ),
            Readout("raw", "Raw R / G / B", raw, role="camera"),
            Readout("codes", "sRGB", codes, "of 255", role="image"),
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
    instrument=Instrument(photograph=PHOTOGRAPH_PX),
    formula=exposed,
)
