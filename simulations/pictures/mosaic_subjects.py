"""Test pictures for demosaicing: three pictures with more or less correlated colours."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from simulations.models.arrays import Floats
from simulations.pictures.balloon import HEIGHT, WIDTH, Window, balloon
from simulations.pictures.checker_room import checker_room
from simulations.pictures.soft_colours import soft_colours

ROOM_FOCAL_PX = 170.0


@dataclass(frozen=True, slots=True)
class Subject:
    """A test picture."""

    label: str
    words: str
    """Description of the picture, for a sentence."""
    draw: Callable[[Window], Floats]
    """A part of the picture, (h, w, 3) linear RGB in [0, 1], float32."""


def _room(window: Window) -> Floats:
    return _cut(checker_room(WIDTH, HEIGHT, ROOM_FOCAL_PX), window)


def _soft(window: Window) -> Floats:
    return _cut(soft_colours(WIDTH, HEIGHT), window)


def _cut(picture: Floats, window: Window) -> Floats:
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
