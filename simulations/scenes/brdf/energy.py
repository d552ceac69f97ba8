"""The curve of the BRDF figure: how much of the light is sent back, by the angle it comes at."""

from functools import cache

import numpy as np

from simulations.engine.drawing import Point, circle, dot, line, path, polygon, polyline, text
from simulations.models.arrays import Floats
from simulations.models.light.brdf import schlick
from simulations.scenes._ball.marks import HEIGHT
from simulations.scenes.brdf.stages import INCIDENCE_DEG

LEFT, RIGHT, FLOOR, CEILING = 46.0, 384.0, 280.0, 30.0
HIGHEST = 1.5


def at(angle_deg: float, share: float) -> tuple[float, float]:
    """View box units; what is higher than the panel is held to its edge."""
    across = LEFT + (RIGHT - LEFT) * angle_deg / 90.0
    return across, FLOOR - (FLOOR - CEILING) * min(share, HIGHEST) / HIGHEST


def angle_at(place: Point) -> float:
    """Of the light, for a place of the panel: 0 to 90 degrees."""
    angle = 90.0 * (float(place[0]) - LEFT) / (RIGHT - LEFT)
    return min(max(angle, 0.0), 90.0)


def energy_plot(curve: Floats, angle_deg: float, sent: float, head_on: float | None) -> str:
    """What is sent back (23,), of a smooth facet too, and the present light."""
    angles = INCIDENCE_DEG.tolist()
    here = at(angle_deg, sent)
    within = "error bold" if float(curve.max()) > 1.0 else "ray bold"
    parts = [
        _ground(),
        polyline([at(a, s) for a, s in zip(angles, curve.tolist(), strict=True)], within),
        line((here[0], FLOOR), here, "light thin"),
        *(circle(here, 5.5, "casing"), dot(here, "light", 5)),
    ]
    if head_on is not None:
        fine = np.linspace(0.0, 90.0, 46)
        facet = schlick(np.cos(np.radians(fine)), head_on)
        line_of = [at(a, s) for a, s in zip(fine.tolist(), facet.tolist(), strict=True)]
        parts.insert(1, polyline(line_of, "image thin dashed"))
        label = (LEFT + 8, at(0.0, head_on)[1] - 6)
        parts.append(text(label, "F(θ) of one facet", "image small halo"))
    return "".join(parts)


@cache
def _ground() -> str:
    parts = [
        polygon([at(0, 1), at(90, 1), at(90, HIGHEST), at(0, HIGHEST)], "error fill faint"),
        path([[at(0, HIGHEST), at(0, 0), at(90, 0)]], "muted"),
        line(at(0, 1), at(90, 1), "error thin dashed"),
        text((LEFT + 8, at(0, 1)[1] - 7), "more than came", "error small halo"),
        text((RIGHT, HEIGHT - 10), "angle of the light from the normal, °", "light", "end"),
    ]
    for angle in (0, 30, 60, 90):
        x, y = at(angle, 0)
        parts += [line((x, y), (x, y + 4), "muted thin")]
        parts += [text((x, y + 19), f"{angle}", "muted", "middle")]
    for share in (0.0, 0.5, 1.0, 1.5):
        parts.append(text((LEFT - 8, at(0, share)[1] + 4.5), f"{share:g}", "muted", "end"))
    return "".join(parts)
