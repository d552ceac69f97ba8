"""The third panel of the Phong figure: how the highlight fades as the camera turns away from it."""

import math

import numpy as np

from simulations.engine.drawing import Point, circle, dot, text
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.scenes.phong.drawing import curve_names
from simulations.scenes.phong.gloss import MODELS, fading, half_width_rad, shininess_of_width

PLOT = Plot(Axis(0.0, 60.0, 46.0, 384.0), Axis(0.0, 1.0, 282.0, 44.0))
TURN = Scale(
    "turn of the camera from the middle",
    ticks=[(degrees, f"{degrees}°") for degrees in (0, 30, 60)],
    centred=True,
)
STRENGTH = Scale(ticks=(0, 1), grid=(1,))
DEGREES = np.arange(0.0, 60.5, 0.5)


def width_plot(model: str, shininess: float) -> str:
    """The highlight (121,) by the chosen model and the other, as a share of its middle."""
    other = next(name for name in MODELS if name != model)
    turns = np.radians(DEGREES)
    half = at(model, shininess)
    x, y = PLOT.at(60, 0.5)
    return "".join(
        (
            PLOT.frame(TURN, STRENGTH),
            curve_names(model),
            PLOT.level(0.5, "muted thin"),
            text((x, y - 7), "half", "muted small", "end"),
            PLOT.curve(DEGREES, fading(other, shininess, turns), "muted thin dashed"),
            PLOT.curve(DEGREES, fading(model, shininess, turns), "ray bold"),
            *((circle(half, 5.5, "casing"), dot(half, "ray", 5)) if half else ()),
        )
    )


def at(model: str, shininess: float) -> tuple[float, float] | None:
    """The place at which the highlight has half its strength; None if it is wider than the plot."""
    half_deg = math.degrees(half_width_rad(model, shininess))
    return PLOT.at(half_deg, 0.5) if half_deg <= PLOT.x.high else None


def shininess_at(place: Point, model: str) -> float:
    """The shininess of the half-width at a place."""
    turn_deg = min(max(PLOT.values(place)[0], 1.0), 60.0)
    return shininess_of_width(model, math.radians(turn_deg))
