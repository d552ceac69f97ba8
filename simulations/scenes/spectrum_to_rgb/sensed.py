"""The panel of the sensor: its curves, and their products with the light of the surface."""

from collections.abc import Iterator
from dataclasses import replace

from simulations.engine.drafting import tinted
from simulations.engine.drawing import text
from simulations.models.arrays import Floats
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.scenes._spectra import axes

HEIGHT = 500
"""Taller than the other panel, beside which it is narrower."""
PLOT = replace(axes.PLOT, y=replace(axes.PLOT.y, start=float(HEIGHT - axes.BELOW)))
LEGEND = 24.0
"""Row of the areas."""
CHANNELS = ((0.82, 0.22, 0.18), (0.20, 0.57, 0.20), (0.22, 0.42, 0.88))
"""Colours of the three curves, visible on light and on dark."""
LETTERS = {"camera": ("R", "G", "B"), "eye": ("x̄", "ȳ", "z̄")}


def sensed(light: Floats, reflectance: Floats, curves: Floats, sensor: str, raw: Floats) -> str:
    """The sensor's curves (81, 3), and their products with the light from a surface."""
    back = light / light.max() * reflectance
    scale = curves.max()
    parts = [axes.axes(PLOT)]
    for each, colour in zip(curves.T / scale, CHANNELS, strict=True):
        shape = axes.area(back * each, "fill thin", PLOT), axes.curve(each, "", PLOT)
        parts.append(tinted(shape, colour))
    parts += _letters(curves / scale, LETTERS[sensor])
    sums = ", ".join(
        f"{letter} {value:.2f}" for letter, value in zip(LETTERS[sensor], raw, strict=True)
    )
    parts.append(text((40, LEGEND), f"areas: {sums}", "strong"))
    return "".join(parts)


def _letters(curves: Floats, letters: tuple[str, ...]) -> Iterator[str]:
    """The name of each curve above its peak."""
    for each, letter, colour in zip(curves.T, letters, CHANNELS, strict=True):
        peak = int(each.argmax())
        x, y = PLOT.at(float(WAVELENGTHS_NM[peak]), float(each[peak]))
        yield tinted([text((x, y - 6), letter, "strong ground", "middle")], colour)
