"""One hash of a value: equal values have equal ones, whatever process made them."""

import functools
import hashlib
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import fields, is_dataclass
from enum import Enum
from pathlib import Path

import numpy as np

SIZE = 20
type Special = Callable[[object], bytes | None]
"""The fingerprint of a value that has one of its own; None for all others."""


def fingerprint(value: object, special: Special = lambda _value: None) -> bytes:
    """The hash of ``value``: plain data, arrays, and dataclasses of them. A mapping is its items
    in their order.

    Raises `TypeError` for anything else: what it depends on could not be told.
    """
    digest = hashlib.blake2b(digest_size=SIZE)
    for piece in _pieces(value, special):
        digest.update(len(piece).to_bytes(4, "little"))
        digest.update(piece)
    return digest.digest()


def _pieces(value: object, special: Special) -> Iterator[bytes]:
    match value:
        case str():
            yield b"s" + value.encode("utf-8", "surrogatepass")
        case None | bool() | int() | float() | complex():
            yield f"{type(value).__name__}{value!r}".encode()
        case bytes():
            yield b"b" + value
        case Path():
            yield b"p" + str(value).encode()
        case functools.partial():
            yield from _pieces((value.func, value.args, value.keywords), special)
        case Enum():
            yield f"{type(value).__qualname__}.{value.name}".encode()
        case np.generic() | np.ndarray():
            yield f"{value.dtype.str}{value.shape}".encode()
            yield value.tobytes()
        case _ if (own := special(value)) is not None:
            yield b"x" + own
        case _ if is_dataclass(value) and not isinstance(value, type):
            yield f"d{type(value).__module__}.{type(value).__qualname__}".encode()
            for field in fields(value):
                yield from _pieces(getattr(value, field.name), special)
        case Mapping():
            yield f"m{len(value)}".encode()
            for key, item in value.items():
                yield from _pieces(key, special)
                yield from _pieces(item, special)
        case Set():
            yield f"f{len(value)}".encode()
            yield from sorted(fingerprint(item, special) for item in value)
        case Sequence():
            yield f"l{len(value)}".encode()
            for item in value:
                yield from _pieces(item, special)
        case _:
            raise TypeError(f"{type(value).__qualname__} has no fingerprint; legal: plain data")
