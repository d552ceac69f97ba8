"""Kinds of values in ``book.toml``: what is legal, how it is read, and its JSON schema."""

import re
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Any

from site_builder.addresses import PATH, site_address, source_address


@dataclass(frozen=True, slots=True)
class Kind:
    """One kind of value."""

    expected: str
    """What is legal, as error messages name it."""
    read: Callable[[Any], Any]
    """The value as the builder has it. Raises `ValueError` where it is not legal."""
    schema: Mapping[str, object]
    """The same as JSON schema."""
    table: type[Any] | None = None
    """Of a table, the class that declares its keys."""


def text(expected: str = '"some text"', pattern: str = "") -> Kind:
    """Text that is not blank, of a certain form where there is a pattern."""
    form = {"pattern": f"^(?:{pattern})$"} if pattern else {}
    full = pattern or r"[\s\S]*\S[\s\S]*"
    return Kind(
        expected,
        _checked(lambda value: isinstance(value, str) and re.fullmatch(full, value) is not None),
        {"type": "string", "minLength": 1, **form},
    )


def address(expected: str, check: Callable[[object], str]) -> Kind:
    """An address that a function of `site_builder.addresses` accepts."""

    def read(value: object) -> str:
        if value == "":
            raise ValueError
        return check(value)

    schema = {"type": "string", "minLength": 1, "pattern": "^https?://[^/?#\\s]+"}
    return Kind(expected, read, schema)


def whole_number(least: int) -> Kind:
    def legal(value: object) -> bool:
        return isinstance(value, int) and not isinstance(value, bool) and value >= least

    schema = {"type": "integer", "minimum": least}
    return Kind(f"a whole number from {least}", _checked(legal), schema)


def one_of(names: Collection[str]) -> Kind:
    expected = ", ".join(f'"{name}"' for name in names)
    return Kind(expected, _checked(lambda value: value in names), {"enum": [*names]})


def texts(expected: str, least: int = 0, among: Collection[str] = ()) -> Kind:
    """A list of at least so many texts, all of them ``among`` those where any are named."""

    def legal(value: object) -> bool:
        return isinstance(value, list) and len(value) >= least and all(map(_text, value))

    def _text(item: object) -> bool:
        return item in among if among else isinstance(item, str)

    items = {"enum": [*among]} if among else {"type": "string"}
    schema = {"type": "array", "items": items, "minItems": least}
    return Kind(expected, _checked(legal, tuple), schema)


def entries(expected: str) -> Kind:
    """A table of texts whose keys the author names."""

    def legal(value: object) -> bool:
        return isinstance(value, dict) and all(isinstance(item, str) for item in value.values())

    schema = {"type": "object", "additionalProperties": {"type": "string"}}
    return Kind(expected, _checked(legal), schema)


def table(of: type[Any]) -> Kind:
    """A table whose keys the class ``of`` declares."""
    return Kind("a table", _checked(lambda value: isinstance(value, dict)), {}, of)


def _checked(
    legal: Callable[[Any], bool], convert: Callable[[Any], Any] = lambda value: value
) -> Callable[[Any], Any]:
    def read(value: Any) -> Any:
        if not legal(value):
            raise ValueError
        return convert(value)

    return read


TEXT = text()
COLOUR = text('"#rrggbb"', "#[0-9a-fA-F]{6}")
PREFIX = text("small letters, digits and hyphens", "[a-z0-9]+(?:-[a-z0-9]+)*")
SITE = address('"https://host/path/"', site_address)
SOURCE = address(f'"https://host/…/{PATH}"', source_address)
BOOLEAN = Kind(
    "true or false", _checked(lambda value: isinstance(value, bool)), {"type": "boolean"}
)
