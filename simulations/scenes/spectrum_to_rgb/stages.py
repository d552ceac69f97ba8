"""The stages of the figure of a sensor's colours: light × surface × sensor → raw → balanced → sRGB.

For comparison, the colour that an eye sees in daylight, which is the intended one.
"""

from dataclasses import dataclass

from simulations.engine.frame import Raster
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.chromaticity import lab_distance
from simulations.models.color.cie import xyz_to_lab, xyz_to_linear_rgb
from simulations.models.color.observer import OBSERVER, tristimulus
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.white_balance import white_balance
from simulations.models.sensor.camera_colour import camera_curves, exposed, fit_colour_matrix
from simulations.scenes._spectra.patches import Chart
from simulations.scenes._spectra.spectra import (
    DAYLIGHT,
    MEASURED,
    light_of,
    surfaces_of,
    with_twins,
)

CURVES = {"camera": camera_curves(WAVELENGTHS_NM), "eye": OBSERVER}
CHART = Chart(
    (("raw", "image"), ("balanced", "image"), ("sRGB", "image"), ("eye, by day", "world")), 56
)


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
    meant: Floats
    """Linear sRGB seen in daylight."""
    error: Floats
    """(2, 12) ΔE of ``srgb`` from ``meant``."""


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
    meant = tristimulus(pairs * DAYLIGHT, DAYLIGHT)
    return Colours(
        raw=raw,
        gains=white[1] / white,
        balanced=balanced,
        srgb=xyz_to_linear_rgb(seen),
        meant=xyz_to_linear_rgb(meant),
        error=lab_distance(xyz_to_lab(seen), xyz_to_lab(meant)),
    )


def _picture(colours: Colours, twin: bool) -> Raster:
    """The patches: a row for each step, twins in the lower halves."""
    steps = (colours.raw, colours.balanced, colours.srgb, colours.meant)
    return CHART.paint(steps, twin=twin)


STAGES = (
    Stage("light", light_of),
    Stage("surfaces", surfaces_of),
    Stage("pairs", with_twins, ("surfaces",)),
    Stage("curves", _curves),
    Stage("matrix", _fitted, ("curves", "light")),
    Stage("colours", _colours, ("light", "pairs", "curves", "matrix")),
    Stage("picture", _picture, ("colours",)),
)
