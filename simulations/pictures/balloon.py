"""A balloon over rows of tulips, a test picture for demosaicing.

It has a smooth sky, sharp coloured edges, and detail that becomes too fine for any method: gores
that narrow towards the balloon's rim, and rows that narrow towards the horizon.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb

WIDTH, HEIGHT = 240, 192
SAMPLES = 3  # samples per pixel along each side, averaged in linear light

HORIZON = 128.0  # row where the field ends; all lengths here are in pixels of the picture
BALLOON, BALLOON_RADIUS = (150.0, 60.0), 46.0

GORES = ("#e3262e", "#f7b51d", "#fff4dc", "#1f6fc4", "#1d9a6c", "#fff4dc")
ROWS = ("#d81e3a", "#2f7d32", "#f4c20d", "#2f7d32", "#e8578f", "#2f7d32", "#f2efe6", "#2f7d32")


@dataclass(frozen=True, slots=True)
class Window:
    """A part of the picture, in whole pixels."""

    top: int
    left: int
    height: int
    width: int


WHOLE = Window(0, 0, HEIGHT, WIDTH)


@cache  # two figures show it, and drawing it takes most of their time
def balloon(window: Window = WHOLE) -> NDArray[np.float32]:
    """The picture (192, 240, 3) or a part of it, linear RGB in [0, 1]. Read-only.

    The same on every machine. Raises `ValueError` for a window that is empty or extends outside.
    """
    bottom, right = window.top + window.height, window.left + window.width
    if not (0 <= window.top < bottom <= HEIGHT and 0 <= window.left < right <= WIDTH):
        raise ValueError(f"{window}; legal: not empty, within {HEIGHT} x {WIDTH} pixels")
    y = (np.arange(window.top * SAMPLES, bottom * SAMPLES, dtype=np.float64) + 0.5) / SAMPLES
    x = (np.arange(window.left * SAMPLES, right * SAMPLES, dtype=np.float64) + 0.5) / SAMPLES
    picture = np.empty((len(y), len(x), 3))
    for paint, (top, low, first, last) in LAYERS:
        rows, columns = slice(*y.searchsorted((top, low))), slice(*x.searchsorted((first, last)))
        paint(picture[rows, columns], *np.meshgrid(x[columns], y[rows]))
    # Rows first: a mean over both axes at once takes three times as long.
    lines = picture.reshape(window.height, SAMPLES, -1).mean(axis=1)
    pixels = lines.reshape(window.height, window.width, SAMPLES, 3)
    mean: NDArray[np.float32] = pixels.mean(axis=2).astype(np.float32)
    mean.flags.writeable = False
    return mean


def _sky(picture: Floats, x: Floats, y: Floats) -> None:
    """A sky from deep blue to a warm haze, with the glow of a low sun at the left."""
    down = np.clip(y[..., :1] / HORIZON, 0, 1)[..., None]
    picture[:] = (1 - down) * _colour("#3f7fc9") + down * _colour("#ffe3b8")
    from_sun = (x - 42) ** 2 + (y - 96) ** 2
    glow = np.exp(-from_sun / 1100)[..., None]
    picture += glow * (_colour("#fff3cf") - picture)
    picture[from_sun < 13**2] = _colour("#fffbe9")


def _hills(picture: Floats, x: Floats, y: Floats) -> None:
    """The far hills, up to the horizon."""
    ridge = 116 - 7 * np.sin(x[:1] / 31 + 0.6) - 3 * np.sin(x[:1] / 11)
    picture[ridge < y] = _colour("#5b7f95")


def _tulips(picture: Floats, x: Floats, y: Floats) -> None:
    """Rows that meet at the horizon and blend into one another where they get too narrow."""
    depth = 3 / np.maximum(y - HORIZON + 1.2, 1e-6)
    row = (x - 96) * depth + 400
    colours = _colours(ROWS)[np.floor(row).astype(np.int64) % len(ROWS)]
    rows_per_pixel = depth * np.maximum(1, np.abs(x - 96) * depth / 3)
    clear = np.clip((0.5 - rows_per_pixel) / 0.3, 0, 1)[..., None]
    picture[:] = clear * colours + (1 - clear) * _colours(ROWS).mean(axis=0)


def _fence(picture: Floats, x: Floats, y: Floats) -> None:
    """White pickets two pixels apart: the limit for grey, too fine for a colour of the mosaic."""
    top = 121 + 1.5 * np.abs((x % 4) - 2)
    picture[(x < 104) & (x % 4 < 2) & (y > top) & (y < 134)] = _colour("#fbf7ec")
    picture[(x < 104) & (np.abs(y - 128) < 0.8)] = _colour("#fbf7ec")


def _balloon(picture: Floats, x: Floats, y: Floats) -> None:
    """A globe of coloured gores that tapers to its mouth, shaded from the left."""
    across, down = (x - BALLOON[0]) / BALLOON_RADIUS, (y - BALLOON[1]) / BALLOON_RADIUS
    half_width = np.where(
        down < 0.35,
        np.sqrt(np.maximum(1 - down**2, 0)),
        np.sqrt(1 - 0.35**2) - 0.95 * (down - 0.35),
    )
    inside = (np.abs(across) < half_width) & (np.abs(down) < 1) | (
        (np.abs(across) < half_width) & (down > 0) & (down < 1.16)
    )
    turn = np.arcsin(np.clip(across[inside] / half_width[inside], -1, 1))
    gore = np.floor(turn / np.pi * 22 + 40).astype(np.int64)
    cloth = _colours(GORES)[gore % len(GORES)]
    band = (np.abs(down[inside] - 0.1) < 0.13) & (gore % 2 == 0)
    cloth[band] = _colour("#6b2c91")
    light = 0.42 + 0.58 * np.clip(0.8 * np.cos(turn + 0.55) - 0.25 * down[inside] + 0.1, 0, 1)
    picture[inside] = cloth * light[:, None]


def _basket(picture: Floats, x: Floats, y: Floats) -> None:
    """Ropes a pixel wide and a woven basket."""
    mouth, rim = BALLOON[1] + 1.12 * BALLOON_RADIUS, 123.0
    between = (y > mouth) & (y < rim)
    for foot in (-6.0, -2.0, 2.0, 6.0):
        slant = BALLOON[0] + foot * (1.5 - 0.5 * (y - mouth) / (rim - mouth))
        picture[between & (np.abs(x - slant) < 0.45)] = _colour("#3a2a1c")
    box = (np.abs(x - BALLOON[0]) < 7) & (y > rim) & (y < rim + 10)
    weave = (np.floor(x / 2) + np.floor(y / 2)) % 2 == 0
    picture[box] = _colour("#8a5a2b")
    picture[box & weave] = _colour("#c98f4e")


def _colour(srgb: str) -> Floats:
    """``#rrggbb`` as linear RGB (3,)."""
    return decode_srgb([int(srgb[place : place + 2], 16) / 255 for place in (1, 3, 5)])


def _colours(srgb: tuple[str, ...]) -> Floats:
    return np.array([_colour(one) for one in srgb])


type Paint = Callable[[Floats, Floats, Floats], None]
"""A function that paints samples (h, w, 3) in place, given their x and y (h, w)."""

LAYERS: tuple[tuple[Paint, tuple[float, float, float, float]], ...] = (
    (_sky, (0, HORIZON, 0, WIDTH)),
    (_hills, (105, HORIZON, 0, WIDTH)),
    (_tulips, (HORIZON, HEIGHT, 0, WIDTH)),
    (_fence, (121, 134, 0, 104)),
    (_balloon, (14, 114, 104, 196)),
    (_basket, (111, 133, 135, 165)),
)
"""The painters from back to front, each with its part: top, bottom, left, right."""
