"""Photographs packed into modules: bytes that numpy alone can read, in a browser too."""

import base64
import zlib

import numpy as np
from numpy.typing import NDArray

BITS = 7
"""Of each colour: the eighth would hold little but noise, and a fifth of the bytes."""


def unpack(packed: str, width: int, height: int) -> NDArray[np.uint8]:
    """(height, width, 3) sRGB. Read-only.

    ``packed`` holds base64 of deflated differences, modulo 256, of a colour from the one to its
    left and of these from the row above: of green, of red less green, and of blue less green.
    """
    steps = np.frombuffer(zlib.decompress(base64.b64decode(packed)), np.uint8)
    rows = steps.reshape(3, height, width).cumsum(axis=1, dtype=np.uint8)
    green, red, blue = rows.cumsum(axis=2, dtype=np.uint8)
    codes = np.stack((red + green, green, blue + green), axis=-1) << np.uint8(8 - BITS)
    codes.flags.writeable = False
    return codes
