"""Spheres in the light of the lamp, seen from far away."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb_table
from simulations.models.light.brdf import Material, parts
from simulations.scenes._ball.ball import light_direction

TINT = np.array([1.0, 0.13, 0.1], np.float32)
"""Albedo of the spheres in green and blue, as a share of that in red; the figure follows red."""
WALL = np.array([0.05, 0.055, 0.062], np.float32)
"""Linear RGB of the wall behind them."""


@dataclass(frozen=True, slots=True)
class Sphere:
    """The pixels of a square around a sphere."""

    normals: Floats
    """(n, n, 3) unit normals; z towards the camera."""
    cover: Floats
    """(n * n, 1) share of the pixel that the sphere covers."""
    unlit: Raster
    """(n, n, 4) bytes of the square with a black sphere."""


@dataclass(frozen=True, slots=True)
class Lit:
    """The light that a sphere sends to the camera; 1 is a perfect white that faces the lamp."""

    pixels: NDArray[np.intp]
    """(N,) indices into the flattened square of the pixels that the lamp reaches."""
    matte: Floats
    """(N, 1) the matte part, for an albedo of 1."""
    mirrored: Floats
    """(N, 1) the specular part."""


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
    return Sphere(normals, cover.reshape(-1, 1), to_rgba8(wall))


def lit(
    of: Sphere, model: str, specular: float, roughness: float, light_angle: float, view_angle: float
) -> Lit:
    """The sphere in the light of the lamp; the camera is in front."""
    to_light = light_direction(light_angle - view_angle).astype(np.float32)
    shade = (of.normals @ to_light).ravel()
    pixels = np.flatnonzero((shade > 0) & (of.cover[:, 0] > 0))
    arriving, facing = shade[pixels], of.normals[..., 2].ravel()[pixels]
    material = Material(1.0, specular, roughness)
    matte, mirrored = parts(model, material, arriving, facing, to_light[2])
    arriving *= np.float32(np.pi)
    return Lit(pixels, (matte * arriving)[:, None], (mirrored * arriving)[:, None])


def shown(of: Sphere, light: Lit, albedo: float) -> Raster:
    """(n, n, 4) bytes of the square, with the wall around the sphere."""
    linear = light.mirrored + light.matte * (np.float32(albedo) * TINT)
    mixed = WALL + of.cover[light.pixels] * (linear - WALL)
    picture = of.unlit.copy()
    picture.reshape(-1, 4)[light.pixels] = to_rgba8(encode_srgb_table(mixed)[None])[0]
    return picture
