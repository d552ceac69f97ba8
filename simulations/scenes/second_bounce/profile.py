"""The third panel of the second-bounce figure: brightness along the wall and along the floor."""

from functools import cache

import numpy as np

from simulations.engine.drawing import Point, circle, dot, line, path, polyline, text
from simulations.models.arrays import Floats
from simulations.scenes.second_bounce.stages import PLACES, Planes

LEFT, RIGHT, FLOOR, CEILING = 42.0, 386.0, 262.0, 44.0
HIGHEST = 1.2


def at(place: float, brightness: float) -> tuple[float, float]:
    """View box units: −1 to 0 the wall, 0 to 1 the floor; held to the panel."""
    across = LEFT + (RIGHT - LEFT) * (place + 1.0) / 2.0
    return across, FLOOR - (FLOOR - CEILING) * min(brightness, HIGHEST) / HIGHEST


def place_at(point: Point) -> float:
    """Along the floor, from the edge."""
    return 2.0 * (float(point[0]) - LEFT) / (RIGHT - LEFT) - 1.0


def profile(planes: Planes, place: float, shown: tuple[float, float]) -> str:
    """The lamp's part, and all of the light; ``shown`` at the chosen point, red and blue."""
    red, blue = planes.all_light
    here = at(place, shown[0])
    return "".join(
        (
            _axes(),
            polyline(_curve(planes.lamp), "light dashed"),
            polyline(_curve(blue), "image"),
            polyline(_curve(red), "ray bold"),
            line((here[0], FLOOR), here, "muted thin"),
            *(circle(at(place, shown[1]), 4.5, "casing"), dot(at(place, shown[1]), "image", 4)),
            *(circle(here, 5.5, "casing"), dot(here, "ray", 5)),
        )
    )


def _curve(brightness: Floats) -> list[tuple[float, float]]:
    """(2, 201) of floor and wall, from the wall's rim over the edge to the floor's."""
    floor, wall = brightness
    places = np.concatenate([-PLACES[::-1], PLACES]).tolist()
    values = np.concatenate([wall[::-1], floor]).tolist()
    return [at(place, value) for place, value in zip(places, values, strict=True)]


@cache
def _axes() -> str:
    parts = [
        path([[at(-1, HIGHEST), at(-1, 0), at(1, 0)]], "muted"),
        line(at(0, 0), at(0, HIGHEST), "world thin dashed"),
        text((0.5 * (LEFT + at(0, 0)[0]), FLOOR + 38), "wall", "world", "middle"),
        text((0.5 * (RIGHT + at(0, 0)[0]), FLOOR + 38), "floor", "world", "middle"),
        text((at(0, 0)[0], FLOOR + 38), "edge", "world small", "middle"),
        text((LEFT, 22), "lamp alone", "light strong"),
        text((LEFT + 100, 22), "all: red light", "ray strong"),
        text((LEFT + 218, 22), "blue light", "image strong"),
    ]
    for place in (-1.0, -0.5, 0.0, 0.5, 1.0):
        x = at(place, 0)[0]
        parts.append(line((x, FLOOR), (x, FLOOR + 4), "muted thin"))
        parts.append(text((x, FLOOR + 19), f"{abs(place):g}", "muted", "middle"))
    for level in (0.0, 0.5, 1.0):
        parts.append(text((LEFT - 7, at(-1, level)[1] + 4.5), f"{level:g}", "muted", "end"))
    return "".join(parts)
