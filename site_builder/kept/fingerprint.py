"""One hash of a value: equal values have equal ones, whatever process made them.

A frozen dataclass counts as the hash of its own, so that the hash of one that was seen before can
be had from `Prints`: most of what a build asks with is what the build before has made.
"""

import functools
import hashlib
from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, field, fields, is_dataclass
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np

SIZE = 20
type Special = Callable[[object], bytes | None]
"""The fingerprint of a value that has one of its own; None for all others."""


@dataclass(slots=True)
class Prints:
    """The hashes of frozen values, by identity; each value is held, so that no other can take its
    place in memory."""

    _known: dict[int, tuple[object, bytes]] = field(default_factory=dict)
    _before: dict[int, tuple[object, bytes]] = field(default_factory=dict)
    """Those of the round before."""

    def get(self, value: object) -> bytes | None:
        known = self._known.get(id(value))
        if known is None:
            known = self._before.get(id(value))
            if known is None:
                return None
            self._known[id(value)] = known
        return known[1]

    def put(self, value: object, found: bytes) -> None:
        self._known[id(value)] = value, found

    def next_round(self) -> None:
        """Let go of what was not asked for in this round."""
        self._before, self._known = self._known, {}


def fingerprint(
    value: object, special: Special = lambda _value: None, prints: Prints | None = None
) -> bytes:
    """The hash of ``value``: plain data, arrays, and dataclasses of them. A mapping is its items
    in their order. ``prints`` has what was found before, and gets what is found now.

    Raises `TypeError` for anything else: what it depends on could not be told.
    """
    prints = Prints() if prints is None else prints
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
            case _ if (known := prints.get(value)) is not None:
                put(b"h", known)
            case _ if (own := special(value)) is not None:
                put(b"x", own)
            case _ if is_dataclass(value) and not isinstance(value, type):
                shape = _shape(type(value))
                parts = (shape.name, *(getattr(value, name) for name in shape.names))
                if shape.frozen:
                    found = fingerprint(parts, special, prints)
                    prints.put(value, found)
                    put(b"h", found)
                else:
                    add_all(b"d", parts)
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


@dataclass(frozen=True, slots=True)
class _Shape:
    """Of a dataclass."""

    name: str
    names: tuple[str, ...]
    """Of its fields."""
    frozen: bool


@functools.cache
def _shape(kind: Any) -> _Shape:
    names = tuple(each.name for each in fields(kind))
    frozen = kind.__dataclass_params__.frozen
    return _Shape(f"{kind.__module__}.{kind.__qualname__}", names, frozen)
