"""The reader's own pictures, shown in place of the book's; never sent anywhere."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Self

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
    """A picture from a canvas."""

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

    @classmethod
    def from_canvas(
        cls,
        number: int,
        rgba: bytes,
        width: int,
        height: int,
        name: str = "",
        facts: Facts | None = None,
    ) -> Self:
        """From the bytes of a canvas, row by row, composited on white.

        Raises `ValueError` unless there are four bytes for each pixel.
        """
        if not rgba or len(rgba) != 4 * width * height:
            raise ValueError(
                f"photograph of {width} × {height} px in {len(rgba)} bytes; legal: four a pixel"
            )
        pixels = np.frombuffer(rgba, np.uint8).reshape(height, width, 4)
        return cls(number, _over_white(pixels), name, facts or {})


def _over_white(pixels: Codes) -> Codes:
    """(H, W, 3) of (H, W, 4), in bands of rows, as whole photographs are large."""
    codes = np.empty((*pixels.shape[:2], 3), np.uint8)
    for first in range(0, len(pixels), 64):
        band = pixels[first : first + 64]
        codes[first : first + 64] = band[..., :3]
        if band[..., 3].min() < 255:
            alpha = band[..., 3:].astype(np.uint16)
            codes[first : first + 64] = (band[..., :3] * alpha + 255 * (255 - alpha) + 127) // 255
    return codes
