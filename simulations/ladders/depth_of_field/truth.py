"""The reference of the ladders of depth of field: the cards by rays through the whole lens.

It shares the scene with the tiers, but no code that draws it. A ray hits a card, the floor or the
wall at one point, which is light or dark. Means over a pixel and over the lens are those of many
rays, each through a different place in both.
"""

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.pictures.cards import (
    BAR,
    BAR_PERIOD,
    CARDS,
    DARK_BAR,
    DARK_TILE,
    FLOOR_Y,
    FOCUS_Z,
    LIGHT_BAR,
    LIGHT_TILE,
    STRIPE_SLOPE,
    TILE,
    TINT,
    WALL_Z,
    Card,
    pixels,
)

type Ray = tuple[Floats, Floats, Floats, Floats]
"""Coordinates of rays on the lens, and their slopes right and down per metre forward."""


def picture(width: int, lens_radius: float, rays: int) -> Floats:
    """Mean light (3, H, W) over each pixel and over the lens."""
    seen = pixels(width, np.float64)
    shades = np.zeros((1 + len(CARDS), *seen.shape))
    for right, down, square, turn in spread_evenly(rays).tolist():
        radius, angle = lens_radius * np.sqrt(square), 2 * np.pi * turn
        x = seen.x + (right - 0.5) / seen.focal_px
        y = seen.y + (down - 0.5) / seen.focal_px
        _add_shades(shades, x, y, radius * np.cos(angle), radius * np.sin(angle))
    colours = np.array([TINT, *(card.colour for card in CARDS)])
    return np.einsum("sc,shw->chw", colours, shades / rays)


def spread_evenly(count: int) -> Floats:
    """(count, 4) evenly spread places in the four-dimensional unit cube.

    Multiples of powers of 1/g, without their whole part, where g⁵ = g + 1: M. Roberts, *The
    unreasonable effectiveness of quasirandom sequences*, 2018.
    """
    g = 1.1673039782614187
    return (0.5 + np.arange(1, count + 1)[:, None] * g ** -np.arange(1.0, 5.0)) % 1.0


def _add_shades(shades: Floats, x: Floats, y: Floats, lens_x: float, lens_y: float) -> None:
    """Add the brightness of the hit points to the plane of the room or of a card (1 + cards, H, W).

    The rays leave the lens at one point, towards the points x (1, W) and y (H, 1) of the plane in
    focus.
    """
    ray = (np.array(lens_x), np.array(lens_y), x - lens_x / FOCUS_Z, y - lens_y / FOCUS_Z)
    free = np.ones(shades.shape[1:], bool)
    for card, shade in reversed([*zip(CARDS, shades[1:], strict=True)]):  # the nearest first
        around, hit, light = _card_light(card, ray)
        hit &= free[around]
        shade[around] += hit * light
        free[around] &= ~hit
    shades[0] += free * _room(ray)


def _place(ray: Ray, z: float) -> tuple[Floats, Floats]:
    return ray[0] + ray[2] * z, ray[1] + ray[3] * z


def _room(ray: Ray) -> Floats:
    """Brightness (H, W) of the floor where the ray meets it before the wall, else of the wall."""
    wall_x, wall_y = _place(ray, WALL_Z)
    wall = np.where(_striped(wall_x, BAR_PERIOD, BAR), LIGHT_BAR, DARK_BAR)
    room = np.repeat(wall, len(wall_y), axis=0)
    on_floor = slice(np.count_nonzero(wall_y <= FLOOR_Y), None)  # y grows from row to row
    z = (FLOOR_Y - ray[1]) / ray[3][on_floor]
    x = ray[0] + ray[2] * z
    # Counted from the middle of a light tile; tiles that are even or odd in both directions are
    # light.
    same = _is_odd(np.rint(x / TILE)) == _is_odd(np.rint(z / TILE))
    room[on_floor] = np.where(same, LIGHT_TILE, DARK_TILE)
    return room


def _is_odd(whole: Floats) -> Mask:
    return whole.astype(np.int64) & 1 > 0


def _card_light(card: Card, ray: Ray) -> tuple[tuple[slice, slice], Mask, Floats]:
    """The rows and columns around a card, which of their rays hit it, and its brightness."""
    x, y = _place(ray, card.z)
    across, down = _within(x - card.x, card.radius), _within(y - card.y, card.radius)
    x, y = x[:, across], y[down]
    hit = np.hypot(x - card.x, y - card.y) < card.radius
    light = _striped(x + STRIPE_SLOPE * y, card.radius / 2, card.radius / 4)
    return (down, across), hit, np.where(light, 1.0, 0.5)


def _within(along: Floats, radius: float) -> slice:
    """The range of increasing places that are less than a radius away from 0."""
    return slice(*np.searchsorted(along.ravel(), (-radius, radius)))


def _striped(along: Floats, period: float, width: float) -> Mask:
    """Whether a place is on a stripe; one is centred on 0."""
    return np.abs(along - period * np.rint(along / period)) < width / 2
