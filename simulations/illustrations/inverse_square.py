"""A lamp and three screens: the same light on one cell, four and nine."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, path, polygon
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.space.view import View, axes_towards
from simulations.models.light.reflectance import PointLight, irradiance

WIDTH, HEIGHT = 400.0, 286.0
SPACE = View(axes_towards((-1.35, -2.6, 1.0)), (60.0, 148.0), 88.0)
DISTANCES = (1, 2, 3)
HALF = 0.32  # half the side of the first screen
LAMP = PointLight((0.0, 0.0, 0.0))


def light_at(distance: float) -> float:
    """Irradiance of a surface that faces the lamp at a distance, relative to that at 1."""
    return float(irradiance(np.array([distance, 0.0, 0.0]), np.array([-1.0, 0.0, 0.0]), [LAMP])[0])


def _screen(distance: int) -> list[str]:
    at, side = SPACE.at, HALF * distance
    cuts = np.linspace(-side, side, distance + 1)
    corners = [
        at(distance, y, z) for y, z in ((-side, -side), (side, -side), (side, side), (-side, side))
    ]
    rules = [[at(distance, cut, -side), at(distance, cut, side)] for cut in cuts]
    rules += [[at(distance, -side, cut), at(distance, side, cut)] for cut in cuts]
    return [polygon(corners, "light fill thin"), path(rules, "world")]


def draw() -> Illustration:
    at, lamp = SPACE.at, SPACE.at(0, 0, 0)
    reach = DISTANCES[-1]
    corners = [(y, z) for y in (-HALF, HALF) for z in (-HALF, HALF)]
    marks = [path([[lamp, at(reach, reach * y, reach * z)] for y, z in corners], "light thin")]
    for distance in DISTANCES:
        marks += _screen(distance)
        across = at(distance, 0, 0)[0]
        share = "1" if distance == 1 else f"1/{1 / light_at(distance):.0f}"
        marks.append(label((across, HEIGHT - 24), share, "light strong", "middle"))
        marks.append(label((across, HEIGHT - 8), f"at {distance} m", "muted small", "middle"))
    marks.append(dot(lamp, "light", 7))
    words = (
        "The light of a lamp that passes one square at 1 m spreads over four such squares at 2 m "
        "and nine at 3 m. Each square gets 1, "
        + " and ".join(f"1/{1 / light_at(d):.0f}" for d in DISTANCES[1:])
        + " of the light."
    )
    return Illustration((Panel("space", "", WIDTH, HEIGHT, overlay="".join(marks)),), words)
