"""A copy of a scene's program in which the reader has edited some definitions.

The modules are executed anew, so that the copy shares only the engine and numpy with the book's
program: no namespace and no cached array. Tables of functions, and functions imported by name,
belong to the copy.
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

from simulations.editing.definitions import defined_name, definitions, is_editable, module_source
from simulations.engine.message import Message

type Edits = Mapping[str, str]
"""Definition, ``MODULE:NAME``, to its new text."""


class RefusedEditError(Exception):
    """A text that cannot replace its definition."""

    def __init__(self, definition: str, line: int, message: str | Message) -> None:
        super().__init__(message)
        self.message = message
        self.definition = definition
        self.line = line
        """Line of the text, from 1."""


@dataclass(frozen=True, slots=True)
class Place:
    """The place of an edited text in its module."""

    definition: str
    module: str
    first: int
    """Its first line in the edited module, from 1."""
    count: int
    """Count of its lines."""
    added: int
    """Count of lines more than the original text."""

    def holds(self, module: str, line: int) -> bool:
        return module == self.module and self.first <= line < self.first + self.count


@dataclass(frozen=True, slots=True)
class Edition:
    """The modules with edits."""

    sources: Mapping[str, str]
    """Full name of each to its source."""
    places: tuple[Place, ...]


def edition_of(edits: Edits) -> Edition:
    """Put edits into their modules.

    Raises `RefusedEditError` for a text that is not Python or no longer defines its name, and
    `KeyError` or `ValueError` for an unknown definition.
    """
    for definition, text in edits.items():
        check_text(definition, text)
    sources: dict[str, str] = {}
    places: list[Place] = []
    for module, keys in groupby(sorted(edits), key=lambda key: key.partition(":")[0]):
        texts = {key.partition(":")[2]: edits[key] for key in keys}
        sources[module], standing = splice(module, module_source(module), texts)
        places += standing
    return Edition(sources, tuple(places))


def load_copy(module: str, sources: Mapping[str, str]) -> Any:
    """Execute ``module`` and all editable modules that it imports anew, from the given sources if
    any.

    Raises what the modules raise. The book's own program stays unchanged.
    """
    with _sources_first(sources), _fresh_modules():
        return import_module(module)


def splice(module: str, source: str, texts: Mapping[str, str]) -> tuple[str, list[Place]]:
    """``source`` with new texts for some of its definitions, and the places of these texts.

    Raises `KeyError` for a name that the module does not define.
    """
    known = definitions(source)
    lines, places = source.split("\n"), []
    shift = 0
    for definition in sorted((known[name] for name in texts), key=lambda item: item.first):
        text = texts[definition.name].split("\n")
        start, stop = definition.first - 1 + shift, definition.last + shift
        lines[start:stop] = text
        added = len(text) - (stop - start)
        places.append(Place(f"{module}:{definition.name}", module, start + 1, len(text), added))
        shift += added
    return "\n".join(lines).removesuffix("\n") + "\n", places


def check_text(definition: str, text: str) -> None:
    """Raise `RefusedEditError` for a text that is not Python or does not define the name."""
    name = definition.rpartition(":")[2]
    try:
        compile(text, definition, "exec", dont_inherit=True)  # finds more mistakes than parsing
        statements = ast.parse(text).body
    except SyntaxError as error:
        raise RefusedEditError(definition, error.lineno or 1, f"SyntaxError: {error.msg}") from None
    if name not in {defined_name(statement) for statement in statements}:
        raise RefusedEditError(definition, 1, Message("workshop.undefined", {"name": name}))


class _EditedLoader:
    """Loads one module from a given source."""

    def __init__(self, source: str, file: str | None) -> None:
        self._source, self._file = source, file

    def create_module(self, _spec: ModuleSpec) -> None:
        """Return None, so that the default module is used."""

    def exec_module(self, module: ModuleType) -> None:
        vars(module)["__file__"] = self._file  # beside which its data lie
        exec(compile(self._source, module.__name__, "exec", dont_inherit=True), vars(module))


class _EditedFinder:
    """The first finder: finds the edited modules."""

    def __init__(self, sources: Mapping[str, str]) -> None:
        self._sources = sources
        modules = {name: sys.modules.get(name) for name in sources}
        self._files = {name: getattr(module, "__file__", None) for name, module in modules.items()}

    def find_spec(self, name: str, _path: object, _target: object = None) -> ModuleSpec | None:
        source = self._sources.get(name)
        loader: Any = None if source is None else _EditedLoader(source, self._files[name])
        return loader and ModuleSpec(name, loader)


@contextmanager
def _sources_first(sources: Mapping[str, str]) -> Iterator[None]:
    """A context in which the given modules are imported from these sources."""
    finder = _EditedFinder(sources)
    sys.meta_path.insert(0, finder)
    try:
        yield
    finally:
        sys.meta_path.remove(finder)


@contextmanager
def _fresh_modules() -> Iterator[None]:
    """A context in which editable modules are imported anew; the book's are restored afterwards."""
    package = vars(sys.modules["simulations"])
    rooms = {name: value for name, value in package.items() if is_editable(f"simulations.{name}")}
    books = _remove_modules()
    try:
        yield
    finally:
        _remove_modules()
        sys.modules.update(books)
        package.update(rooms)


def _remove_modules() -> dict[str, Any]:
    return {name: sys.modules.pop(name) for name in list(sys.modules) if is_editable(name)}
