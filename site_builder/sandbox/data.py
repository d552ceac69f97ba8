"""What leaves the sandbox: data, with names in the place of authors' functions and classes.

The builder never imports a module of the book's: a scene reaches it as a `Scene` whose settings
have all their controls and whose functions are names.
"""

import io
import pickle
from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields, is_dataclass, make_dataclass
from importlib import import_module
from typing import Any

from simulations.engine.controls import Control
from simulations.engine.controls.control import setting
from site_builder.cache.hashing import HOLDERS, hash_of, source_hash
from site_builder.files.engine import ENGINE_PARTS
from site_builder.files.text import CONTROL

OURS = {*ENGINE_PARTS} - {"models"}
"""Parts of ``simulations`` that the builder itself imports."""


class OwnClassError(TypeError):
    """A value of a class of the author's that cannot leave the sandbox."""


@dataclass(frozen=True, slots=True)
class Code:
    """A function or a class of the author's, by its name."""

    module: str
    name: str

    @property
    def cache_key(self) -> bytes:
        return hash_of("code", self.module, self.name, source_hash(self.module))


@dataclass(frozen=True, slots=True)
class Record:
    """An object of a dataclass of the author's."""

    kind: Code
    fields: tuple[tuple[str, Any], ...]


def is_authors(module: str) -> bool:
    """Whether a module, by its full name, may be of the book's own."""
    package, _, rest = module.partition(".")
    return package == "simulations" and rest.partition(".")[0] not in OURS


def real(value: Any) -> Any:
    """In the sandbox: the value with functions, classes and objects for their names."""
    match value:
        case Code():
            return getattr(import_module(value.module), value.name)
        case Record():
            kind = real(value.kind)
            made = object.__new__(kind)
            for name, held in value.fields:
                object.__setattr__(made, name, real(held))
            return made
        case tuple() | list():
            return type(value)(map(real, value))
    return value


def called(function: Code, *given: object, **named: object) -> Any:
    """In the sandbox: what the function returns."""
    return real(function)(*real(given), **{name: real(value) for name, value in named.items()})


def attribute(record: Record, name: str) -> Any:
    """In the sandbox: what the object holds under a name."""
    return getattr(real(record), name)


def packed(value: object) -> bytes:
    """The value as bytes that name no module of the author's. Raises `OwnClassError`."""
    buffer = io.BytesIO()
    _Packer(buffer, pickle.HIGHEST_PROTOCOL).dump(value)
    return buffer.getvalue()


def unpacked(data: bytes) -> Any:
    """The value of such bytes. Raises `OwnClassError` where others name an author's module."""
    return _Unpacker(io.BytesIO(data)).load()


class _Packer(pickle.Pickler):
    def reducer_override(self, value: Any) -> Any:
        kind = type(value)
        if is_dataclass(kind) and not is_authors(kind.__module__):
            _check_texts(value)
        if kind in HOLDERS:  # whose own reduction is its name
            return value.__reduce_ex__(pickle.HIGHEST_PROTOCOL)
        if isinstance(value, type):
            return _class(value) if is_authors(value.__module__) else NotImplemented
        if callable(value):
            module = getattr(value, "__module__", None) or kind.__module__
            name = getattr(value, "__qualname__", "<object>")
            is_found = "<" not in name and not is_authors(module)
            return NotImplemented if is_found else (Code, (module, name))
        if not is_authors(kind.__module__):
            return NotImplemented
        if not is_dataclass(value):
            legal = "legal: numbers, texts, arrays, dataclasses"
            raise OwnClassError(f"an object of {kind.__module__}.{kind.__qualname__}; {legal}")
        held = tuple((each.name, getattr(value, each.name)) for each in fields(value))
        return Record, (Code(kind.__module__, kind.__qualname__), held)


class _Unpacker(pickle.Unpickler):
    def find_class(self, module: str, name: str) -> Any:
        if is_authors(module):
            raise OwnClassError(f"an object of {module}.{name}; legal: of a class of Python's own")
        return super().find_class(module, name)


def _check_texts(value: Any) -> None:
    """Raises `TypeError` where a field for a text holds none that a page can show."""
    for each in fields(value):
        held = getattr(value, each.name)
        if each.type is str and (not isinstance(held, str) or CONTROL.search(held)):
            said = f"{each.name} {held!r} of a {type(value).__name__}"
            raise TypeError(f"{said}; legal: a text of characters that can be shown")


def _class(kind: type[Any]) -> tuple[Callable[..., Any], tuple[Any, ...]]:
    entries = fields(kind) if is_dataclass(kind) else ()
    if not entries or not all("control" in entry.metadata for entry in entries):
        return Code, (kind.__module__, kind.__qualname__)
    made = [(each.name, each.type, each.metadata["control"](each.name)) for each in entries]
    return _settings, (kind.__name__, made)


def _settings(title: str, entries: Iterable[tuple[str, Any, Control]]) -> type[Any]:
    """A dataclass of settings with these controls."""

    def entry(control: Control) -> object:
        return setting(control.default, lambda _name: control)

    made = [(name, kind, entry(control)) for name, kind, control in entries]
    return make_dataclass(title, made, frozen=True, slots=True)
