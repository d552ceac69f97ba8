"""Three analytic pictures under a round window: waves, rings and discs.

Each fades to a flat grey within its square, so that a rotation about the centre loses nothing and
meets no edge. Coordinates are in pixels from the centre, x to the right and y down; values are in
[0, 1], surrounded by a flat 0.5.
"""

import numpy as np

from simulations.models.arrays import Floats, centred

SIZE = 128  # pixels along a side
RADIUS_PX, FADE_PX = 52.0, 16.0  # radius of the window, and width over which it fades
FREQUENCIES = np.array([0.02, 0.03, 0.05, 0.08, 0.11, 0.15, 0.21, 0.24, 0.27, 0.30, 0.33, 0.35])
"""Frequencies of the waves in cycles per pixel."""
GOLDEN_RAD = np.pi * (3 - np.sqrt(5))
"""Angle between successive waves or discs, which spreads them evenly over all directions."""
RINGS_AT_PX = (-20.0, 8.0)
"""Centre of the rings: not the window's centre, as a rotation would not change them there."""
FINEST = 0.35  # frequency of the rings at the far side of the window, in cycles per pixel
DISCS = 90
SOFT_PX = 0.6  # scale of a disc's edge, which is about two pixels wide, enough for sampling
TURNS, TURN_RAD = 12, np.deg2rad(33.0)
"""Turns that resampling is judged by, and their angle: see `simulations.ladders.resampling`."""


def waves(x: Floats, y: Floats) -> Floats:
    """(...) sum of twelve plane waves in different directions."""
    total = np.zeros_like(x)
    for n, frequency in enumerate(FREQUENCIES):
        along = x * np.cos(n * GOLDEN_RAD) + y * np.sin(n * GOLDEN_RAD)
        total += np.cos(2 * np.pi * frequency * along + n)
    return 0.5 + _window(x, y) * total * (0.65 / len(FREQUENCIES))


def rings(x: Floats, y: Floats) -> Floats:
    """(...) zone plate: the rings get finer outwards, to 0.35 cycles per pixel."""
    right, down = RINGS_AT_PX
    square = (x - right) ** 2 + (y - down) ** 2
    farthest = RADIUS_PX + np.hypot(right, down)
    return 0.5 + 0.45 * _window(x, y) * np.cos(np.pi * FINEST / farthest * square)


def discs(x: Floats, y: Floats) -> Floats:
    """(...) overlapping discs with soft edges, like objects in a photograph."""
    picture = np.zeros_like(x)
    for n in range(DISCS):
        # In mixed order: 37 and 90 have no common divisor.
        at = RADIUS_PX * np.sqrt(((37 * n) % DISCS + 0.5) / DISCS)
        radius, grey = 3.0 + (5 * n) % 9, 0.4 * np.cos(2.4 * n)
        far = np.hypot(x - at * np.cos(n * GOLDEN_RAD), y - at * np.sin(n * GOLDEN_RAD))
        cover = 0.5 - 0.5 * np.tanh((far - radius) / (2 * SOFT_PX))
        picture += cover * (grey - picture)
    return 0.5 + _window(x, y) * picture


PICTURES = (waves, rings, discs)


def places(angle_rad: float = 0.0) -> tuple[Floats, Floats]:
    """(128, 128) each: the source places (x, y) of the pixels of a turned picture."""
    x, y = np.meshgrid(centred(SIZE), centred(SIZE))
    cos, sin = np.cos(angle_rad), np.sin(angle_rad)
    return cos * x - sin * y, sin * x + cos * y


def pictures_at(x: Floats, y: Floats) -> Floats:
    """(..., 3) all three pictures."""
    return np.stack([picture(x, y) for picture in PICTURES], axis=-1)


INSIDE = np.hypot(*places()) < RADIUS_PX
"""(128, 128) the pixels within the window."""


def _window(x: Floats, y: Floats) -> Floats:
    """1 in the middle, then half a cosine down to 0: smooth, so it adds no fine detail."""
    beyond = np.clip((np.hypot(x, y) - (RADIUS_PX - FADE_PX)) / FADE_PX, 0.0, 1.0)
    return 0.5 + 0.5 * np.cos(np.pi * beyond)
