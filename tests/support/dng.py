"""Raw files of a known sensor: uncompressed DNG (Adobe, *Digital Negative*, 1.4).

A DNG is a TIFF file (TIFF 6.0) with further tags.
"""

import struct
from collections.abc import Mapping, Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

BYTE, ASCII, SHORT, LONG, RATIONAL, SRATIONAL = 1, 2, 3, 4, 5, 10
FORMATS = {BYTE: "B", SHORT: "H", LONG: "I", RATIONAL: "II", SRATIONAL: "ii"}
TO_XYZ = (3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570)
"""The colour matrix of a sensor with the primaries of linear sRGB."""

type Entry = tuple[int, int, Sequence[float] | str]
"""Tag, type and values."""


def dng(
    mosaic: NDArray[np.unsignedinteger],
    *,
    black: Sequence[float] = (0.0,),
    exposure_s: float = 0.01,
    orientation: int = 1,
) -> bytes:
    """The file of a mosaic (H, W) of 16 bits per cell, with a red cell at first; ``black`` is one
    level, or one for each cell of a 2 × 2 quad; ``orientation`` as in EXIF."""
    height, width = mosaic.shape
    strip = mosaic.astype("<u2").tobytes()
    side = 1 if len(black) == 1 else 2
    exposure: list[Entry] = [
        (0x829A, RATIONAL, [exposure_s]),
        (0x829D, RATIONAL, [8.0]),
        (0x8827, SHORT, [100]),
        (0x920A, RATIONAL, [50.0]),
    ]
    main: list[Entry] = [
        (254, LONG, [0]),
        (256, LONG, [width]),
        (257, LONG, [height]),
        (258, SHORT, [16]),
        (259, SHORT, [1]),  # not compressed
        (262, SHORT, [32803]),  # cells of a mosaic
        (271, ASCII, "Example"),
        (272, ASCII, "Simulated sensor"),
        (274, SHORT, [orientation]),
        (277, SHORT, [1]),
        (278, LONG, [height]),
        (279, LONG, [len(strip)]),
        (284, SHORT, [1]),
        (33421, SHORT, [2, 2]),
        (33422, BYTE, [0, 1, 1, 2]),
        (50706, BYTE, [1, 4, 0, 0]),
        (50707, BYTE, [1, 1, 0, 0]),
        (50708, ASCII, "Example Simulated sensor"),
        (50713, SHORT, [side, side]),
        (50714, RATIONAL, black),
        (50717, LONG, [4095]),
        (50721, SRATIONAL, TO_XYZ),
        (50728, RATIONAL, [1.0, 1.0, 1.0]),
        (50778, SHORT, [21]),  # daylight of 6500 K
    ]
    first = 8
    within = _directory(exposure, first)
    at = first + len(within)
    pointers = {34665: first, 273: 0}
    length = len(_directory(_with(main, pointers), at))
    pointers[273] = at + length
    return b"II*\0" + struct.pack("<I", at) + within + _directory(_with(main, pointers), at) + strip


def _with(entries: list[Entry], pointers: Mapping[int, int]) -> list[Entry]:
    return sorted([*entries, *((tag, LONG, [place]) for tag, place in pointers.items())])


def _directory(entries: Sequence[Entry], at: int) -> bytes:
    """An image file directory at byte ``at``, followed by the values that do not fit into it."""
    head, behind = struct.pack("<H", len(entries)), b""
    place = at + 2 + 12 * len(entries) + 4
    for tag, kind, values in entries:
        data, count = _packed(kind, values)
        if len(data) > 4:
            where = struct.pack("<I", place + len(behind))
            behind += data + b"\0" * (len(data) % 2)
        else:
            where = data.ljust(4, b"\0")
        head += struct.pack("<HHI", tag, kind, count) + where
    return head + struct.pack("<I", 0) + behind


def _packed(kind: int, values: Sequence[float] | str) -> tuple[bytes, int]:
    """The bytes of the values, and the count field of the tag."""
    if isinstance(values, str):
        data = values.encode("ascii") + b"\0"
        return data, len(data)
    if kind in (RATIONAL, SRATIONAL):
        shares = [Fraction(value).limit_denominator(100_000) for value in values]
        parts = [part for share in shares for part in (share.numerator, share.denominator)]
        return struct.pack(f"<{len(parts)}{FORMATS[kind][0]}", *parts), len(values)
    return struct.pack(f"<{len(values)}{FORMATS[kind]}", *map(int, values)), len(values)
