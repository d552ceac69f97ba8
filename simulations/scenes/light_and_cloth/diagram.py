"""The chromaticity diagram: colours without their brightness."""

import math
from functools import cache

import numpy as np

from simulations.engine.drawing import Point, circle, dot, polygon, polyline, text
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats
from simulations.models.color.chromaticity import xyz_to_xyy
from simulations.models.color.cie import D65_XY, SRGB_PRIMARIES_XY
from simulations.models.color.illuminants import DAYLIGHT_K
from simulations.models.color.observer import matching_functions, tristimulus
from simulations.scenes._spectra.choices import COOLEST_K, HOTTEST_K, STEP_K
from simulations.scenes._spectra.spectra import light_of

PLOT = Plot(Axis(0.0, 0.82, 44.0, 298.2), Axis(0.0, 0.88, 284.0, 11.2))
"""310 units of the view box per unit of x and of y."""
TICKS = Scale(ticks=(0.4, 0.8), grid=(0.2, 0.4, 0.6, 0.8))
PURE_NM = np.arange(420.0, 641.0, 4.0)
"""Wavelengths of the edge of all colours: beyond these it hardly moves, and the fits are
inaccurate."""
MARKED_NM = (490, 600)
"""Labelled wavelengths of the edge."""
TEMPERATURES_K = np.arange(COOLEST_K, HOTTEST_K + 1.0, STEP_K)
"""The steps of its slider."""


def at(xy: Point) -> tuple[float, float]:
    """View box units of a chromaticity."""
    return PLOT.at(float(xy[0]), float(xy[1]))


@cache
def whites(light: str) -> tuple[Floats, Floats]:
    """Temperatures (N,) and chromaticities (N, 2) of one kind of light, by steps of its slider."""
    kelvin = TEMPERATURES_K
    if light == "daylight":
        kelvin = kelvin[kelvin >= DAYLIGHT_K[0]]
    lights = np.stack([light_of(light, float(each)) for each in kelvin])
    return kelvin, xyz_to_xyy(np.stack([tristimulus(each, each) for each in lights]))[:, :2]


def temperature_at(place: Point, light: str) -> float:
    """Temperature of the white nearest to a place of the panel."""
    kelvin, xy = whites(light)
    off = [math.dist(at(each), place) for each in xy]
    return float(kelvin[int(np.argmin(off))])


def diagram(light: str, white_xy: Point, xyz: Floats, chosen: int, *, twin: bool) -> str:
    """Pure colours, the display's gamut, the whites, and the surfaces (2, 12, 3) in XYZ."""
    pairs = xyz_to_xyy(xyz)[..., :2]
    line = whites(light if light == "daylight" else "planck")[1]
    here = at(pairs[0, chosen])
    parts = [
        _ground(),
        polyline([at(xy) for xy in line[::4]], "light"),
        *(dot(at(xy), "world", 2.5) for xy in pairs[0]),
        circle(at(D65_XY), 4, "muted"),
        dot(at(white_xy), "light", 5),
    ]
    if twin:
        parts += [circle(at(pairs[1, chosen]), 5.5, style) for style in ("casing", "world bold")]
    parts += [circle(here, 5, "casing"), dot(here, "ray", 5)]
    return "".join(parts)


@cache
def _ground() -> str:
    """Axes, the edge of all colours, and the display's triangle."""
    edge = xyz_to_xyy(matching_functions(PURE_NM))[:, :2]
    marked = xyz_to_xyy(matching_functions(np.array(MARKED_NM)))[:, :2]
    corner = at((0, 0))
    parts = [
        PLOT.frame(TICKS, TICKS),
        text((PLOT.x.end + 8, corner[1] + 19), "x", "italic"),
        text((corner[0] - 8, PLOT.y.end + 2), "y", "italic", "end"),
        polygon([at(xy) for xy in edge], "world thin"),
        polygon([at(xy) for xy in SRGB_PRIMARIES_XY], "image fill thin"),
        text(at((0.33, 0.235)), "sRGB", "image small", "middle"),
    ]
    for nm, xy in zip(MARKED_NM, marked, strict=True):
        x, y = at(xy)
        parts.append(dot((x, y), "world", 2))
        parts.append(text((x + 9, y - 4), f"{nm} nm", "world small"))
    return "".join(parts)
