"""The reader's own picture, in place of the book's: never kept, never sent anywhere."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Self

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

type Codes = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Photograph:
    """A picture as a canvas gives it."""

    number: int
    """Which of the reader's pictures it is: what stages compare it by."""
    codes: Codes = field(compare=False, repr=False)
    """(H, W, 3) sRGB."""

    @classmethod
    def from_canvas(cls, number: int, rgba: bytes, width: int, height: int) -> Self:
        """From the bytes of a canvas, row by row; what is transparent shows a white ground.

        Raises `ValueError` where there are not four bytes for each pixel.
        """
        if not rgba or len(rgba) != 4 * width * height:
            raise ValueError(
                f"photograph of {width} × {height} px in {len(rgba)} bytes; legal: four a pixel"
            )
        pixels = np.frombuffer(rgba, np.uint8).reshape(height, width, 4).astype(np.uint16)
        alpha = pixels[..., 3:]
        over_white = (pixels[..., :3] * alpha + 255 * (255 - alpha) + 127) // 255
        return cls(number, over_white.astype(np.uint8))
