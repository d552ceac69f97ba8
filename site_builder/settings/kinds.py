"""Kinds of values in the author's TOML files: what is legal, and how it is read."""

import re
from collections.abc import Callable, Collection
from dataclasses import dataclass
from datetime import date, datetime
from typing import Any

from site_builder.settings.addresses import PATH, site_address, source_address


@dataclass(frozen=True, slots=True)
class Kind:
    """One kind of value."""

    expected: str
    """What is legal, as error messages name it."""
    legal: Callable[[Any], bool]
    convert: Callable[[Any], Any] = lambda value: value
    """The value as the builder has it. Raises `ValueError` where it is not legal after all."""
    table: type[Any] | None = None
    """Of a table, the class that declares its keys."""

    def read(self, value: object) -> Any:
        """Raises `ValueError` where the value is not legal."""
        if not self.legal(value):
            raise ValueError(self.expected)
        return self.convert(value)


def text(expected: str = '"some text"', pattern: str = r"\S") -> Kind:
    """Text in which the pattern is found."""
    found = re.compile(pattern).search
    return Kind(expected, lambda value: isinstance(value, str) and found(value) is not None)


def whole_number(least: int) -> Kind:
    return Kind(
        f"a whole number from {least}",
        lambda value: isinstance(value, int) and not isinstance(value, bool) and value >= least,
    )


def one_of(names: Collection[str]) -> Kind:
    return Kind(", ".join(f'"{name}"' for name in names), lambda value: value in [*names])


def texts(expected: str, least: int = 0, among: Collection[str] = ()) -> Kind:
    """A list of at least so many texts, all of them ``among`` those where any are named."""

    def legal(value: object) -> bool:
        item = one_of(among) if among else TEXT
        return isinstance(value, list) and len(value) >= least and all(map(item.legal, value))

    return Kind(expected, legal, tuple)


def entries(expected: str) -> Kind:
    """A table of texts whose keys the author names."""

    def legal(value: object) -> bool:
        return isinstance(value, dict) and all(
            name.strip() and isinstance(item, str) for name, item in value.items()
        )

    return Kind(expected, legal)


def table(of: type[Any]) -> Kind:
    """A table whose keys the class ``of`` declares."""
    return Kind("a table", lambda value: isinstance(value, dict), table=of)


TEXT = text()
PREFIX = text("small letters, digits and hyphens", r"^[a-z0-9]+(?:-[a-z0-9]+)*\Z")
SITE = Kind('"https://host/path/"', TEXT.legal, site_address)
SOURCE = Kind(f'"https://host/…/{PATH}"', TEXT.legal, source_address)
ISBN = text('"978-3-16-148410-0"', r"^(?:[\dX]-?){10}\Z|^(?:\d-?){13}\Z")
DOI = text('"10.1000/xyz"', r"^10\.\d{4,}/\S+\Z")
ORIGIN = text('"https://host"', r"^(?:\*|https?://(?:\*\.)?[\w.-]+(?::\d+)?)\Z")
ORIGINS = Kind(
    '["https://host", …], each without a path',
    lambda value: isinstance(value, list) and all(map(ORIGIN.legal, value)),
    tuple,
)
BOOLEAN = Kind("true or false", lambda value: isinstance(value, bool))
DAY = Kind(
    "2026-11-22",
    lambda value: isinstance(value, date) and not isinstance(value, datetime),
    date.isoformat,
)
