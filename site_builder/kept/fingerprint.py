"""One hash of a value: equal values have equal ones, whatever process made them."""

import functools
import hashlib
from collections.abc import Callable, Mapping, Sequence, Set
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

    def put(kind: bytes, data: bytes) -> None:
        digest.update(kind + len(data).to_bytes(4, "little") + data)

    def add(value: object) -> None:
        match value:
            case str():
                put(
                    b"s" if type(value) is str else type(value).__name__.encode(),
                    value.encode("utf-8", "surrogatepass"),
                )
            case None | bool() | int() | float() | complex():
                put(b"v", f"{type(value).__name__}{value!r}".encode())
            case bytes():
                put(b"b", value)
            case tuple() | list():
                add_all(b"l", value)
            case dict():
                add_items(value)
            case Path():
                put(b"p", str(value).encode())
            case functools.partial():
                add_all(b"c", (value.func, value.args, value.keywords))
            case Enum():
                put(b"e", f"{type(value).__qualname__}.{value.name}".encode())
            case np.generic() | np.ndarray():
                put(b"a", f"{value.dtype.str}{value.shape}".encode())
                put(b"a", value.tobytes())
            case _ if (own := special(value)) is not None:
                put(b"x", own)
            case _ if is_dataclass(value) and not isinstance(value, type):
                name, names = _shape(type(value))
                put(b"d", name)
                for field in names:
                    add(getattr(value, field))
            case Mapping():
                add_items(value)
            case Set():
                add_all(b"f", sorted(fingerprint(item, special) for item in value))
            case Sequence():
                add_all(b"l", value)
            case _:
                raise TypeError(f"{type(value).__qualname__} has no fingerprint; legal: plain data")

    def add_all(kind: bytes, items: Sequence[object]) -> None:
        put(kind, str(len(items)).encode())
        for item in items:
            add(item)

    def add_items(items: Mapping[object, object]) -> None:
        put(b"m", str(len(items)).encode())
        for key, item in items.items():
            add(key)
            add(item)

    add(value)
    return digest.digest()


@functools.cache
def _shape(kind: type) -> tuple[bytes, tuple[str, ...]]:
    """Name and fields of a dataclass."""
    names = tuple(field.name for field in fields(kind))
    return f"{kind.__module__}.{kind.__qualname__}".encode(), names
