"""The panel of materials: a ball of the chosen one, and a chart of others to choose from.

Spheres are lit by the lamp and seen from far away. In the chart the roughness grows to the right
and the specular strength upwards.
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from simulations.engine.drawing import Point, text
from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb, encode_srgb_codes, encode_srgb_table
from simulations.models.light.brdf import Material, parts
from simulations.scenes._ball import HEIGHT, WIDTH, light_direction, named, outlined_dot

SMOOTHEST, ROUGHEST = 0.15, 1.0
TINT = np.array([1.0, 0.13, 0.1], np.float32)
"""Albedo of the spheres in green and blue, as a share of that in red; the figure follows red."""
WALL = np.array([0.05, 0.055, 0.062], np.float32)  # linear RGB behind the spheres
FINE = 1.75  # raster pixels per unit of the view box
CENTRE, RADIUS = (104.0, 170.0), 92.0  # the ball, in view box units
LEFT, RIGHT, TOP, BOTTOM = 236.0, 370.0, 90.0, 250.0  # centres of the chart's outer spheres
SMALL = 20.0  # radius of a sphere of the chart
NAMES = (
    (0.02, "chalk", "chalk"),
    (0.12, "glossy plastic", "satin paint"),
    (0.45, "lacquer", "silk"),
    (1.0, "polished metal", "brushed metal"),
)
"""What a material looks like: up to a specular strength, smooth and rough."""
ROUGH = 0.4
STEPS = np.linspace(0.0, 1.0, 4).tolist()  # columns and rows, as shares of the chart's sides


@dataclass(frozen=True, slots=True)
class Sphere:
    """The pixels of a square around a sphere."""

    normals: Floats  # (n, n, 3) unit normals; z towards the camera
    cover: Floats  # (n * n,) share of the pixel that the sphere covers
    unlit: Raster  # (n, n, 4) bytes of the square with a black sphere


@dataclass(frozen=True, slots=True)
class LitSphere:
    """The light that a sphere sends to the camera; 1 is a perfect white that faces the lamp."""

    pixels: NDArray[np.intp]
    """(N,) indices into the flattened square of the pixels that the lamp reaches."""
    matte: Floats  # (N,) the matte part, for an albedo of 1
    mirrored: Floats  # (N,) the specular part


def sphere(radius_px: float) -> Sphere:
    """A sphere in the middle of its square."""
    count = 2 * math.ceil(radius_px)
    along = ((np.arange(count) + 0.5 - count / 2) / radius_px).astype(np.float32)
    x, y = np.meshgrid(along, -along)
    distance = np.hypot(x, y)
    outer = np.maximum(distance, 1.0)
    z = np.sqrt(np.maximum(1.0 - distance * distance, 0.0))
    cover = np.clip((1.0 - distance) * radius_px + 0.5, 0.0, 1.0)
    wall = encode_srgb_table(WALL * (1.0 - cover[..., None]))
    normals = np.stack([x / outer, y / outer, z], axis=-1)
    return Sphere(normals, cover.ravel(), to_rgba8(wall))


BALL, SAMPLE = sphere(RADIUS * FINE), sphere(SMALL * FINE)


def lit_spheres(
    of: Sphere,
    model: str,
    materials: Iterable[tuple[float, float]],
    light_angle: float,
    view_angle: float,
) -> tuple[LitSphere, ...]:
    """Spheres of these roughnesses and specular strengths in the light of the lamp; the camera is
    in front."""
    to_light = light_direction(light_angle - view_angle).astype(np.float32)
    shade = (of.normals @ to_light).ravel()
    pixels = np.flatnonzero((shade > 0) & (of.cover > 0))
    arriving, facing = shade[pixels], of.normals[..., 2].ravel()[pixels]
    of_white, found = arriving * np.float32(np.pi), []
    for roughness, specular in materials:
        material = Material(1.0, specular, roughness)
        matte, mirrored = parts(model, material, arriving, facing, to_light[2])
        found.append(LitSphere(pixels, matte * of_white, mirrored * of_white))
    return tuple(found)


def samples() -> Iterator[tuple[float, float]]:
    """Roughness and specular strength of the spheres of the chart."""
    for specular in STEPS:
        for share in STEPS:
            yield SMOOTHEST + share * (ROUGHEST - SMOOTHEST), specular


def lit_samples(model: str, light_angle: float, view_angle: float) -> tuple[LitSphere, ...]:
    """The spheres of the chart, in the order of `samples`."""
    return lit_spheres(SAMPLE, model, samples(), light_angle, view_angle)


@cache
def bare_wall() -> Raster:
    """(H, W, 4) bytes of the panel without spheres."""
    wall = to_rgba8(encode_srgb(WALL[None, None]))
    return np.tile(wall, (round(HEIGHT * FINE), round(WIDTH * FINE), 1))


def chart(samples_lit: tuple[LitSphere, ...], albedo: float) -> Raster:
    """(H, W, 4) bytes of the panel without its ball."""
    picture = bare_wall().copy()
    for material, light in zip(samples(), samples_lit, strict=True):
        paste(picture, SAMPLE, light, albedo, in_chart(*material))
    return picture


def with_ball(chart: Raster, light: LitSphere, albedo: float) -> Raster:
    """(H, W, 4) bytes of the whole panel."""
    picture = chart.copy()
    paste(picture, BALL, light, albedo, CENTRE)
    return picture


def paste(picture: Raster, of: Sphere, light: LitSphere, albedo: float, middle: Point) -> None:
    """Put the square of a sphere, with the wall around it, into the picture."""
    raster, cover = of.unlit.copy(), of.cover[light.pixels]
    tint, wall = (np.float32(albedo) * TINT)[:, None], WALL[:, None]
    mixed = wall + cover * (light.mirrored + light.matte * tint - wall)
    for channel, codes in enumerate(encode_srgb_codes(mixed)):
        raster.reshape(-1, 4)[light.pixels, channel] = codes
    size = len(raster)
    left, top = (round(FINE * each - size / 2) for each in (middle[0], middle[1]))
    picture[top : top + size, left : left + size] = raster


def on_equator(angle_deg: float) -> tuple[float, float]:
    """The place of the point of the ball's equator whose normal has an angle to the camera."""
    return CENTRE[0] + RADIUS * math.sin(math.radians(angle_deg)), CENTRE[1]


def in_chart(roughness: float, specular: float) -> tuple[float, float]:
    share = (roughness - SMOOTHEST) / (ROUGHEST - SMOOTHEST)
    return LEFT + share * (RIGHT - LEFT), BOTTOM - specular * (BOTTOM - TOP)


def material_at(_settings: object, place: Point) -> Mapping[str, float]:
    """The settings of the material at a place of the chart."""
    share = (float(place[0]) - LEFT) / (RIGHT - LEFT)
    return {
        "roughness": SMOOTHEST + share * (ROUGHEST - SMOOTHEST),
        "specular": (BOTTOM - float(place[1])) / (BOTTOM - TOP),
    }


def material_name(roughness: float, specular: float) -> str:
    smooth, rough = next(names for most, *names in NAMES if specular <= most)
    return rough if roughness > ROUGH else smooth


def marks(view_angle: float, roughness: float, specular: float) -> str:
    """The probed point, the chosen material, and the ends of the chart."""
    probed = on_equator(-view_angle)
    name = f"like {material_name(roughness, specular)}"
    across, below = 0.5 * (LEFT + RIGHT), BOTTOM + SMALL + 24
    return "".join(
        (
            outlined_dot(probed, "world"),
            outlined_dot(in_chart(roughness, specular), "ray"),
            named(probed, "probed point", "world"),
            text((CENTRE[0], CENTRE[1] + RADIUS + 34), name, "strong ground", "middle"),
            text((across, TOP - SMALL - 14), "more mirror ↑", "small ground", "middle"),
            text((across, below), "rougher →", "small ground", "middle"),
        )
    )
