"""The keys that tables of TOML files may have: declared as fields of a class, read and checked."""

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import MISSING, dataclass, field, fields
from datetime import date, datetime
from typing import Any
from urllib.parse import urlsplit

from site_builder.diagnostics.diagnostic import Diagnostics, nearest, unknown
from site_builder.files.text import Keys, Toml

PATH = "{path}"


def site_address(given: object) -> str:
    """The address with a slash at the end. Raises `ValueError`."""
    if given == "":
        return ""
    legal = "legal: 'https://host/' or 'https://host/path/'"
    if not isinstance(given, str) or not _is_plain(given):
        raise ValueError(f"address {given!r}; {legal}")
    parts = urlsplit(given)
    if parts.scheme not in ("https", "http") or not parts.hostname or parts.query or parts.fragment:
        raise ValueError(f"address {given!r}; {legal}")
    return given if given.endswith("/") else f"{given}/"


def source_address(given: object) -> str:
    """With ``{path}`` in the place of a file's path. Raises `ValueError`."""
    if given == "":
        return ""
    if (
        not isinstance(given, str)
        or given.count(PATH) != 1
        or not _is_plain(given)
        or not given.startswith(("https://", "http://"))
    ):
        raise ValueError(f"source {given!r}; legal: 'https://host/…/{PATH}', with {PATH} once")
    return given


def _is_plain(given: str) -> bool:
    return given.isprintable() and not any(character in given for character in " \"'<>\\")


@dataclass(frozen=True, slots=True)
class Kind:
    expected: str
    """What is legal, as error messages name it."""
    legal: Callable[[Any], bool]
    convert: Callable[[Any], Any] = lambda value: value
    """The value as the builder has it. Raises `ValueError` where it is not legal after all."""
    table: type[Any] | None = None
    """The class that declares the keys of a table."""

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
LANGUAGE = text('"en", "de", "pt-BR"', r"^[a-z]{2,3}(?:-[A-Za-z0-9]{2,8})*\Z")
FACES = text("'Verdana, sans-serif'", r"^[\w\s,\"'-]*\w[\w\s,\"'-]*\Z")
LETTERS = Kind("a whole number from 45 to 90", lambda value: value in range(45, 91))
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


@dataclass(frozen=True, slots=True)
class Key:
    """What is declared of a key."""

    name: str
    kind: Kind
    doc: str
    """What it sets, for the table in the guide."""
    default: object
    """`MISSING` where the key is required."""
    without: str
    """What holds without the key, in words, where the default value is none."""

    @property
    def required(self) -> bool:
        return self.default is MISSING


def key(kind: Kind, doc: str = "", default: Any = MISSING, *, without: str = "") -> Any:
    """A field of a table's class; required where it has no default."""
    return field(default=default, metadata={"kind": kind, "doc": doc, "without": without})


def keys_of(table: type[Any]) -> Iterator[Key]:
    """The keys of a table, in their order."""
    for item in fields(table):
        if item.metadata:
            yield Key(name=item.name, default=item.default, **item.metadata)


@dataclass(frozen=True, slots=True)
class Reader:
    """Reads the tables of a TOML file and reports their mistakes."""

    path: str
    toml: Toml
    problems: Diagnostics

    def table[T](self, of: type[T], values: object, at: Keys = (), **others: object) -> T:
        """The table at the keys ``at``, with defaults for what is left out or wrong. ``others`` are
        the fields of the class that are no keys."""
        return of(**others, **self.values(keys_of(of), values, at))

    def values(self, declared: Iterable[Key], values: object, at: Keys = ()) -> dict[str, Any]:
        """The values of these keys, without what is left out or wrong."""
        given = values if isinstance(values, dict) else {}
        known = {item.name: item for item in declared}
        for name in given:
            if name not in known:
                message = unknown(f"key{_inside(at)}", name, known)
                self.report((*at, name), message, f"no {nearest(name, known)!r}{_inside(at)};")
        read = {name: self._value(item, given, at) for name, item in known.items()}
        return {name: each for name, each in read.items() if each is not MISSING}

    def tables[T](
        self, of: type[T], name: str, others: Collection[str] = ()
    ) -> tuple[T, ...] | None:
        """The tables ``[[name]]``; None, and a report, where there are none. ``others`` are the
        other keys of the file."""
        for given in self.toml.table:
            if given not in (name, *others):
                self.report((given,), unknown("key", given, (*others, name)))
        entries = self.toml.table.get(name)
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            self.report((name,), f"no [[{name}]]; legal: one or more, each below '[[{name}]]'")
            return None
        return tuple(self.table(of, entry, (name, at)) for at, entry in enumerate(entries))

    def report(self, at: Keys, message: str, *spoils: str) -> None:
        self.problems.add(self.path, self.toml.line(*at), message, spoils=spoils)

    def _value(self, item: Key, values: Mapping[str, object], at: Keys) -> Any:
        given, place = values.get(item.name, MISSING), (*at, item.name)
        if given is MISSING and not item.required:
            return MISSING
        try:
            value = item.kind.read(given)
        except ValueError:
            expected = item.kind.expected
            if item.required and (given is MISSING or not given):
                self.report(
                    place, f"no {item.name!r}{_inside(at)}; legal: {item.name} = {expected}"
                )
            else:
                if isinstance(given, dict) and item.kind.legal({}):
                    wrong = next(name for name in given if not item.kind.legal({name: given[name]}))
                    place, given = (*place, wrong), given[wrong]
                self.report(place, f"{_dotted(place)} is {_toml(given)}; legal: {expected}")
            return MISSING if not item.required else () if isinstance(given, list) else ""
        return self.table(item.kind.table, value, place) if item.kind.table else value


def _dotted(keys: Keys) -> str:
    return ".".join(name for name in keys if isinstance(name, str))


def _inside(at: Keys) -> str:
    return f" of [{_dotted(at)}]" if at else ""


def _toml(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict | list):
        return "a table" if isinstance(value, dict) else "a list"
    return f'"{value}"' if isinstance(value, str) else str(value)
