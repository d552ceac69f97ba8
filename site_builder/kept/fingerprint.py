"""One hash of a value: equal values have equal ones, whatever process made them.

A frozen dataclass counts as the hash of its own, so that the hash of one that was seen before can
be had from `Prints`: most of what a build asks with is what the build before has made.
"""

import functools
import hashlib
from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, field, fields
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
    _add(value, digest.update, special, prints)
    return digest.digest()


type _Update = Callable[[bytes], None]


def _add(value: Any, update: _Update, special: Special, prints: Prints) -> None:
    """Quickly, where it is one of the few types that most values are of."""
    kind: type = type(value)
    if kind is str:
        try:
            data = value.encode()  # in half the time, and nearly always enough
        except UnicodeEncodeError:
            data = value.encode("utf-8", "surrogatepass")
        update(b"s" + len(data).to_bytes(4, "little") + data)
    elif kind is tuple or kind is list:
        _add_all(b"l", value, update, special, prints)
    elif value is None or kind is bool or kind is int or kind is float:
        _put(update, b"v", f"{kind.__name__}{value!r}".encode())
    elif kind is dict:
        _add_items(value, update, special, prints)
    elif (known := prints.get(value)) is not None:
        _put(update, b"h", known)
    elif (own := special(value)) is not None:
        _put(update, b"x", own)
    elif (shape := _shape(kind)) is None:
        _add_other(value, update, special, prints)
    elif shape.frozen:
        digest = hashlib.blake2b(shape.head, digest_size=SIZE)
        for name in shape.names:
            _add(getattr(value, name), digest.update, special, prints)
        found = digest.digest()
        prints.put(value, found)
        _put(update, b"h", found)
    else:
        _put(update, b"d", shape.head)
        for name in shape.names:
            _add(getattr(value, name), update, special, prints)


def _add_other(value: object, update: _Update, special: Special, prints: Prints) -> None:
    match value:
        case str():
            kind = type(value).__name__.encode()
            _put(update, kind, value.encode("utf-8", "surrogatepass"))
        case complex():
            _put(update, b"v", f"{type(value).__name__}{value!r}".encode())
        case bytes():
            _put(update, b"b", value)
        case Path():
            _put(update, b"p", str(value).encode())
        case functools.partial():
            parts = (value.func, value.args, value.keywords)
            _add_all(b"c", parts, update, special, prints)
        case Enum():
            _put(update, b"e", f"{type(value).__qualname__}.{value.name}".encode())
        case int() | float():
            _put(update, b"v", f"{type(value).__name__}{value!r}".encode())
        case Mapping():
            _add_items(value, update, special, prints)
        case Set():
            items = sorted(fingerprint(item, special, prints) for item in value)
            _add_all(b"f", items, update, special, prints)
        case Sequence():
            _add_all(b"l", value, update, special, prints)
        case np.generic() | np.ndarray():
            _put(update, b"a", f"{value.dtype.str}{value.shape}".encode())
            _put(update, b"a", value.tobytes())
        case _:
            raise TypeError(f"{type(value).__qualname__} has no fingerprint; legal: plain data")


def _add_all(
    kind: bytes, items: Sequence[object], update: _Update, special: Special, prints: Prints
) -> None:
    _put(update, kind, str(len(items)).encode())
    for item in items:
        _add(item, update, special, prints)


def _add_items(
    items: Mapping[Any, object], update: _Update, special: Special, prints: Prints
) -> None:
    _put(update, b"m", str(len(items)).encode())
    for key, item in items.items():
        _add(key, update, special, prints)
        _add(item, update, special, prints)


def _put(update: _Update, kind: bytes, data: bytes) -> None:
    update(kind + len(data).to_bytes(4, "little") + data)


@dataclass(frozen=True, slots=True)
class _Shape:
    """Of a dataclass."""

    head: bytes
    """Its name, and how many fields it has."""
    names: tuple[str, ...]
    """Of its fields."""
    frozen: bool


@functools.cache
def _shape(kind: Any) -> _Shape | None:
    """None of what is no dataclass."""
    if not hasattr(kind, "__dataclass_params__"):
        return None
    names = tuple(each.name for each in fields(kind))
    head = f"{kind.__module__}.{kind.__qualname__} {len(names)}".encode()
    return _Shape(head, names, kind.__dataclass_params__.frozen)
