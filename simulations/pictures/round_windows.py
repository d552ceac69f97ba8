"""Three pictures under a round window, known at every place: waves, rings and discs.

Each fades to a flat grey well inside its square, so that a turn about the middle loses nothing and
meets no edge. Places are in pixels from the middle, x to the right and y down; values lie in
[0, 1], and a flat 0.5 surrounds them.
"""

import numpy as np

from simulations.models.arrays import Floats

SIZE = 128
"""Pixels along a side that hold the window."""
RADIUS_PX, FADE_PX = 52.0, 16.0
"""The window ends here, and has begun to fade so much farther in."""
FREQUENCIES = np.array([0.02, 0.03, 0.05, 0.08, 0.11, 0.15, 0.21, 0.24, 0.27, 0.30, 0.33, 0.35])
"""Of the waves: cycles per pixel."""
GOLDEN_RAD = np.pi * (3 - np.sqrt(5))
"""Angle from one wave, or one disc, to the next: all directions are served evenly."""
RINGS_AT_PX = (-20.0, 8.0)
"""Middle of the rings: not that of the window, where a turn would not change them."""
FINEST = 0.35
"""Of the rings, at the far side of the window."""
DISCS = 90
SOFT_PX = 0.6
"""Scale of a disc's edge, which is about two pixels wide: pixels can hold it."""


def waves(x: Floats, y: Floats) -> Floats:
    """(...) of twelve plane waves, each in a direction of its own."""
    total = np.zeros_like(x)
    for n, frequency in enumerate(FREQUENCIES):
        along = x * np.cos(n * GOLDEN_RAD) + y * np.sin(n * GOLDEN_RAD)
        total += np.cos(2 * np.pi * frequency * along + n)
    return 0.5 + _window(x, y) * total * (0.65 / len(FREQUENCIES))


def rings(x: Floats, y: Floats) -> Floats:
    """(...) of a zone plate: the rings get finer outwards, to 0.35 cycles per pixel."""
    right, down = RINGS_AT_PX
    square = (x - right) ** 2 + (y - down) ** 2
    farthest = RADIUS_PX + np.hypot(right, down)
    return 0.5 + 0.45 * _window(x, y) * np.cos(np.pi * FINEST / farthest * square)


def discs(x: Floats, y: Floats) -> Floats:
    """(...) of discs with soft edges, laid one over another: things, as in a photograph."""
    picture = np.zeros_like(x)
    for n in range(DISCS):
        # In an order that mixes the places: 37 and 90 have no common divisor.
        at = RADIUS_PX * np.sqrt(((37 * n) % DISCS + 0.5) / DISCS)
        radius, grey = 3.0 + (5 * n) % 9, 0.4 * np.cos(2.4 * n)
        far = np.hypot(x - at * np.cos(n * GOLDEN_RAD), y - at * np.sin(n * GOLDEN_RAD))
        cover = 0.5 - 0.5 * np.tanh((far - radius) / (2 * SOFT_PX))
        picture += cover * (grey - picture)
    return 0.5 + _window(x, y) * picture


PICTURES = (waves, rings, discs)


def _window(x: Floats, y: Floats) -> Floats:
    """1 in the middle, then half a cosine down to 0: smooth, so it adds no fine detail."""
    beyond = np.clip((np.hypot(x, y) - (RADIUS_PX - FADE_PX)) / FADE_PX, 0.0, 1.0)
    return 0.5 + 0.5 * np.cos(np.pi * beyond)
