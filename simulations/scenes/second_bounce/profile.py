"""The third panel of the second-bounce figure: brightness along the wall and along the floor."""

from functools import cache

import numpy as np

from simulations.engine.drawing import Point, text
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats
from simulations.scenes.second_bounce.stages import PLACES, Planes

PLOT = Plot(Axis(-1.0, 1.0, 42.0, 386.0), Axis(0.0, 1.2, 262.0, 44.0))
"""Places along the wall from −1 to 0, along the floor from 0 to 1."""
FROM_EDGE = Scale(ticks=[(place, f"{abs(place):g}") for place in (-1, 0, 1)])
LEGEND = (
    Entry("lamp alone", "light dashed"),
    Entry("all: red light", "ray bold"),
    Entry("all: blue light", "image"),
)
BRIGHTNESS = Scale(ticks=(0, 1))
ALONG = np.concatenate([-PLACES[::-1], PLACES])


def at(place: float, brightness: float) -> tuple[float, float]:
    """View box units, clamped to the panel."""
    return PLOT.clamped(place, brightness)


def place_at(point: Point) -> float:
    """Distance along the floor, from the edge."""
    return PLOT.values(point)[0]


def profile(planes: Planes, place: float, shown: tuple[float, float]) -> str:
    """The lamp's part, and all of the light, in red and blue; ``shown`` is at the chosen point."""
    red, blue = planes.all_light
    return "".join(
        (
            _axes(),
            _curve(planes.lamp, "light dashed"),
            _curve(blue, "image"),
            _curve(red, "ray bold"),
            PLOT.drop(place, shown[0], "muted thin"),
            PLOT.mark(place, shown[1], "image", radius=4.0),
            PLOT.mark(place, shown[0], "ray"),
        )
    )


def _curve(brightness: Floats, style: str) -> str:
    """(2, 201) of floor and wall, from the wall's rim over the edge to the floor's."""
    floor, wall = brightness
    return PLOT.curve(ALONG, np.minimum(np.concatenate([wall[::-1], floor]), PLOT.y.high), style)


@cache
def _axes() -> str:
    (wall, foot), (edge, _), (floor, _) = (PLOT.at(place, 0) for place in (-0.5, 0, 0.5))
    return "".join(
        (
            PLOT.frame(FROM_EDGE, BRIGHTNESS),
            PLOT.upright(0.0, "world thin dashed"),
            text((wall, foot + 38), "← along the wall", "world small", "middle"),
            text((floor, foot + 38), "along the floor →", "world small", "middle"),
            text((edge, foot + 38), "edge", "world small", "middle"),
            legend((PLOT.x.start, 22), LEGEND, "small", PLOT.x.end - PLOT.x.start),
        )
    )
