"""Kinds of values in ``book.toml``: what is legal, how it is read, how a JSON schema says it."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from site_builder.addresses import PATH, site_address, source_address


class Kind(Protocol):
    """One kind of value."""

    @property
    def expected(self) -> str:
        """What may stand there, as a mistake's message says it."""

    def read(self, value: object) -> Any:
        """The value as the builder has it. Raises `ValueError` where it is not legal."""

    def schema(self) -> dict[str, object]:
        """The same as JSON schema."""


@dataclass(frozen=True, slots=True)
class Text:
    """Words, of a certain form where there is a pattern."""

    expected: str = '"some text"'
    pattern: str = r"[\s\S]*\S[\s\S]*"

    def read(self, value: object) -> str:
        if not isinstance(value, str) or not re.fullmatch(self.pattern, value):
            raise ValueError
        return value

    def schema(self) -> dict[str, object]:
        form = {} if self.pattern == Text().pattern else {"pattern": f"^(?:{self.pattern})$"}
        return {"type": "string", "minLength": 1, **form}


COLOUR = Text('"#rrggbb"', "#[0-9a-fA-F]{6}")
PREFIX = Text("small letters, digits and hyphens", "[a-z0-9]+(?:-[a-z0-9]+)*")
FILE = Text("a file below content/", r"[^/\\\s][^\\]*")


@dataclass(frozen=True, slots=True)
class Address:
    """An address that a function of `site_builder.addresses` takes."""

    expected: str
    checked: Callable[[object], str]

    def read(self, value: object) -> str:
        if value == "":
            raise ValueError
        return self.checked(value)

    def schema(self) -> dict[str, object]:
        return {"type": "string", "minLength": 1, "pattern": "^https?://[^/?#\\s]+"}


SITE = Address('"https://host/path/"', site_address)
SOURCE = Address(f'"https://host/…/{PATH}"', source_address)


@dataclass(frozen=True, slots=True)
class Whole:
    """A whole number from ``least`` on."""

    least: int

    @property
    def expected(self) -> str:
        return f"a whole number from {self.least}"

    def read(self, value: object) -> int:
        if not isinstance(value, int) or isinstance(value, bool) or value < self.least:
            raise ValueError
        return value

    def schema(self) -> dict[str, object]:
        return {"type": "integer", "minimum": self.least}


@dataclass(frozen=True, slots=True)
class YesOrNo:
    """Whether."""

    expected: str = "true or false"

    def read(self, value: object) -> bool:
        if not isinstance(value, bool):
            raise ValueError
        return value

    def schema(self) -> dict[str, object]:
        return {"type": "boolean"}


@dataclass(frozen=True, slots=True)
class OneOf:
    """One of some names."""

    names: Callable[[], Sequence[str]]

    @property
    def expected(self) -> str:
        return ", ".join(f'"{name}"' for name in self.names())

    def read(self, value: object) -> str:
        if value not in self.names():
            raise ValueError
        return str(value)

    def schema(self) -> dict[str, object]:
        return {"enum": list(self.names())}


@dataclass(frozen=True, slots=True)
class Names:
    """A list of texts."""

    expected: str
    least: int = 0

    def read(self, value: object) -> tuple[str, ...]:
        listed = isinstance(value, list) and all(isinstance(item, str) for item in value)
        if not isinstance(value, list) or not listed or len(value) < self.least:
            raise ValueError
        return tuple(value)

    def schema(self) -> dict[str, object]:
        return {"type": "array", "items": {"type": "string"}, "minItems": self.least}


@dataclass(frozen=True, slots=True)
class SomeOf:
    """A list of some of these names."""

    names: tuple[str, ...]

    @property
    def expected(self) -> str:
        return f"[some of {', '.join(f'"{name}"' for name in self.names)}]"

    def read(self, value: object) -> tuple[str, ...]:
        if not isinstance(value, list) or any(item not in self.names for item in value):
            raise ValueError
        return tuple(value)

    def schema(self) -> dict[str, object]:
        return {"type": "array", "items": {"enum": [*self.names]}}


@dataclass(frozen=True, slots=True)
class Entries:
    """A table whose keys are the author's, each with a text."""

    expected: str

    def read(self, value: object) -> Mapping[str, str]:
        if not isinstance(value, dict) or not all(isinstance(item, str) for item in value.values()):
            raise ValueError
        return dict(value)

    def schema(self) -> dict[str, object]:
        return {"type": "object", "additionalProperties": {"type": "string"}}


@dataclass(frozen=True, slots=True)
class Table:
    """A table of its own; ``of`` is the class that declares its keys."""

    of: type[Any]
    expected: str = "a table"

    def read(self, value: object) -> Mapping[str, object]:
        if not isinstance(value, dict):
            raise ValueError
        return value

    def schema(self) -> dict[str, object]:
        raise TypeError("a table's schema is made of those of its keys")
