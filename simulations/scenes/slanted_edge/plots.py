"""Three plots of the slanted edge: the light across it, its slope with a wave, and the MTF."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import path, text
from simulations.engine.frame import format_number
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats
from simulations.models.sampling.slanted_edge import FREQUENCIES, EdgeReading
from simulations.models.sampling.slanted_edge_pixels import EdgePixels
from simulations.scenes.slanted_edge.edge import WAVELENGTH_UM, Settings, Sharpness
from simulations.scenes.slanted_edge.results import contrast_of

# Pixels either side of the edge that the second panel may show, at least so many times the width
# over which the light rises from a tenth to nine tenths.
REACHES, RISES = (4.0, 8.0, 16.0, 32.0, 64.0), 2.0
SPOT_UM, MOST_APERTURE = 1.22 * WAVELENGTH_UM, 22.0  # radius of Airy's disc at f/1; smallest hole
OF_EDGE, OF_LINE = Axis(-0.15, 1.15, 92.0, 8.0), Axis(-1.0, 1.2, 222.0, 104.0)
FREQUENCY = Axis(0.0, 1.0, 34.0, 388.0)
NYQUIST = 0.5
SPECK, MOST_SPECKS = 1.4, 800  # length of the stroke for a pixel, and how many are drawn


def axis_across(settings: Settings, reading: EdgeReading | None, simulated: bool) -> Axis:
    """Distances from the edge, in two panels; in the simulated picture for all apertures alike."""
    wanted = SPOT_UM * MOST_APERTURE / settings.pitch
    if not simulated:
        wanted = min(RISES * reading.rise, 0.5 * reading.pixels.reach) if reading else 0.0
    reach = next(reach for reach in REACHES if reach >= wanted)
    return Axis(-reach, reach, 34.0, 388.0)


def light_across(pixels: EdgePixels | str, reading: EdgeReading | None, x: Axis) -> Iterator[str]:
    """Each pixel by its distance from the edge; those of one row set off."""
    plot = Plot(x, OF_EDGE)
    yield plot.frame(Scale(ticks=()), Scale(ticks=(0, 1), grid=(0, 1), tick_style="muted small"))
    if reading is not None:
        place = places_shown(x, reading)
        yield plot.curve(place, reading.curve.spread(place), "image thin")
    if isinstance(pixels, EdgePixels):
        inside = np.abs(pixels.distance) < plot.x.high
        yield specks(plot, pixels.distance[inside], pixels.value[inside])
        row = inside & (pixels.row == len(pixels.line.rows) // 2)
        distance, value = pixels.distance[row], pixels.value[row]
        for place, light in zip(distance.tolist(), value.tolist(), strict=True):
            yield plot.mark(place, light, "camera", 3.5)
    yield text((plot.x.start + 6, plot.y.end + 24), "pixels of the edge", "image small ground")
    yield text((plot.x.start + 6, plot.y.end + 44), "of one row", "camera small ground")


def places_shown(x: Axis, reading: EdgeReading) -> Floats:
    """Distances from the edge, close enough for a wave of one cycle per pixel."""
    reach = min(x.high, reading.pixels.reach - 1.0)
    return np.linspace(-reach, reach, round(40 * reach) + 1)


def line_and_wave(sharpness: Sharpness, frequency: float, x: Axis) -> Iterator[str]:
    """The slope of the light, a wave, and their product: its area is the contrast that is left."""
    plot, reading = Plot(x, OF_LINE), sharpness.reading
    across = Scale("distance from the edge", "px", (x.low, 0, x.high), style="small")
    yield plot.frame(across, Scale(ticks=(-1, 0, 1), grid=(0,), tick_style="muted small"))
    if reading is not None:
        place = places_shown(x, reading)
        slope, turns = reading.curve.slope(place), 2.0 * np.pi * frequency * place
        # Of all shifts of the wave, the one with the largest area.
        wave = np.cos(turns + np.angle(np.sum(slope * np.exp(-1j * turns))))
        yield plot.curve(place, wave, "world thin")
        yield plot.between(place, slope * wave, np.zeros_like(place), "image fill thin")
        yield plot.curve(place, slope, "light bold")
        area = f"area {format_number(contrast_of(reading, frequency), 2)}"
        yield text((plot.x.end, plot.y.start - 8), area, "image small ground", "end")
    entries = (
        Entry("slope, per px", "light bold"),
        Entry("wave", "world thin"),
        Entry("their product", "image fill", "area"),
    )
    yield legend((plot.x.start, 288), entries, "small")


def specks(plot: Plot, distance: Floats, value: Floats) -> str:
    some = slice(None, None, max(1, math.ceil(distance.size / MOST_SPECKS)))
    x = plot.x.position(distance[some])
    y = plot.y.position(np.clip(value[some], plot.y.low, plot.y.high))
    ends = np.stack([x - SPECK / 2, y, x + SPECK / 2, y], axis=-1)
    return path(ends.reshape(-1, 2, 2), "image bold")


def contrast_plot(sharpness: Sharpness) -> Plot:
    most = 1.05 if sharpness.refusal else max(1.05, float(sharpness.contrast.max()) + 0.05)
    return Plot(FREQUENCY, Axis(0.0, most, 222.0, 40.0))


def waves_left(sharpness: Sharpness, true: Floats) -> Iterator[str]:
    """The MTF as measured from the picture, and by the formulae if they are known."""
    known, plot = not np.isnan(true).any(), contrast_plot(sharpness)
    contrast = Scale(ticks=(0, 0.5, 1), grid=(0.5, 1), tick_style="muted small")
    yield plot.region(x=(NYQUIST, 1.0))
    yield plot.frame(Scale("frequency", "cycles per px", (0.5, 1), style="small"), contrast)
    yield plot.upright(NYQUIST, "camera thin dashed")
    yield text((plot.x.place(NYQUIST), 28), "Nyquist", "camera small ground", "middle")
    if known:
        yield plot.curve(FREQUENCIES, true, "ray bold")
    if not sharpness.refusal:
        yield from measured_contrast(plot, sharpness)
    entries = (
        Entry("lens × pixel", "ray bold", visible=known),
        Entry("from the edge ± 2 errors", "image", "dot"),
    )
    yield legend((plot.x.start, 288), entries, "small")


def measured_contrast(plot: Plot, sharpness: Sharpness) -> Iterator[str]:
    """The contrast with twice its standard error, and MTF50."""
    numbers = FREQUENCIES, sharpness.contrast, 2.0 * sharpness.error
    points = list(zip(*(each[::4].tolist() for each in numbers), strict=True))
    yield path([[plot.clamped(f, c - e), plot.clamped(f, c + e)] for f, c, e in points], "image")
    for f, left, _ in points:
        yield plot.mark(f, left, "image", 2.5)
    if np.isfinite(sharpness.half.frequency):
        yield plot.drop(sharpness.half.frequency, 0.5, "image thin dashed", "xy")
