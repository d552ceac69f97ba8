"""All pairs of paint and light that make the same pixel value: a curve for each value."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.models.color.srgb import decode_srgb

PLOT = Plot(Axis(0, 4, 48, 392), Axis(0, 1, 222, 14))
"""Irradiance, in units of the lamp's on a wall that faces it, and albedo."""
ACROSS = Scale(ticks=range(5), tick_style="muted small")
UP = Scale(ticks=(0, 0.5, 1), tick_style="muted small")
VALUE = 149
OTHERS = ((75, 1.8), (220, 2.6))
"""Other pixel values, and the places of their labels along the axis."""
WALLS = (
    (0.38, "white wall, in the shade"),
    (1.0, "grey wall, by the lamp"),
    (2.6, "dark wall, in the sun"),
)
"""Light, and its source."""


def albedo(value: float, light: float) -> float:
    """The albedo that has the pixel value in that light."""
    return float(decode_srgb(value / 255)) / light


def _curve(value: float, style: str) -> str:
    light = np.linspace(0.05, 4.0, 800)
    return PLOT.curve(light, [albedo(value, at) for at in light], style)


def _label_above(light: float, value: float, name: str, style: str) -> str:
    x, y = PLOT.at(light, albedo(value, light))
    return label((x + 9, y - 6), name, style)


def draw() -> Illustration:
    marks = [
        PLOT.frame(ACROSS, UP),
        *(_curve(value, "muted thin dashed") for value, _ in OTHERS),
        *(_label_above(light, value, f"{value}", "muted") for value, light in OTHERS),
        _curve(VALUE, "image bold"),
        *(_label_above(light, VALUE, name, "world ground") for light, name in WALLS),
        *(dot(PLOT.at(light, albedo(VALUE, light)), "world", 4.5) for light, _ in WALLS),
        label((84, 26), f"pixel value {VALUE}", "image strong ground"),
        label((219, 262), "light on the wall", "light", "middle"),
        label((39, 70), "albedo", "world small", "end"),
    ]
    pairs = "; ".join(
        f"{name}, light {light:g} and albedo {albedo(VALUE, light):.2f}" for light, name in WALLS
    )
    words = f"A curve through all pairs of light and albedo whose pixel value is {VALUE}: {pairs}."
    return Illustration((Panel("pairs", "", 400.0, 268.0, overlay="".join(marks)),), words)
