"""The author's files as text and as TOML. What cannot be read is reported with its place, and
reading goes on without it."""

import re
import tomllib
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.files.folders import is_file

HEAD = re.compile(r"\s*\[(\[?)([^\[\]]+)\]\]?\s*(?:#.*)?")
KEY = re.compile(r"""\s*((?:[\w-]+|"[^"]*"|'[^']*')(?:\s*\.\s*(?:[\w-]+|"[^"]*"|'[^']*'))*)\s*=""")
CONTROL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ud800-\udfff\ufffe\uffff]")
"""Characters that no page can show and that break an e-book."""
MERGE = re.compile("^(?:<{7}|>{7}) .*$", re.MULTILINE)
MOST_BYTES = 1_000_000
"""Most bytes of a file of text: twice a book."""
HOLDS = {"content/glossary.toml": ("unknown term",)}
"""What mistakes elsewhere begin with where a file cannot be read."""
QUOTES = re.compile(r"\"\"\"|'''")

type Keys = tuple[str | int, ...]
"""Names of tables and keys from the outside inwards; of a list of tables, a place in it too."""


@dataclass(frozen=True, slots=True)
class Toml:
    """A file of TOML, and where its keys stand."""

    table: Mapping[str, Any] = field(default_factory=dict)
    places: Mapping[Keys, int] = field(default_factory=dict)
    text: str = ""

    def line(self, *keys: str | int) -> int:
        """Where ``keys`` lead, tables' names and places in lists of tables; of what is not there,
        where the nearest table around it begins, or 1."""
        while keys and keys not in self.places:
            keys = keys[:-1]
        return self.places.get(keys, 1)

    def line_of_text(self, value: str, first: int = 1) -> int:
        """Where a text stands in quotes, looked for from line ``first``; this where it does not."""
        start = 0
        for _ in range(first - 1):
            start = self.text.find("\n", start) + 1
        found = [self.text.find(form, start) for form in (f'"{value}"', f"'{value}'")]
        place = min((each for each in found if each >= 0), default=start)
        return first + self.text.count("\n", start, place)


@dataclass(frozen=True, slots=True)
class Sources:
    """The files of a book, and the mistakes and warnings found while they are read."""

    root: Path
    """The book's folder: holds ``content/`` and ``simulations/``."""
    problems: Diagnostics = field(default_factory=Diagnostics)

    def has(self, path: str) -> bool:
        return is_file(self.root / path)

    def text(self, path: str) -> str:
        """The text of a file, without the mark that some editors put before it."""
        data = (self.root / path).read_bytes()
        if data.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):
            self.problems.add(path, 1, "UTF-16; legal: UTF-8")
            data = data.decode("utf-16", errors="replace").encode()
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError as error:
            line = data.count(b"\n", 0, error.start) + 1
            message = f"byte 0x{data[error.start]:02x} is not UTF-8; legal: UTF-8"
            self.problems.add(path, line, message)
            text = data.decode("utf-8-sig", errors="replace")
        text = text.replace("\r\n", "\n")
        if found := MERGE.search(text):
            line = text.count("\n", 0, found.start()) + 1
            expected = "one of the two versions, without the marks of the merge"
            self.problems.add(path, line, f"{found[0]!r}; legal: {expected}", spoils=(path,))
        if len(data) > MOST_BYTES:
            expected = f"at most {MOST_BYTES / 1e6:g} MB"
            self.problems.add(path, 1, f"{len(data) / 1e6:.1f} MB of text; legal: {expected}")
            text = text.partition("\n\n")[0] + "\n\n…\n"
        for found in CONTROL.finditer(text):
            line = text.count("\n", 0, found.start()) + 1
            self.problems.add(path, line, control_character_message(found[0]))
        return CONTROL.sub(" ", text)

    def toml(self, path: str) -> Toml | None:
        """The content of a file; None where there is none, or where it is no TOML."""
        if not self.has(path):
            return None
        text = self.text(path)
        try:
            toml = Toml(tomllib.loads(text), dict(_places(text)), text)
        except (ValueError, RecursionError) as error:  # also of long numbers and deep lists
            place = re.search(r"line (\d+)", str(error))
            end = text.rstrip("\n").count("\n") + 1
            spoils = (f"in {path}", *HOLDS.get(path, ()))
            place_or_end = int(place[1]) if place else end
            self.problems.add(path, place_or_end, f"malformed TOML: {error}", spoils=spoils)
            return None
        for keys, value in _texts(toml.table):
            if found := CONTROL.search(value):  # written as an escape
                self.problems.add(path, toml.line(*keys), control_character_message(found[0]))
        return toml


def control_character_message(character: str) -> str:
    """What is wrong with one of `CONTROL`."""
    return f"control character U+{ord(character):04X}; legal: visible text"


def _texts(value: object, keys: Keys = ()) -> Iterator[tuple[Keys, str]]:
    """Each text in a table, and each name, with the keys that lead there."""
    if isinstance(value, str):
        yield keys, value
    elif isinstance(value, Mapping):
        for name, held in value.items():
            yield (*keys, name), name
            yield from _texts(held, (*keys, name))
    elif isinstance(value, list):
        for place, held in enumerate(value):
            yield from _texts(held, (*keys, place))


def _places(text: str) -> Iterator[tuple[Keys, int]]:
    """Each table and each key, with its line."""
    table: Keys = ()
    counts: dict[Keys, int] = {}
    quotes = ""
    for number, line in enumerate(text.split("\n"), start=1):
        if not quotes and (head := HEAD.fullmatch(line)):
            table = _keys(head[2])
            if head[1]:
                counts[table] = counts.get(table, -1) + 1
                table = (*table, counts[table])
            yield table, number
        elif not quotes and (key := KEY.match(line)):
            yield (*table, *_keys(key[1])), number
        for mark in QUOTES.findall(line):
            quotes = "" if quotes == mark else quotes or mark


def _keys(dotted: str) -> Keys:
    """``('a', 'b.c')`` of ``a."b.c"``."""
    if re.fullmatch(r"[\w-]+", dotted):
        return (dotted,)
    try:
        found: Any = tomllib.loads(f"{dotted} = 0")
    except tomllib.TOMLDecodeError:  # within a list that looks like one
        return (dotted,)
    keys: list[str] = []
    while isinstance(found, dict):
        name, found = next(iter(found.items()))
        keys.append(name)
    return tuple(keys)
