"""Test pictures for demosaicing: three pictures with more or less correlated colours."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from simulations.models.arrays import Floats
from simulations.pictures.balloon import HEIGHT, WIDTH, Window, balloon
from simulations.pictures.checker_room import checker_room

ROOM_FOCAL_PX = 170.0
PERIOD_PX = 12.0
WAYS_RAD = (0.2, 1.3, 2.2)  # direction in which the wave of red, green and blue runs
LAGS_RAD = (0.0, 2.1, 4.2)


@dataclass(frozen=True, slots=True)
class Subject:
    """A test picture."""

    label: str
    words: str
    """Description of the picture, for a sentence."""
    draw: Callable[[Window], Floats]
    """A part of the picture, (h, w, 3) linear RGB in [0, 1], float32."""


def _room(window: Window) -> Floats:
    return _cropped(checker_room(WIDTH, HEIGHT, ROOM_FOCAL_PX), window)


def _soft(window: Window) -> Floats:
    """Smooth waves in another direction for each colour, so that the colours are uncorrelated."""
    x, y = np.meshgrid(np.arange(WIDTH, dtype=float), np.arange(HEIGHT, dtype=float))
    waves = [
        0.5
        + 0.35
        * np.cos(2 * np.pi * (x * np.cos(direction) + y * np.sin(direction)) / PERIOD_PX + lag)
        for direction, lag in zip(WAYS_RAD, LAGS_RAD, strict=True)
    ]
    return _cropped(np.stack(waves, axis=-1).astype(np.float32), window)


def _cropped(picture: Floats, window: Window) -> Floats:
    rows = slice(window.top, window.top + window.height)
    return picture[rows, window.left : window.left + window.width]


SUBJECTS: Mapping[str, Subject] = MappingProxyType(
    {
        "balloon": Subject("Balloon", "a striped balloon over rows of tulips", balloon),
        "room": Subject("Room", "a room with a chequered floor and a window", _room),
        "soft": Subject("Soft colours", "soft waves that run another way in each colour", _soft),
    }
)
"""The pictures by name: strong colours and very fine detail; edges common to all colours; nothing
in common."""
