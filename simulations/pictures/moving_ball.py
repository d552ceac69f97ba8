"""A striped ball that crosses a static, chequered wall while the shutter is open.

Values are those at pixel centres, so that only the motion smooths them. Time runs from 0 to 1, the
exposure; coordinates are pixels, x to the right and y down. Linear light.
"""

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.pictures.patterns import stripes

WIDTH, HEIGHT = 160, 96
RADIUS, CENTRE_Y = 30.7, 47.3
START_X, TRAVEL = 58.1, 37.3
"""Position of the ball's centre when the shutter opens, and its motion to the right."""
BAR = 8.0  # width of the ball's vertical stripes; one is centred on it
LIGHT_BAR, DARK_BAR = 0.9, 0.25
TILE, LIGHT_TILE, DARK_TILE = 12.0, 0.55, 0.1


def grid() -> tuple[Floats, Floats]:
    """Pixel centres: x (1, 160), y (96, 1)."""
    return np.arange(WIDTH, dtype=float)[None, :], np.arange(HEIGHT, dtype=float)[:, None]


def wall(x: Floats, y: Floats) -> Floats:
    """The chequers (H, W) behind the ball."""
    light = (np.floor(x / TILE) + np.floor(y / TILE)) % 2 == 0
    return np.where(light, LIGHT_TILE, DARK_TILE)


def instant(x: Floats, y: Floats, time: Floats | float, behind: Floats) -> Floats:
    """The picture (H, W) at one moment, or at a moment (H, W) for each pixel.

    ``behind`` is the `wall`, which is static and drawn only once.
    """
    along = x - START_X - TRAVEL * time
    light = np.floor(along / BAR + 0.5) % 2 == 0
    ball = np.where(light, LIGHT_BAR, DARK_BAR)
    return np.where(along**2 < RADIUS**2 - (y - CENTRE_Y) ** 2, ball, behind)


def on_ball(x: Floats, y: Floats, time: float) -> Mask:
    """Pixels (H, W) that show the ball at a moment."""
    return np.hypot(x - START_X - TRAVEL * time, y - CENTRE_Y) < RADIUS


def exposed(x: Floats, y: Floats) -> Floats:
    """Mean of `instant` over the exposure (H, W), in closed form.

    A pixel sees the ball from the arrival of its leading edge until the trailing edge leaves. The
    mean of the stripes that pass meanwhile has a closed form.
    """
    half_chord = np.sqrt(np.maximum(RADIUS**2 - (y - CENTRE_Y) ** 2, 0.0))
    offset = x - START_X
    arrives = np.clip((offset - half_chord) / TRAVEL, 0.0, 1.0)
    leaves = np.clip((offset + half_chord) / TRAVEL, 0.0, 1.0)
    share = leaves - arrives
    middle = offset - TRAVEL * (arrives + leaves) / 2
    light = stripes(middle, 2 * BAR, BAR, np.maximum(TRAVEL * share, 1e-6))
    ball = DARK_BAR + (LIGHT_BAR - DARK_BAR) * light
    return share * ball + (1.0 - share) * wall(x, y)
