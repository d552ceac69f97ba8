"""Brightness of a matte surface against the angle between its normal and the light."""

import math

import numpy as np

from simulations.engine.drawing import dot, text
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale

PLOT = Plot(Axis(0.0, 180.0, 58.0, 382.0), Axis(0.0, 1.0, 282.0, 34.0))
ANGLES = Scale(
    "angle θ between normal and light",
    ticks=[(degrees, f"{degrees}°") for degrees in (0, 90, 180)],
    grid=(90,),
    centred=True,
)
BRIGHTNESS = Scale("brightness I", ticks=(0, 1), grid=(1,), style="image")
DEGREES = np.arange(0.0, 181.0, 2.0)
LIT = np.maximum(np.cos(np.radians(DEGREES)), 0.0)


def brightness_plot(albedo: float, theta_rad: float, brightness: float) -> str:
    """The curve of Lambert's law, and where on it the probed point is."""
    theta_deg = math.degrees(theta_rad)
    parts = [
        PLOT.frame(ANGLES, BRIGHTNESS),
        PLOT.curve(DEGREES[:46], LIT[:46], "muted thin dashed"),
        text(on_plot(66, 0.5), "white paint", "muted small ground"),
        text(on_plot(135, 0.2), "faces away", "muted small", "middle"),
        PLOT.curve(DEGREES, albedo * LIT, "image bold"),
        PLOT.drop(theta_deg, brightness, "ray thin dashed", to="xy"),
        dot(on_plot(0, albedo), "image", 5.5),
        dot(on_plot(theta_deg, brightness), "ray", 5.5),
    ]
    return "".join(parts)


def on_plot(theta_deg: float, brightness: float) -> tuple[float, float]:
    return PLOT.at(theta_deg, brightness)


def read_off(place: tuple[float, float]) -> tuple[float, float]:
    """The angle in degrees and the brightness of a place of the plot."""
    return PLOT.values(place)
