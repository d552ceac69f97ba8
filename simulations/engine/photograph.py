"""The reader's own picture, shown in place of the book's; never stored or sent anywhere."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Self

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

type Codes = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Photograph:
    """A picture from a canvas."""

    number: int
    """Number of the reader's picture, by which stages compare it."""
    codes: Codes = field(compare=False, repr=False)
    """(H, W, 3) sRGB."""

    @classmethod
    def from_canvas(cls, number: int, rgba: bytes, width: int, height: int) -> Self:
        """From the bytes of a canvas, row by row, composited on white.

        Raises `ValueError` unless there are four bytes for each pixel.
        """
        if not rgba or len(rgba) != 4 * width * height:
            raise ValueError(
                f"photograph of {width} × {height} px in {len(rgba)} bytes; legal: four a pixel"
            )
        pixels = np.frombuffer(rgba, np.uint8).reshape(height, width, 4).astype(np.uint16)
        alpha = pixels[..., 3:]
        over_white = (pixels[..., :3] * alpha + 255 * (255 - alpha) + 127) // 255
        return cls(number, over_white.astype(np.uint8))
