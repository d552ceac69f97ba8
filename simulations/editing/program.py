"""A copy of a scene's program in which some definitions are the reader's own.

The modules are executed anew, so that the copy shares nothing with the book's program but the
engine and numpy: no namespace, no cached array. Functions that hold others in tables, or took
them from other modules by name, hold those of the copy.
"""

import ast
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from importlib.machinery import ModuleSpec
from itertools import groupby
from types import ModuleType
from typing import Any

from simulations.editing.definitions import (
    defined_name,
    definitions,
    is_editable,
    module_source,
)
from simulations.engine.said import Said

type Edits = Mapping[str, str]
"""Definition, ``MODULE:NAME``, to the text in its place."""


class RefusedEditError(Exception):
    """A text that cannot stand in the place of its definition."""

    def __init__(self, definition: str, line: int, message: str | Said) -> None:
        super().__init__(message)
        self.message = message
        self.definition = definition
        self.line = line
        """Line of the text, from 1."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where an edited text stands in its module."""

    definition: str
    module: str
    first: int
    """Its first line in the edited module, from 1."""
    count: int
    """How many lines it has."""
    added: int
    """How many more than the text that was there."""

    def holds(self, module: str, line: int) -> bool:
        return module == self.module and self.first <= line < self.first + self.count


@dataclass(frozen=True, slots=True)
class Edition:
    """The modules that hold edits."""

    sources: Mapping[str, str]
    """Full name of each to its source."""
    places: tuple[Place, ...]


def edition_of(edits: Edits) -> Edition:
    """Edits put into their modules.

    Raises `RefusedEditError` for a text that is no Python or no longer defines its name, and
    `KeyError` and `ValueError` for a definition that there is not.
    """
    for definition, text in edits.items():
        _check(definition, text)
    sources: dict[str, str] = {}
    places: list[Place] = []
    for module, keys in groupby(sorted(edits), key=lambda key: key.partition(":")[0]):
        texts = {key.partition(":")[2]: edits[key] for key in keys}
        sources[module], standing = splice(module, module_source(module), texts)
        places += standing
    return Edition(sources, tuple(places))


def load_copy(module: str, sources: Mapping[str, str]) -> Any:
    """``module`` and all that it imports, executed anew; where named, from these sources.

    Raises whatever the modules raise. The book's own program stays as it was.
    """
    with _own_modules(), _instead(sources):
        return import_module(module)


def splice(module: str, source: str, texts: Mapping[str, str]) -> tuple[str, list[Place]]:
    """``source`` with other texts in place of some of its definitions, and where they stand.

    Raises `KeyError` where the module defines no such name.
    """
    known = definitions(source)
    lines, places = source.splitlines(), []
    shift = 0
    for definition in sorted((known[name] for name in texts), key=lambda item: item.first):
        text = texts[definition.name].split("\n")
        start, stop = definition.first - 1 + shift, definition.last + shift
        lines[start:stop] = text
        added = len(text) - (stop - start)
        places.append(Place(f"{module}:{definition.name}", module, start + 1, len(text), added))
        shift += added
    return "\n".join(lines) + "\n", places


def _check(definition: str, text: str) -> None:
    name = definition.partition(":")[2]
    try:
        compile(text, definition, "exec", dont_inherit=True)  # sees more mistakes than a parser
        statements = ast.parse(text).body
    except SyntaxError as error:
        raise RefusedEditError(definition, error.lineno or 1, f"SyntaxError: {error.msg}") from None
    if name not in {defined_name(statement) for statement in statements}:
        raise RefusedEditError(definition, 1, Said("workshop.undefined", {"name": name}))


class _EditedLoader:
    """Loads one module from a source of its own."""

    def __init__(self, source: str) -> None:
        self._source = source

    def create_module(self, _spec: ModuleSpec) -> None:
        """An ordinary module will do."""

    def exec_module(self, module: ModuleType) -> None:
        exec(compile(self._source, module.__name__, "exec", dont_inherit=True), vars(module))


class _EditedFinder:
    """Finds the edited modules before anyone else."""

    def __init__(self, sources: Mapping[str, str]) -> None:
        self._sources = sources

    def find_spec(self, name: str, _path: object, _target: object = None) -> ModuleSpec | None:
        source = self._sources.get(name)
        loader: Any = None if source is None else _EditedLoader(source)
        return loader and ModuleSpec(name, loader)


@contextmanager
def _instead(sources: Mapping[str, str]) -> Iterator[None]:
    """While it lasts, the modules named are imported from these sources."""
    finder = _EditedFinder(sources)
    sys.meta_path.insert(0, finder)
    try:
        yield
    finally:
        sys.meta_path.remove(finder)


@contextmanager
def _own_modules() -> Iterator[None]:
    """While it lasts, editable modules are imported anew; after it, the book's are in place."""
    package = vars(sys.modules["simulations"])
    rooms = {name: value for name, value in package.items() if is_editable(f"simulations.{name}")}
    books = _take_out()
    try:
        yield
    finally:
        _take_out()
        sys.modules.update(books)
        package.update(rooms)


def _take_out() -> dict[str, Any]:
    return {name: sys.modules.pop(name) for name in list(sys.modules) if is_editable(name)}
