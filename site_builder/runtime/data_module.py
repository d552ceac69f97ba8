"""What a program changes in its memory, as a module of WebAssembly that writes it there."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

type Bytes = NDArray[np.uint8]

MAGIC = b"\x00asm\x01\x00\x00\x00"
MEMORY = ("python", "memory")
"""Names under which the module imports the memory."""
CUSTOM, IMPORTS, DATA = 0, 2, 11
"""Numbers of sections (WebAssembly Core Specification, 5.5)."""
GAP = 64
"""Unchanged bytes between changed ones that are written too, as a new run costs more."""


def changed_runs(
    memory: Bytes, base: Bytes, always: slice = slice(0), gap: int = GAP
) -> list[tuple[int, bytes]]:
    """Place and content of each run of bytes in which ``memory`` differs from the ``base``, which
    ends where it is zero, and of those at ``always``."""
    differs = memory != 0
    differs[: len(base)] = memory[: len(base)] != base
    differs[always] = True
    places = np.flatnonzero(differs)
    runs = np.split(places, np.flatnonzero(np.diff(places) > gap) + 1) if len(places) else []
    bounds = [(int(run[0]), int(run[-1]) + 1) for run in runs]
    return [(start, memory[start:end].tobytes()) for start, end in bounds]


def data_module(runs: Sequence[tuple[int, bytes]], sections: Mapping[str, bytes]) -> bytes:
    """A module that writes ``runs``, each at its place of the memory that it is given, and has
    ``sections`` of its own."""
    names = b"".join(_sized(name.encode()) for name in MEMORY)
    segments = b"".join(
        b"\x00\x41" + signed(place) + b"\x0b" + _sized(content) for place, content in runs
    )
    parts = [
        *((CUSTOM, _sized(name.encode()) + content) for name, content in sections.items()),
        (IMPORTS, unsigned(1) + names + b"\x02\x00" + unsigned(0)),
        (DATA, unsigned(len(runs)) + segments),
    ]
    return MAGIC + b"".join(bytes([number]) + _sized(content) for number, content in parts)


def unsigned(number: int) -> bytes:
    """Encode as LEB128."""
    digits = bytearray()
    while number > 0x7F:
        digits.append(number & 0x7F | 0x80)
        number >>= 7
    return bytes([*digits, number])


def signed(number: int) -> bytes:
    """Encode as signed LEB128."""
    digits = bytearray()
    while not -0x40 <= number < 0x40:
        digits.append(number & 0x7F | 0x80)
        number >>= 7
    return bytes([*digits, number & 0x7F])


def _sized(content: bytes) -> bytes:
    return unsigned(len(content)) + content
