"""The definitions of a module as pieces of its source, which readers can read and edit."""

import ast
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import import_module
from importlib.machinery import ModuleSpec
from inspect import unwrap
from typing import Any
from zipimport import zipimporter

ROOMS = ("models", "pictures", "world", "ladders", "scenes")
"""Packages of ``simulations`` whose definitions readers can edit."""


SOURCES = "/lib/simulations.zip"
"""Folder of the sources in the browser, which runs the modules as byte code."""


@dataclass(frozen=True, slots=True)
class Definition:
    """A function, class or constant of a module, with its comments and docstring."""

    name: str
    first: int
    """Its first line in the file, from 1, with decorators and comments directly above."""
    last: int
    """Its last line, with the docstring of a constant."""


def is_editable(module: str) -> bool:
    """Whether the module of that full name is in one of `ROOMS`."""
    package, _, rest = module.partition(".")
    return package == "simulations" and rest.partition(".")[0] in ROOMS


def module_source(module: str) -> str:
    """The source of an editable module, by its full name. Raises `ValueError` for any other."""
    if not is_editable(module):
        raise ValueError(f"module {module!r}; legal: one in simulations/{', '.join(ROOMS)}")
    loader: Any = import_module(module).__loader__
    return str(loader.get_source(module) or _stored_source(module))


def _stored_source(module: str) -> str | None:
    """The module's file in `SOURCES`."""
    package = module.rpartition(".")[0]
    return zipimporter(f"{SOURCES}/{package.replace('.', '/')}").get_source(module)


class SourceFinder:
    """The last finder of the browser: takes modules that were not fetched from `SOURCES`."""

    def find_spec(self, name: str, _path: object, _target: object = None) -> ModuleSpec | None:
        if not name.startswith("simulations."):
            return None
        folder = name.rpartition(".")[0].replace(".", "/")
        return zipimporter(f"{SOURCES}/{folder}").find_spec(name)


def import_from_sources() -> None:
    """In the browser: make every module of the book importable, fetched or not."""
    known = any(isinstance(finder, SourceFinder) for finder in sys.meta_path)
    if sys.platform == "emscripten" and not known:
        sys.meta_path.append(SourceFinder())


def definitions(source: str) -> dict[str, Definition]:
    """The top-level definitions of ``source`` by name, in order. Raises `SyntaxError`."""
    lines = source.split("\n")
    statements = ast.parse(source).body
    found = {}
    for statement, following in zip(statements, [*statements[1:], None], strict=True):
        name = defined_name(statement)
        if name:
            match statement, following:
                case ast.Assign() | ast.AnnAssign(), ast.Expr(value=ast.Constant(value=str())):
                    last: ast.stmt = following  # the docstring of the constant above it
                case _:
                    last = statement
            end = last.end_lineno or statement.lineno
            found[name] = Definition(name, _first_line(statement, lines), end)
    return found


def defined_name(statement: ast.stmt) -> str:
    """The name that a statement defines; empty unless it defines exactly one."""
    match statement:
        case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
            return name
        case ast.Assign(targets=[ast.Name(id=name)]) | ast.AnnAssign(target=ast.Name(id=name)):
            return name
        case _:
            return ""


def home(function: Callable[..., Any]) -> tuple[str, str]:
    """Full name of the module and name of the definition that contain ``function``.

    A lambda or an inner function belongs to the definition around it. Two empty strings if the
    function is not written in Python.
    """
    while hasattr(function, "func"):  # partial
        function = function.func
    function = unwrap(function)
    code = getattr(function, "__code__", None)
    if code is None or not is_editable(function.__module__):
        return "", ""
    for item in definitions(module_source(function.__module__)).values():
        if item.first <= code.co_firstlineno <= item.last:
            return function.__module__, item.name
    return "", ""


def _first_line(statement: ast.stmt, lines: list[str]) -> int:
    first = min(line for line in _lines_of(statement))
    while first > 1 and lines[first - 2].startswith("#"):
        first -= 1
    return first


def _lines_of(statement: ast.stmt) -> Iterator[int]:
    yield statement.lineno
    for decorator in getattr(statement, "decorator_list", ()):
        yield decorator.lineno
