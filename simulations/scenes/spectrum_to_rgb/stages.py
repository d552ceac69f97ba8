"""The stages of the spectrum figure: light × surface × sensor → raw → balanced → sRGB.

For comparison, XYZ for the eye in this light and in daylight, the intended colour.
"""

from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.chromatic_adaptation import adapt
from simulations.models.color.chromaticity import lab_distance, xyz_to_xyy
from simulations.models.color.cie import D65_XY, xyz_to_lab, xyz_to_linear_rgb
from simulations.models.color.illuminants import (
    D65_K,
    DAYLIGHT_K,
    daylight,
    fluorescent,
    planck,
    white_diode,
)
from simulations.models.color.observer import OBSERVER, tristimulus
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.srgb import encode_srgb
from simulations.models.color.surfaces import CHART, chart_patch, dyed_cloth, metameric_twins
from simulations.models.color.white_balance import white_balance
from simulations.models.sensor.camera_colour import camera_curves, exposed, fit_colour_matrix
from simulations.scenes.spectrum_to_rgb.patches import paint
from simulations.scenes.spectrum_to_rgb.settings import SURFACES

DAYLIGHT = daylight(D65_K)
"""The light of the intended colours, in which the twins match."""
MEASURED = np.stack([chart_patch(name) for name in CHART])
"""(11, 81) the patches that do not change."""
NAMES = tuple(SURFACES)
"""Names of the surfaces: the cloth, then the measured patches."""
CURVES = {"camera": camera_curves(WAVELENGTHS_NM), "eye": OBSERVER}


@dataclass(frozen=True, slots=True)
class Colours:
    """The colours of twelve surfaces, and of their twins in a second row: (2, 12, 3) each."""

    raw: Floats
    """The sensor's values; white has a green of 1."""
    gains: Floats
    """(3,) gains that make white grey."""
    balanced: Floats
    srgb: Floats
    """Linear sRGB by the matrix; some outside of [0, 1]."""
    xyz: Floats
    """XYZ for the eye, in this light; white has Y = 1."""
    white_xy: tuple[float, float]
    """XYZ of the light itself."""
    here: Floats
    """Linear sRGB seen by an eye that is adapted to this light."""
    meant: Floats
    """Linear sRGB seen in daylight."""
    error: Floats
    """(2, 12) ΔE of ``srgb`` from ``meant``."""
    apart: Floats
    """(12,) ΔE of the twins for the eye in this light."""


def daylight_temperature(temperature_k: float) -> float:
    """The temperature, limited to the range of daylight."""
    return max(temperature_k, DAYLIGHT_K[0])


def light_of(light: str, temperature: float) -> Floats:
    """(81,) its power, with a mean of 1 over 400 to 700 nm."""
    match light:
        case "planck":
            power = planck(temperature)
        case "daylight":
            power = daylight(daylight_temperature(temperature))
        case "fluorescent":
            power = fluorescent()
        case _:
            power = white_diode()
    seen = (WAVELENGTHS_NM >= 400.0) & (WAVELENGTHS_NM <= 700.0)
    return power / power[seen].mean()


def _surfaces(band: float, width: float) -> Floats:
    """(12, 81) reflectances, in the order of `NAMES`."""
    return np.concatenate([dyed_cloth(band, width)[None], MEASURED])


def _with_twins(surfaces: Floats) -> Floats:
    """(2, 12, 81) the surfaces, then others that match them in daylight."""
    return np.stack([surfaces, metameric_twins(surfaces, DAYLIGHT)])


def _curves(sensor: str) -> Floats:
    """(81, 3)."""
    return CURVES[sensor]


def _fitted(curves: Floats, light: Floats, matrix: str) -> Floats:
    """(3, 3) from balanced values to XYZ in daylight, fitted to the measured patches."""
    source = light if matrix == "own" else DAYLIGHT
    white = exposed(source, curves, source)
    balanced = white_balance(exposed(MEASURED * source, curves, source), white)
    wanted = tristimulus(MEASURED * DAYLIGHT, DAYLIGHT)
    return fit_colour_matrix(balanced, wanted, tristimulus(DAYLIGHT, DAYLIGHT))


def _colours(light: Floats, pairs: Floats, curves: Floats, fitted: Floats) -> Colours:
    """All colours that are shown."""
    white = exposed(light, curves, light)
    raw = exposed(pairs * light, curves, light)
    balanced = white_balance(raw, white)
    seen = balanced @ fitted.T
    xyz = tristimulus(pairs * light, light)
    meant = tristimulus(pairs * DAYLIGHT, DAYLIGHT)
    x, y = xyz_to_xyy(tristimulus(light, light))[:2].tolist()
    original, twin = xyz_to_lab(xyz, (x, y))
    return Colours(
        raw=raw,
        gains=white[1] / white,
        balanced=balanced,
        srgb=xyz_to_linear_rgb(seen),
        xyz=xyz,
        white_xy=(x, y),
        here=xyz_to_linear_rgb(adapt(xyz, (x, y), D65_XY)),
        meant=xyz_to_linear_rgb(meant),
        error=lab_distance(xyz_to_lab(seen), xyz_to_lab(meant)),
        apart=lab_distance(original, twin),
    )


def _picture(colours: Colours, twin: bool) -> Raster:
    """The patches: a row for each step, twins in the lower halves."""
    steps = (colours.raw, colours.balanced, colours.srgb, colours.here, colours.meant)
    shown = np.stack([each if twin else each[[0, 0]] for each in steps])
    return paint(to_rgba8(encode_srgb(shown.reshape(-1, len(NAMES), 3))))


STAGES = (
    Stage("light", light_of),
    Stage("surfaces", _surfaces),
    Stage("pairs", _with_twins, ("surfaces",)),
    Stage("curves", _curves),
    Stage("matrix", _fitted, ("curves", "light")),
    Stage("colours", _colours, ("light", "pairs", "curves", "matrix")),
    Stage("picture", _picture, ("colours",)),
)
