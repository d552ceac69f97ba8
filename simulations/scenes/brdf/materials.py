"""The panel of materials: a ball of the chosen one, and a chart of others to choose from.

In the chart the roughness grows to the right and the specular strength upwards.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from simulations.engine.drawing import Point, circle, dot, text
from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.models.color.srgb import encode_srgb
from simulations.scenes._ball.marks import HEIGHT, WIDTH, named
from simulations.scenes.brdf.settings import ROUGHEST, SMOOTHEST
from simulations.scenes.brdf.spheres import WALL, Lit, Sphere, lit, shown, sphere

FINE = 1.75
"""Raster pixels per unit of the view box."""
CENTRE, RADIUS = (104.0, 170.0), 92.0
"""The ball, in view box units."""
LEFT, RIGHT, TOP, BOTTOM = 236.0, 370.0, 90.0, 250.0
"""Centres of the chart's outer spheres, in view box units."""
ROWS, COLUMNS = 4, 4
SMALL = 20.0
"""Radius of a sphere of the chart."""

BALL = sphere(RADIUS * FINE)
SAMPLE = sphere(SMALL * FINE)
STEPS = np.linspace(0.0, 1.0, COLUMNS)
"""Places of the columns and rows, as shares of the chart's sides."""


def on_equator(angle_deg: float) -> tuple[float, float]:
    """The place of the point of the ball's equator whose normal has an angle to the camera."""
    return CENTRE[0] + RADIUS * math.sin(math.radians(angle_deg)), CENTRE[1]


def angle_of_normal(place: Point) -> float:
    """The angle in degrees of the normal on the equator above or below a place."""
    across = (float(place[0]) - CENTRE[0]) / RADIUS
    return math.degrees(math.asin(min(max(across, -1.0), 1.0)))


def at(roughness: float, specular: float) -> tuple[float, float]:
    """The place of a material in the chart."""
    share = (roughness - SMOOTHEST) / (ROUGHEST - SMOOTHEST)
    return LEFT + share * (RIGHT - LEFT), BOTTOM - specular * (BOTTOM - TOP)


def material_at(place: Point) -> Mapping[str, float]:
    """The settings of the material at a place of the chart."""
    share = (float(place[0]) - LEFT) / (RIGHT - LEFT)
    return {
        "roughness": SMOOTHEST + share * (ROUGHEST - SMOOTHEST),
        "specular": (BOTTOM - float(place[1])) / (BOTTOM - TOP),
    }


def lit_samples(model: str, light_angle: float, view_angle: float) -> tuple[Lit, ...]:
    """The spheres of the chart, in the order of `_samples`."""
    return tuple(
        lit(SAMPLE, model, specular, roughness, light_angle, view_angle)
        for roughness, specular in _samples()
    )


def chart(samples: tuple[Lit, ...], albedo: float) -> Raster:
    """(H, W, 4) bytes of the panel without its ball."""
    wall = to_rgba8(encode_srgb(WALL[None, None]))
    picture = np.tile(wall, (round(HEIGHT * FINE), round(WIDTH * FINE), 1))
    for (roughness, specular), light in zip(_samples(), samples, strict=True):
        _paste(picture, SAMPLE, light, albedo, at(roughness, specular))
    return picture


def with_ball(chart: Raster, light: Lit, albedo: float) -> Raster:
    """The whole panel."""
    picture = chart.copy()
    _paste(picture, BALL, light, albedo, CENTRE)
    return picture


def marks(view_angle: float, roughness: float, specular: float) -> str:
    """The probed point, the chosen material, and the ends of the chart."""
    chosen, probed = at(roughness, specular), on_equator(-view_angle)
    across, below = 0.5 * (LEFT + RIGHT), BOTTOM + SMALL + 24
    return "".join(
        (
            *(circle(probed, 5.5, "casing"), dot(probed, "world", 5.5)),
            *(circle(chosen, 5.5, "casing"), dot(chosen, "ray", 5.5)),
            named(probed, "probed point", "world"),
            text((across, TOP - SMALL - 14), "more mirror ↑", "small ground", "middle"),
            text((across, below), "rougher →", "small ground", "middle"),
        )
    )


def _samples() -> Iterator[tuple[float, float]]:
    """Roughness and specular strength of the spheres of the chart."""
    for specular in STEPS.tolist():
        for share in STEPS.tolist():
            yield SMOOTHEST + share * (ROUGHEST - SMOOTHEST), specular


def _paste(picture: Raster, of: Sphere, light: Lit, albedo: float, middle: Point) -> None:
    size = len(of.unlit)
    left, top = (round(FINE * each - size / 2) for each in (middle[0], middle[1]))
    picture[top : top + size, left : left + size] = shown(of, light, albedo)
