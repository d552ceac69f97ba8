"""Readings: the measurements that a figure keeps of the reader's photographs.

Instruments work on many photographs, of which only one at a time fits into the memory. So each is
read once, at full resolution, by the scene's `read`; what it returns is kept, and the stages take
all of it as the parameter ``readings``. No readings: the book's simulated photographs.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


class UnfitError(ValueError):
    """A photograph cannot be used.

    The message is one sentence for the reader: what is wrong and what to do. ``No chequerboard
    found; photograph the whole board, flat and evenly lit.``
    """


@dataclass(frozen=True, slots=True)
class Reading:
    """The measurements of one photograph."""

    number: int
    """Stages compare by it; the `Photograph` of the same picture has the same number."""
    name: str = field(default="", compare=False)
    """Name of the file."""
    data: Mapping[str, Any] = field(default_factory=dict, compare=False)
    """The result of `read`: JSON values only."""


type Readings = tuple[Reading, ...]
