"""Three round cards over a chequered floor before a striped wall, through any point of a lens.

A test picture for depth of field: near cards hide things that only part of the lens can see, and
the floor has every depth. Camera axes: x right, y down, z forward, in metres; the lens lies in z =
0. All edges and patterns are mean values over a pixel.
"""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats, centred
from simulations.pictures.patterns import checker, stripes

type Place = Floats | float
"""A coordinate on the lens, one for all pixels or one (H, W) for each; metres from its centre."""

HORIZON = 0.3  # the horizon, as a share of the picture's height from its top
FOCAL_WIDTHS = 75 / 80  # distance from lens to sensor, in widths of the picture
FLOOR_Y, WALL_Z = 0.8, 8.0
TILE, BAR_PERIOD, BAR = 0.5, 1.2, 0.6
"""Widths of the floor's tiles, and period and width of the wall's vertical bars; metres."""
TINT = (1.0, 0.95, 0.85)  # linear RGB of the light parts of floor and wall
DARK_TILE, LIGHT_TILE, DARK_BAR, LIGHT_BAR = 0.15, 0.75, 0.3, 0.8
FOCUS_Z = 3.0
STRIPE_SLOPE = 0.4  # slope of a card's stripes: units to the left per unit down
SUBROWS = 3  # rows per pixel on the floor, whose depth varies too much within a pixel


@dataclass(frozen=True, slots=True)
class Card:
    """A round card that faces the camera."""

    x: float
    y: float
    z: float
    """Depth along the optical axis."""
    radius: float
    colour: tuple[float, float, float]
    """Linear RGB; half as bright between the stripes."""


CARDS = (
    Card(0.9, -0.05, 5.0, 0.62, (0.20, 0.45, 0.85)),
    Card(0.05, 0.10, 3.0, 0.42, (0.90, 0.70, 0.15)),
    Card(-0.32, 0.12, 1.6, 0.26, (0.85, 0.15, 0.12)),
)
"""Farthest first: behind the focus, in focus, in front of it."""


@dataclass(frozen=True, slots=True)
class Pixels:
    """A sensor of square pixels, four wide for three high."""

    x: Floats
    """(1, W) directions of the pixels at z = 1."""
    y: Floats
    """(H, 1)."""
    focal_px: float
    """Distance from lens to sensor, in pixels."""

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.y.shape[0], self.x.shape[1]


def pixels(width: int, dtype: type[np.floating]) -> Pixels:
    """The pixels of ``width`` columns; ``dtype`` is that of the directions and of the
    computation."""
    height, focal_px = width * 3 // 4, FOCAL_WIDTHS * width
    x = centred(width) / focal_px
    y = (np.arange(height) - HORIZON * height) / focal_px
    return Pixels(x[None, :].astype(dtype), y[:, None].astype(dtype), focal_px)


def radiance(pixels: Pixels, lens_x: Place, lens_y: Place) -> Floats:
    """Light (3, H, W) that reaches the pixels through the point (lens_x, lens_y) of the lens.

    The lens bends every ray of a pixel through the same point at `FOCUS_Z`.
    """
    picture, _ = background(pixels, lens_x, lens_y)
    for card in CARDS:
        colour, cover = card_light(card, pixels, lens_x, lens_y)
        picture += (colour - picture) * cover
    return picture


def background(pixels: Pixels, lens_x: Place = 0.0, lens_y: Place = 0.0) -> tuple[Floats, Floats]:
    """Floor and wall: light (3, H, W) and depth (H, W)."""
    wall_x, wall_y = _at_depth(pixels.x, pixels.y, lens_x, lens_y, WALL_Z)
    pixel = pixels.x.dtype.type(WALL_Z / pixels.focal_px)
    bars = stripes(wall_x, BAR_PERIOD, BAR, pixel) + 0 * wall_y
    floor = np.clip(0.5 + (wall_y - FLOOR_Y) / pixel, 0.0, 1.0)
    on_floor = DARK_TILE + (LIGHT_TILE - DARK_TILE) * _tiles(pixels, lens_x, lens_y)
    on_wall = DARK_BAR + (LIGHT_BAR - DARK_BAR) * bars
    shade = floor * on_floor + (1.0 - floor) * on_wall
    picture = np.stack([part * shade for part in TINT])
    return picture, _floor_depth(pixels.y, lens_y) + 0 * shade


def _tiles(pixels: Pixels, lens_x: Place, lens_y: Place) -> Floats:
    """Share (H, W) of light tiles in each pixel of the floor, continued behind the wall."""
    step = 1.0 / (SUBROWS * pixels.focal_px)
    middle = (SUBROWS - 1) / 2
    total = np.zeros((), pixels.x.dtype)
    for index in range(SUBROWS):
        y = pixels.y + pixels.y.dtype.type((index - middle) * step)
        depth = _floor_depth(y, lens_y)
        x, _ = _at_depth(pixels.x, y, lens_x, lens_y, depth)
        rising = (FLOOR_Y - lens_y) / depth  # of the rays, down per forward
        total = total + checker(x, depth, TILE, depth / pixels.focal_px, depth * step / rising)
    return total / SUBROWS


def _floor_depth(y: Floats, lens_y: Place) -> Floats:
    """Depth where the rays meet the floor, or the wall's if that is nearer."""
    falling = np.maximum(y - lens_y / FOCUS_Z, FLOOR_Y / 50.0)
    return np.clip((FLOOR_Y - lens_y) / falling, 0.1, WALL_Z)


def card_light(
    card: Card, pixels: Pixels, lens_x: Place = 0.0, lens_y: Place = 0.0
) -> tuple[Floats, Floats]:
    """Light of the card's plane (3, H, W), and how much of each pixel the card covers (H, W)."""
    at_x, at_y = _at_depth(pixels.x, pixels.y, lens_x, lens_y, card.z)
    pixel = pixels.x.dtype.type(card.z / pixels.focal_px)
    from_centre = np.sqrt((at_x - card.x) ** 2 + (at_y - card.y) ** 2)
    cover = np.clip(0.5 + (card.radius - from_centre) / pixel, 0.0, 1.0)
    along = at_x + STRIPE_SLOPE * at_y
    shade = 0.5 + 0.5 * stripes(along, card.radius / 2, card.radius / 4, pixel)
    return np.stack([shade * part for part in card.colour]), cover


def _at_depth(
    x: Floats, y: Floats, lens_x: Place, lens_y: Place, z: Floats | float
) -> tuple[Floats, Floats]:
    """Points of the pixels' rays at the depth ``z``; all rays of a pixel meet at the depth in
    focus."""
    off = 1.0 - z / FOCUS_Z
    return x * z + lens_x * off, y * z + lens_y * off
