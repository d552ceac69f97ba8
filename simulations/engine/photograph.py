"""The reader's own pictures, shown in place of the book's; never sent anywhere."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

type Codes = NDArray[np.uint8]
type Facts = Mapping[str, float | str]


@dataclass(frozen=True, slots=True)
class Whole:
    """The size of a photograph that is not cut: its own, unless that has too many pixels."""

    most_megapixels: float = 24.0
    """Photographs of more pixels are scaled down to as many."""

    def __post_init__(self) -> None:
        if not 0.0 < self.most_megapixels <= 24.0:
            raise ValueError(f"{self.most_megapixels:g} megapixels; legal: above 0, at most 24")


@dataclass(frozen=True, slots=True)
class Photograph:
    """A picture that a reader chose."""

    number: int
    """Number of the reader's picture, by which stages compare it. The `Reading` of the same picture
    has the same number."""
    codes: Codes = field(compare=False, repr=False)
    """(H, W, 3) sRGB, upright."""
    name: str = field(default="", compare=False)
    """Name of the file."""
    facts: Facts = field(default_factory=dict, compare=False)
    """What is known of the file: ``full_width`` and ``full_height`` in px, upright, before it was
    scaled down; and from EXIF, where given, ``focal_mm``, ``focal_35mm_mm``, ``make``, ``model``,
    ``lens``, ``exposure_s``, ``f_number`` and ``iso``."""

    def __post_init__(self) -> None:
        codes = self.codes
        if codes.ndim != 3 or codes.shape[2] != 3 or codes.dtype != np.uint8 or not codes.size:
            raise ValueError(f"photograph {codes.shape} {codes.dtype}; legal: (H, W, 3) uint8")
