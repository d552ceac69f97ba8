"""Three round cards over a chequered floor before a striped wall, through any point of a lens.

Made for judging depth of field: near cards hide what only part of the lens can see, and the
floor runs through every depth. Camera axes: x right, y down, z forward, in metres; the lens lies
in z = 0. All edges and patterns are mean values over a pixel.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.pictures.coverage import checker, stripes

type Floats = NDArray[np.floating]

WIDTH, HEIGHT, FOCAL_PX = 80, 60, 75.0
HORIZON_ROW = 18.0
FLOOR_Y, WALL_Z = 0.8, 8.0
FOCUS_Z = 3.0


@dataclass(frozen=True, slots=True)
class Card:
    """A round card that faces the camera."""

    x: float
    y: float
    z: float
    """Depth along the optical axis."""
    radius: float
    colour: tuple[float, float, float]
    """Linear RGB, and of the stripes half as much."""


CARDS = (
    Card(0.9, -0.05, 5.0, 0.62, (0.20, 0.45, 0.85)),
    Card(0.05, 0.10, 3.0, 0.42, (0.90, 0.70, 0.15)),
    Card(-0.32, 0.12, 1.6, 0.26, (0.85, 0.15, 0.12)),
)
"""Farthest first: behind the focus, in it, before it."""


def normalised_pixels(dtype: type[np.floating]) -> tuple[Floats, Floats]:
    """Directions of the pixels: x (1, 80) and y (60, 1), at z = 1."""
    x = (np.arange(WIDTH, dtype=dtype) - (WIDTH - 1) / 2) / FOCAL_PX
    y = (np.arange(HEIGHT, dtype=dtype) - HORIZON_ROW) / FOCAL_PX
    return x[None, :].astype(dtype), y[:, None].astype(dtype)


def radiance(x: Floats, y: Floats, lens_x: Floats | float, lens_y: Floats | float) -> Floats:
    """Light (3, H, W) that reaches the pixels ``x``, ``y`` through the point (lens_x, lens_y).

    The lens bends every ray of a pixel through the same point at `FOCUS_Z`; metres.
    """
    picture, _ = background(x, y, lens_x, lens_y)
    for card in CARDS:
        colour, cover = card_light(card, x, y, lens_x, lens_y)
        picture += (colour - picture) * cover
    return picture


def background(
    x: Floats, y: Floats, lens_x: Floats | float = 0.0, lens_y: Floats | float = 0.0
) -> tuple[Floats, Floats]:
    """Floor and wall: light (3, H, W), and the depth (H, W) of what is seen."""
    wall_x, wall_y = _at_depth(x, y, lens_x, lens_y, WALL_Z)
    falling = np.maximum(y - lens_y / FOCUS_Z, FLOOR_Y / 50.0)
    depth = np.clip((FLOOR_Y - lens_y) / falling, 0.1, WALL_Z)
    floor_x, _ = _at_depth(x, y, lens_x, lens_y, depth)
    tiles = checker(floor_x, depth, 0.5, depth / FOCAL_PX, depth**2 / (FLOOR_Y * FOCAL_PX))
    pixel = x.dtype.type(WALL_Z / FOCAL_PX)
    bars = stripes(wall_x, 1.2, 0.6, pixel) + 0 * wall_y
    floor = np.clip(0.5 + (wall_y - FLOOR_Y) / pixel, 0.0, 1.0)
    shade = floor * (0.15 + 0.6 * tiles) + (1.0 - floor) * (0.3 + 0.5 * bars)
    picture = np.stack([shade, 0.95 * shade, 0.85 * shade])
    return picture, depth + 0 * shade


def card_light(
    card: Card, x: Floats, y: Floats, lens_x: Floats | float = 0.0, lens_y: Floats | float = 0.0
) -> tuple[Floats, Floats]:
    """Light of the card's plane (3, H, W), and how much of each pixel the card covers (H, W)."""
    at_x, at_y = _at_depth(x, y, lens_x, lens_y, card.z)
    pixel = x.dtype.type(card.z / FOCAL_PX)
    from_centre = np.sqrt((at_x - card.x) ** 2 + (at_y - card.y) ** 2)
    cover = np.clip(0.5 + (card.radius - from_centre) / pixel, 0.0, 1.0)
    shade = 0.5 + 0.5 * stripes(at_x + 0.4 * at_y, card.radius / 2, card.radius / 4, pixel)
    return np.stack([shade * part for part in card.colour]), cover


def _at_depth(
    x: Floats, y: Floats, lens_x: Floats | float, lens_y: Floats | float, z: Floats | float
) -> tuple[Floats, Floats]:
    """Where the pixel's rays pass the depth ``z``: all meet at the depth in focus."""
    off = 1.0 - z / FOCUS_Z
    return x * z + lens_x * off, y * z + lens_y * off
