"""The axis of wavelengths that both figures on spectra have, with its colours."""

from functools import cache

import numpy as np

from simulations.engine.frame import Raster
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.color.cie import xyz_to_linear_rgb
from simulations.models.color.observer import OBSERVER
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.srgb import encode_srgb

WIDTH, HEIGHT = 400, 320
PLOT = Plot(
    Axis(float(WAVELENGTHS_NM[0]), float(WAVELENGTHS_NM[-1]), 34.0, 386.0),
    Axis(0.0, 1.0, 262.0, 52.0),
)
BELOW = HEIGHT - round(PLOT.y.start)
"""Space below the floor, for the names of the axis."""
FINE = 2
"""Pixels per unit of the view box."""
STRIP = 10
"""Height of the strip of colours below the floor."""
WAVELENGTHS = Scale("wavelength", "nm", ticks=(400, 550, 700), gap=STRIP)
SHARES = Scale(ticks=(0, 1), grid=(1,))
COLUMNS = slice(FINE * round(PLOT.x.start), FINE * round(PLOT.x.end))
"""The columns of pixels between the ends of the axis."""
GREY = 0.15
"""Grey added to the colours of the strip, which are all outside the display's gamut."""
SOFTLY = np.array([1, 2, 3, 4, 3, 2, 1]) / 16
"""Weights of wavelengths 5 nm apart: where a channel is clipped, the strip would show an edge that
the spectrum does not have."""


def curve(heights: Floats, style: str, plot: Plot = PLOT) -> str:
    """A spectrum (81,) of heights from 0 to 1."""
    return plot.curve(WAVELENGTHS_NM, heights, style)


def area(heights: Floats, style: str, plot: Plot = PLOT) -> str:
    """The area under a spectrum."""
    return plot.area(WAVELENGTHS_NM, heights, style)


@cache
def axes(plot: Plot = PLOT) -> str:
    """Lines, ticks and their names."""
    return plot.frame(WAVELENGTHS, SHARES)


@cache
def colours_below(plot: Plot = PLOT) -> Raster:
    """(H, W, 4) the colours of the wavelengths as near as a display can show, under the floor."""
    floor = FINE * round(plot.y.start)
    picture = np.zeros((floor + FINE * BELOW, FINE * WIDTH, 4), np.uint8)
    picture[floor + FINE : floor + FINE * STRIP, COLUMNS] = _rainbow()
    return picture


def colours_under(heights: Floats) -> Raster:
    """The same, with the area under a spectrum (81,) of heights from 0 to 1 in its colours."""
    picture = colours_below().copy()
    steps = np.linspace(0.0, len(heights) - 1.0, COLUMNS.stop - COLUMNS.start)
    edge = FINE * PLOT.y.position(np.interp(steps, np.arange(len(heights)), heights))
    rows = np.arange(FINE * round(PLOT.y.end), FINE * round(PLOT.y.start))
    area = picture[rows[0] : rows[-1] + 1, COLUMNS]
    np.copyto(area, _rainbow(), where=(rows[:, None] >= edge)[..., None])
    return picture


@cache
def _rainbow() -> Raster:
    """(1, columns, 4)."""
    linear = np.clip(xyz_to_linear_rgb(OBSERVER) / 2.2 + GREY * OBSERVER.sum(1)[:, None] / 3, 0, 1)
    ends = np.pad(encode_srgb(linear), ((len(SOFTLY) // 2,) * 2, (0, 0)), mode="edge")
    places = np.linspace(0.0, len(linear) - 1.0, COLUMNS.stop - COLUMNS.start)
    channels = (np.convolve(channel, SOFTLY, "valid") for channel in ends.T)
    strip = [np.interp(places, np.arange(len(linear)), channel) for channel in channels]
    return to_rgba8(np.stack(strip, axis=-1)[None])
