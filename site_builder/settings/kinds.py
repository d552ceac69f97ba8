"""Kinds of values in the author's TOML files: what is legal, as JSON schema, and how it is read."""

import re
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from datetime import date, datetime
from typing import Any

from site_builder.addresses import PATH, site_address, source_address


@dataclass(frozen=True, slots=True)
class Kind:
    """One kind of value."""

    expected: str
    """What is legal, as error messages name it."""
    schema: Mapping[str, Any]
    """The same as JSON schema."""
    convert: Callable[[Any], Any] = lambda value: value
    """The value as the builder has it. Raises `ValueError` where it is not legal after all."""
    table: type[Any] | None = None
    """Of a table, the class that declares its keys."""

    def read(self, value: object) -> Any:
        """Raises `ValueError` where the value is not legal."""
        if not fits(value, self.schema):
            raise ValueError(self.expected)
        return self.convert(value)


def fits(value: object, schema: Mapping[str, Any]) -> bool:
    """Whether a value is legal by the part of JSON schema that is used here."""
    if "enum" in schema:
        return value in schema["enum"]
    match schema.get("type"), value:
        case "string", str():
            return re.search(schema["pattern"], value) is not None
        case "boolean", bool():
            return True
        case "integer", int():
            return not isinstance(value, bool) and value >= schema["minimum"]
        case "array", list():
            items = schema["items"]
            return len(value) >= schema["minItems"] and all(fits(item, items) for item in value)
        case "object", dict():
            items = schema.get("additionalProperties", {})
            return all(fits(item, items) for item in value.values())
        case None, _:
            return True
        case _:
            return False


def text(expected: str = '"some text"', pattern: str = r"\S") -> Kind:
    """Text in which the pattern is found."""
    return Kind(expected, {"type": "string", "pattern": pattern})


def whole_number(least: int) -> Kind:
    return Kind(f"a whole number from {least}", {"type": "integer", "minimum": least})


def one_of(names: Collection[str]) -> Kind:
    return Kind(", ".join(f'"{name}"' for name in names), {"enum": [*names]})


def texts(expected: str, least: int = 0, among: Collection[str] = ()) -> Kind:
    """A list of at least so many texts, all of them ``among`` those where any are named."""
    items = {"enum": [*among]} if among else TEXT.schema
    return Kind(expected, {"type": "array", "items": items, "minItems": least}, tuple)


def entries(expected: str) -> Kind:
    """A table of texts whose keys the author names."""
    items = {"type": "string", "pattern": ""}
    return Kind(expected, {"type": "object", "additionalProperties": items})


def table(of: type[Any]) -> Kind:
    """A table whose keys the class ``of`` declares."""
    return Kind("a table", {"type": "object"}, table=of)


def _day(value: object) -> str:
    if not isinstance(value, date) or isinstance(value, datetime):
        raise ValueError
    return value.isoformat()


ADDRESS = {"type": "string", "pattern": r"^https?://[^/?#\s]+"}
TEXT = text()
PREFIX = text("small letters, digits and hyphens", "^[a-z0-9]+(?:-[a-z0-9]+)*$")
SITE = Kind('"https://host/path/"', ADDRESS, site_address)
SOURCE = Kind(f'"https://host/…/{PATH}"', ADDRESS, source_address)
BOOLEAN = Kind("true or false", {"type": "boolean"})
DAY = Kind("2026-11-22", {}, _day)
