"""Files that a reader can save from a figure."""

import re
from collections.abc import Callable
from dataclasses import dataclass

from simulations.engine.stages import Outputs


@dataclass(frozen=True, slots=True)
class Export[S]:
    """A file of text to save; ``S`` is the dataclass of the scene's settings."""

    name: str
    """Name of the file without its suffix; unique in the scene."""
    label: str
    """Text of the button: ``OpenCV YAML``."""
    suffix: str
    """``.yaml``"""
    make: Callable[[S, Outputs], str]
    """The text of the file. May raise `simulations.engine.reading.UnfitError`."""

    def __post_init__(self) -> None:
        if not re.fullmatch(r"[\w-]+", self.name):
            raise ValueError(f"export {self.name!r}; legal: letters, digits and hyphens")
        if not re.fullmatch(r"(\.\w+)+", self.suffix):
            raise ValueError(f"export {self.name!r}: suffix {self.suffix!r}; legal: as in .json")
