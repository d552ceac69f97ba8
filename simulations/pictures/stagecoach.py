"""The rear of a stagecoach in a desert, without the wheel. Lengths are in pixels of 480 × 360."""

import numpy as np

from simulations.models.arrays import Floats

HORIZON, GROUND = 214.0, 318.0  # rows of the horizon and of the road under the wheel
HIGH, HAZE = (0.16, 0.36, 0.72), (0.93, 0.72, 0.50)
SAND, NEAR, ROCK = (0.66, 0.42, 0.24), (0.42, 0.25, 0.13), (0.40, 0.17, 0.10)
RED, GOLD, LEATHER, GLASS = (
    (0.28, 0.02, 0.015),
    (0.80, 0.50, 0.10),
    (0.05, 0.025, 0.015),
    (0.02, 0.02, 0.025),
)
BUSH = (0.10, 0.13, 0.05)
MESAS = ((20, 62, 44), (118, 30, 70), (330, 150, 46))  # middle, half width, height
BUSHES = ((30, 236, 9), (75, 262, 15), (14, 300, 24), (432, 232, 8), (452, 290, 22), (395, 246, 10))


def stagecoach(width: int, height: int) -> Floats:
    """(height, width, 3) linear RGB, float32."""
    x, y = np.arange(width) + 0.5, (np.arange(height) + 0.5)[:, None]
    light = np.empty((height, width, 3))
    up = np.clip(y / HORIZON, 0.0, 1.0)[..., None]
    light[:] = np.array(HIGH) + up**1.5 * (np.array(HAZE) - np.array(HIGH))
    for middle, half, high in MESAS:
        slope = half + 0.35 * (y - HORIZON + high)
        paint(light, np.maximum(np.abs(x - middle) - slope, HORIZON - high - y), ROCK)
    down = np.clip((y - HORIZON) / (height - HORIZON), 0.0, 1.0)[..., None]
    ground = np.array(SAND) + down * (np.array(NEAR) - np.array(SAND))
    light += coverage(HORIZON - y + 0.0 * x)[..., None] * (ground - light)
    for across, foot, size in BUSHES:
        rows, columns = (
            slice(foot - 2 * size, foot + 2),
            slice(max(across - 2 * size, 0), across + 2 * size),
        )
        right, below = x[columns] - across, y[rows] - foot
        radius = np.hypot(right / 1.3, below)
        ripple = 0.18 * np.sin(9.0 * np.arctan2(below, right))
        paint(light[rows, columns], np.maximum(radius - size * (1.0 + ripple), below), BUSH)
    shadow = np.maximum(np.maximum(196.0 - 0.5 * (y - HORIZON) - x, 222.0 - y), y - GROUND - 10.0)
    paint(light, shadow, LEATHER, 0.8)
    paint(light, np.maximum(np.abs(y - 182.0) - 4.0, 150.0 - x), LEATHER)
    paint(light, np.maximum(np.abs(x - 182.0) - 5.0, np.abs(y - 150.0) - 32.0), LEATHER)
    body(light, x, y)
    return light.astype(np.float32)


def body(light: Floats, x: Floats, y: Floats) -> None:
    """The curved box, with a window, panels and gilt mouldings."""
    across = (x - 330.0) / 215.0
    belly = 168.0 - 70.0 * np.abs(across) ** 2.6
    back = 330.0 - 205.0 + 0.0012 * (y - 60.0) ** 2
    shape = np.maximum(y - belly, back - x)
    paint(light, shape, GOLD)
    shine = 1.0 + 1.6 * np.exp(-(((y - 46.0 - 12.0 * across) / 26.0) ** 2))
    paint(light, shape + 4.0, RED, shade=shine)
    for left, right, top, low, colour in (
        (214, 292, -20, 62, GLASS),
        (318, 500, -20, 62, GLASS),
        (160, 196, -20, 62, LEATHER),
    ):
        pane = np.maximum(np.maximum(left - x, x - right), np.maximum(top - y, y - low))
        paint(light, pane - 3.0, GOLD)
        paint(light, pane, colour)
    paint(light, np.maximum(np.abs(y - 84.0 + 6.0 * across**2) - 1.2, back + 10.0 - x), GOLD)


def paint(
    light: Floats,
    outside: Floats,
    colour: tuple[float, float, float],
    opacity: float = 1.0,
    shade: Floats | float = 1.0,
) -> None:
    """Lay a colour over the picture, in place, where the distance from a border is negative."""
    inside = outside < 0.5
    cover = opacity * coverage(outside[inside])[:, None]
    tone = np.array(colour) * np.broadcast_to(shade, inside.shape)[inside][:, None]
    light[inside] += cover * (tone - light[inside])


def coverage(outside: Floats) -> Floats:
    """Share of each pixel inside."""
    return np.clip(0.5 - outside, 0.0, 1.0)
