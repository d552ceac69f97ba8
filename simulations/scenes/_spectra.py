"""What the two figures on spectra share: their controls, lights and surfaces, the axis of
wavelengths with its colours, and a chart of patches: a column for each surface, a row for each way
to see it."""

from dataclasses import dataclass
from functools import cache

import numpy as np

from simulations.engine.drawing import dot, line, rectangle, text
from simulations.engine.frame import Raster
from simulations.engine.handles import Handle
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.engine.raster import to_rgba8
from simulations.engine.settings import choice, slider, toggle
from simulations.models.arrays import Floats
from simulations.models.color import illuminants
from simulations.models.color.cie import xyz_to_linear_rgb
from simulations.models.color.observer import OBSERVER
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.srgb import encode_srgb
from simulations.models.color.surfaces import CHART, chart_patch, dyed_cloth, metameric_twins

LIGHTS = {
    "planck": "Incandescent",
    "daylight": "Daylight",
    "fluorescent": "Fluorescent tube",
    "diode": "White LED",
}
SURFACES = {
    "cloth": "Dyed cloth (band and width)",
    "dark-skin": "Dark skin",
    "light-skin": "Light skin",
    "sky": "Blue sky",
    "foliage": "Foliage",
    "orange": "Orange",
    "purple": "Purple",
    "blue": "Blue",
    "green": "Green",
    "red": "Red",
    "yellow": "Yellow",
    "white": "White",
}
NAMES = tuple(SURFACES)  # the cloth, then the measured patches
COOLEST_K, HOTTEST_K, STEP_K = 2000, 12000, 50  # of the slider of temperature
DAYLIGHT = illuminants.daylight(illuminants.D65_K)  # in which the twins match
MEASURED = np.stack([chart_patch(name) for name in CHART])  # (11, 81), which do not change

WIDTH, HEIGHT = 400, 320
PLOT = Plot(
    Axis(float(WAVELENGTHS_NM[0]), float(WAVELENGTHS_NM[-1]), 34.0, 386.0),
    Axis(0.0, 1.0, 262.0, 52.0),
)
BELOW = HEIGHT - round(PLOT.y.start)  # space below the floor, for the names of the axis
FINE = 2  # pixels per unit of the view box
STRIP = 10  # height of the strip of colours below the floor
WAVELENGTHS = Scale("wavelength", "nm", ticks=(400, 550, 700), gap=STRIP)
SHARES = Scale(ticks=(0, 1), grid=(1,))
COLUMNS = slice(FINE * round(PLOT.x.start), FINE * round(PLOT.x.end))  # pixels along the axis
GREY = 0.15  # added to the colours of the strip, which are all outside the display's gamut
FAINT = 0.3  # share of the most visible wavelength from which colours fade to the ground
SOFTLY = np.array([1, 2, 3, 4, 3, 2, 1]) / 16
"""Weights of wavelengths 5 nm apart: where a channel is clipped, the strip would show an edge that
the spectrum does not have."""

UNIT = 4  # view box units per pixel of the chart
LEFT, TOP, CELL = 88, 12, 24  # corner of the chart, and the width of a patch
KNOB = 302.0  # height of the handle, which hangs below the frame of the chosen surface


@dataclass(frozen=True, slots=True, kw_only=True)
class LitSurface:
    """A light and the surface that it falls on."""

    light: str = choice("Light", LIGHTS)
    temperature: float = slider("Colour temperature", 2850, COOLEST_K, HOTTEST_K, STEP_K, unit="K")
    surface: str = choice("Surface", SURFACES)
    band: float = slider("Cloth: band at", 605, 420, 660, 5, unit="nm")
    width: float = slider("Cloth: width σ", 45, 10, 100, 5, unit="nm")
    twin: bool = toggle("Show the metameric twins")


def light_of(light: str, temperature: float) -> Floats:
    """(81,) its power, with a mean of 1 over 400 to 700 nm."""
    match light:
        case "planck":
            power = illuminants.planck(temperature)
        case "daylight":
            power = illuminants.daylight(max(temperature, illuminants.DAYLIGHT_K[0]))
        case "fluorescent":
            power = illuminants.fluorescent()
        case _:
            power = illuminants.white_diode()
    visibility = (WAVELENGTHS_NM >= 400.0) & (WAVELENGTHS_NM <= 700.0)
    return power / power[visibility].mean()


def surfaces_of(band: float, width: float) -> Floats:
    """(12, 81) reflectances, in the order of `NAMES`."""
    return np.concatenate([dyed_cloth(band, width)[None], MEASURED])


def with_twins(surfaces: Floats) -> Floats:
    """(2, 12, 81) the surfaces, then others that match them in daylight."""
    return np.stack([surfaces, metameric_twins(surfaces, DAYLIGHT)])


def outside_gamut(linear: Floats) -> bool:
    """Whether a colour (3,) lies outside the gamut of sRGB."""
    return bool((np.abs(linear - 0.5) > 0.5).any())


def lit_surface(settings: LitSurface) -> str:
    """``A dyed cloth … in the light of daylight of 6500 K``, for descriptions."""
    kelvin, surface = settings.temperature, settings.surface
    light = {
        "planck": f"an incandescent body of {kelvin:.0f} K",
        "daylight": f"daylight of {max(kelvin, illuminants.DAYLIGHT_K[0]):.0f} K",
        "fluorescent": "a fluorescent tube",
        "diode": "a white LED",
    }[settings.light]
    patches = {
        "cloth": f"A dyed cloth that sends back light about {settings.band:.0f} nm",
        "sky": "A patch like blue sky",
        "white": "A white patch",
    }
    patch = patches.get(surface, f"A patch of the colour {surface.replace('-', ' ')}")
    return f"{patch} in the light of {light}"


def curve(heights: Floats, style: str) -> str:
    """A spectrum (81,) of heights from 0 to 1."""
    return PLOT.curve(WAVELENGTHS_NM, heights, style)


@cache
def axes() -> str:
    return PLOT.frame(WAVELENGTHS, SHARES)


@cache
def colours_below() -> Raster:
    """(H, W, 4) the colours of the wavelengths as near as a display can show, under the floor."""
    floor = FINE * round(PLOT.y.start)
    picture = np.zeros((floor + FINE * BELOW, FINE * WIDTH, 4), np.uint8)
    picture[floor + FINE : floor + FINE * STRIP, COLUMNS] = rainbow()
    return picture


def colours_under(heights: Floats) -> Raster:
    """The same, with the area under a spectrum (81,) of heights from 0 to 1 in its colours."""
    picture = colours_below().copy()
    steps = np.linspace(0.0, len(heights) - 1.0, COLUMNS.stop - COLUMNS.start)
    edge = FINE * PLOT.y.position(np.interp(steps, np.arange(len(heights)), heights))
    rows = np.arange(FINE * round(PLOT.y.end), FINE * round(PLOT.y.start))
    area, colours = (each.view(np.uint32)[..., 0] for each in (picture[:, COLUMNS], rainbow()))
    np.copyto(area[rows[0] : rows[-1] + 1], colours, where=rows[:, None] >= edge)
    return picture


@cache
def rainbow() -> Raster:
    """(1, columns, 4), transparent where the eye sees next to nothing."""
    linear = np.clip(xyz_to_linear_rgb(OBSERVER) / 2.2 + GREY * OBSERVER.sum(1)[:, None] / 3, 0, 1)
    ends = np.pad(encode_srgb(linear), ((len(SOFTLY) // 2,) * 2, (0, 0)), mode="edge")
    places = np.linspace(0.0, len(linear) - 1.0, COLUMNS.stop - COLUMNS.start)
    channels = (np.convolve(channel, SOFTLY, "valid") for channel in ends.T)
    strip = [np.interp(places, np.arange(len(linear)), channel) for channel in channels]
    visibility = OBSERVER.sum(axis=1) / OBSERVER.sum(axis=1).max() / FAINT
    opacity = np.interp(places, np.arange(len(visibility)), np.minimum(visibility, 1.0))
    return to_rgba8(np.stack(strip, axis=-1)[None], opacity[None])


@dataclass(frozen=True, slots=True)
class Chart:
    """The layout of a chart of patches."""

    rows: tuple[tuple[str, str], ...]  # names of the rows and their colour roles, from the top
    row: int  # height of a patch in view box units, a multiple of 8
    gap: int = 12  # space between the rows, a multiple of 4

    def paint(self, steps: tuple[Floats, ...], *, twin: bool) -> Raster:
        """Bytes (H, W, 4) from linear sRGB (2, 12, 3) for each row; twins in the lower halves."""
        colours = np.stack([each if twin else each[[0, 0]] for each in steps])
        cells = to_rgba8(encode_srgb(colours.reshape(-1, len(NAMES), 3)))
        picture = np.zeros((HEIGHT // UNIT, WIDTH // UNIT, 4), np.uint8)
        halves = cells.repeat(self.row // UNIT // 2, axis=0).repeat(CELL // UNIT, axis=1)
        high, left = self.row // UNIT, LEFT // UNIT
        for row in range(len(self.rows)):
            top = self.top(row) // UNIT
            patches = halves[row * high : (row + 1) * high]
            picture[top : top + high, left : left + patches.shape[1]] = patches
        return picture

    def overlay(self, surface: str) -> str:
        """The names and borders of the rows, and a frame around the chosen surface."""
        across, down = CELL * len(NAMES), self.top(len(self.rows)) - self.gap - TOP
        corner, knob = (LEFT + NAMES.index(surface) * CELL, TOP - 4), knob_of(surface)
        names = [
            text((LEFT - 8, self.top(row) + self.row / 2 + 4.5), name, role, "end")
            for row, (name, role) in enumerate(self.rows)
        ]
        tops = range(TOP, TOP + down, self.row + self.gap) if self.gap else (TOP,)
        high = self.row if self.gap else down
        borders = [rectangle((LEFT, top), across, high, "muted thin faint") for top in tops]
        frame = rectangle(corner, CELL, down + 8, "ray bold")
        stem = line((knob[0], corner[1] + down + 8), knob, "ray bold")
        return "".join((*names, *borders, frame, stem, dot(knob, "ray", 5)))

    def top(self, row: int) -> int:
        """Upper edge of a row."""
        return TOP + row * (self.row + self.gap)


def knob_of(surface: str) -> tuple[float, float]:
    return LEFT + (NAMES.index(surface) + 0.5) * CELL, KNOB


SURFACE = Handle[LitSurface](
    "surface",
    "patches",
    "Surface",
    drives=("surface",),
    at=lambda settings, _: knob_of(settings.surface),
    reach="press",
    role="ray",
)
