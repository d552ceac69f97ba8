"""The first panel: the light, the surface, and what it sends back."""

import math

from simulations.engine.drawing import Point, dot, text
from simulations.models.arrays import Floats
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.surfaces import LEAST, MOST
from simulations.scenes._spectra.axes import PLOT, axes, curve

HALF_HEIGHT = math.sqrt(2.0 * math.log(2.0))
"""Standard deviations from the peak of a bell to half its height."""
LEGEND = 24.0
"""Row of the names of the curves."""


def light_and_surface(light: Floats, pair: Floats, *, twin: bool, cloth: bool) -> str:
    """The light, the reflectance (2, 81) of a surface and its twin, and the reflected light."""
    height = light / light.max()
    parts = [
        axes(),
        curve(height * pair[0], "ray"),
        curve(height, "light"),
        curve(pair[1], "world dashed") if twin else "",
        curve(pair[0], "world bold"),
        text((40, LEGEND), "light", "light strong"),
        text((92, LEGEND), "× surface", "world strong"),
        text((178, LEGEND), "= what it sends back", "ray strong"),
    ]
    if twin:
        parts.append(text((386, LEGEND + 17), "twin, dashed", "world small ground", "end"))
    if cloth:
        nm = float(WAVELENGTHS_NM[pair[0].argmax()])
        parts.append(dot(band_mark(nm), "world", 4.5))
    return "".join(parts)


def band_mark(band_nm: float) -> tuple[float, float]:
    """The handle at the peak of the cloth's band."""
    return PLOT.at(band_nm, MOST)


def width_mark(band_nm: float, width_nm: float) -> tuple[float, float]:
    """The handle at half the height of the band, on the right."""
    return PLOT.at(band_nm + HALF_HEIGHT * width_nm, 0.5 * (LEAST + MOST))


def width_at(place: Point, band_nm: float) -> float:
    """The width for which the band has half its height at a place."""
    return (PLOT.values(place)[0] - band_nm) / HALF_HEIGHT
