"""From float pictures to the bytes of a canvas."""

import struct
import zlib
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray


def to_rgba8(srgb: ArrayLike, alpha: ArrayLike | None = None) -> NDArray[np.uint8]:
    """sRGB-encoded picture in [0, 1] as canvas bytes.

    Parameters
    ----------
    srgb : (H, W) or (H, W, 3) floats
        Out-of-range values are clipped; NaN becomes 0, because a cast of NaN is undefined
        and differs between processors.
    alpha : (H, W) floats in [0, 1], optional
        Coverage; opaque when left out.

    Returns
    -------
    (H, W, 4) uint8, C-contiguous.
    """
    rgba = opaque(_to_uint8(np.asarray(srgb)))
    if alpha is not None:
        rgba[..., 3] = _to_uint8(np.asarray(alpha))
    return rgba


def opaque(codes: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """(H, W, 4) canvas bytes of (H, W, 3) codes, or of grey ones (H, W) or (H, W, 1)."""
    colours = codes[..., None] if codes.ndim == 2 else codes
    return of_planes(np.moveaxis(np.broadcast_to(colours, (*colours.shape[:2], 3)), -1, 0))


def of_planes(planes: Sequence[NDArray[np.uint8]] | NDArray[np.uint8]) -> NDArray[np.uint8]:
    """(H, W, 4) canvas bytes of three planes (H, W) of codes."""
    rgba = np.full((*planes[0].shape, 4), 255, np.uint8)
    for channel, plane in enumerate(planes):  # faster than all channels in one assignment
        rgba[..., channel] = plane
    return rgba


def _to_uint8(picture: NDArray[np.floating]) -> NDArray[np.uint8]:
    clipped = np.asarray(np.fmax(picture, 0.0))  # unlike maximum, ignores NaN
    np.minimum(clipped, 1.0, out=clipped)
    codes = clipped * 255.0
    return np.rint(codes, out=codes).astype(np.uint8)


def png(raster: NDArray[np.uint8]) -> bytes:
    """Canvas bytes (H, W, 4) as a PNG, packed quickly rather than tightly."""
    height, width = raster.shape[:2]
    rows = np.insert(raster.reshape(height, -1), 0, 0, axis=1)  # 0 is each row's filter: none
    parts = (
        b"IHDR" + struct.pack(">2I5B", width, height, 8, 6, 0, 0, 0),
        b"IDAT" + zlib.compress(rows.tobytes(), 1),
        b"IEND",
    )
    packed = (
        struct.pack(">I", len(part) - 4) + part + struct.pack(">I", zlib.crc32(part))
        for part in parts
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(packed)
