"""The axis of wavelengths that two panels of the spectrum figure share, with its colours."""

from functools import cache

import numpy as np

from simulations.engine.drawing import Point, line, path, text
from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.color.cie import xyz_to_linear_rgb
from simulations.models.color.observer import OBSERVER
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.srgb import encode_srgb

WIDTH, HEIGHT = 400, 320
LEFT, RIGHT, FLOOR, CEILING = 34.0, 386.0, 262.0, 52.0
"""Of the plot; the ceiling is 1."""
FIRST_NM, LAST_NM = float(WAVELENGTHS_NM[0]), float(WAVELENGTHS_NM[-1])
TICKS_NM = (400, 500, 600, 700)
STRIP = 10
"""Height of the strip of colours below the floor."""
GREY = 0.15
"""Added to the colours of the strip: none of them lies in the display's gamut."""


def at(wavelength_nm: float, share: float) -> tuple[float, float]:
    """View box units of a wavelength and of a height from 0 to 1."""
    along = (wavelength_nm - FIRST_NM) / (LAST_NM - FIRST_NM)
    return LEFT + (RIGHT - LEFT) * along, FLOOR - (FLOOR - CEILING) * share


def wavelength_at(place: Point) -> float:
    """In nm, of a place of the panel."""
    return FIRST_NM + (LAST_NM - FIRST_NM) * (float(place[0]) - LEFT) / (RIGHT - LEFT)


def curve(heights: Floats) -> list[tuple[float, float]]:
    """The points of a spectrum (81,), held to what the panel has room for."""
    held = np.clip(heights, 0.0, 1.12).tolist()
    return [at(nm, height) for nm, height in zip(WAVELENGTHS_NM.tolist(), held, strict=True)]


def area(heights: Floats) -> list[tuple[float, float]]:
    """The outline of what lies under a spectrum."""
    return [at(FIRST_NM, 0.0), *curve(heights), at(LAST_NM, 0.0)]


@cache
def axes() -> str:
    """Lines, ticks and their names."""
    parts = [
        path([[at(FIRST_NM, 1.0), at(FIRST_NM, 0.0), at(LAST_NM, 0.0)]], "muted"),
        path([[at(FIRST_NM, 1.0), at(LAST_NM, 1.0)]], "muted thin faint"),
        text((LEFT - 7, at(0, 1.0)[1] + 4.5), "1", "muted", "end"),
        text((LEFT - 7, FLOOR + 4.5), "0", "muted", "end"),
        text((RIGHT, FLOOR + 52), "wavelength, nm", "", "end"),
    ]
    for tick in TICKS_NM:
        x = at(tick, 0.0)[0]
        parts.append(line((x, FLOOR + STRIP), (x, FLOOR + STRIP + 4), "muted thin"))
        parts.append(text((x, FLOOR + STRIP + 19), f"{tick}", "muted", "middle"))
    return "".join(parts)


@cache
def colours_below() -> Raster:
    """(H, W, 4) the colours of the wavelengths as near as a display comes, under the floor."""
    picture = np.zeros((HEIGHT, WIDTH, 4), np.uint8)
    linear = np.clip(xyz_to_linear_rgb(OBSERVER) / 2.2 + GREY * OBSERVER.sum(1)[:, None] / 3, 0, 1)
    places = np.arange(round(RIGHT) - round(LEFT)) * (len(linear) - 1) / (RIGHT - LEFT)
    strip = np.stack([np.interp(places, np.arange(len(linear)), c) for c in linear.T], axis=-1)
    top = round(FLOOR)
    picture[top + 1 : top + STRIP, round(LEFT) : round(RIGHT)] = to_rgba8(encode_srgb(strip[None]))
    return picture
