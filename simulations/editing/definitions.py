"""The definitions of a module, as pieces of its source: what a reader reads, and may rewrite."""

import ast
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import import_module
from inspect import unwrap
from typing import Any
from zipimport import zipimporter

ROOMS = ("models", "pictures", "ladders", "scenes")
"""Parts of ``simulations`` that may be rewritten; the engine below runs all figures alike."""


SOURCES = "/lib/simulations.zip"
"""Where the browser has the sources of modules that it runs as byte code."""


@dataclass(frozen=True, slots=True)
class Definition:
    """A function, class or constant of a module, with what is written above and below it."""

    name: str
    first: int
    """Its first line in the file, from 1: that of its decorators, or of comments close above."""
    last: int
    """Its last line; a constant's docstring belongs to it."""


def is_editable(module: str) -> bool:
    """Whether the module of that full name lies in one of `ROOMS`."""
    package, _, rest = module.partition(".")
    return package == "simulations" and rest.partition(".")[0] in ROOMS


def module_source(module: str) -> str:
    """The source of an editable module, by its full name. Raises `ValueError` for any other."""
    if not is_editable(module):
        raise ValueError(f"module {module!r}; legal: one in simulations/{', '.join(ROOMS)}")
    loader: Any = import_module(module).__loader__
    return str(loader.get_source(module) or _kept_source(module))


def _kept_source(module: str) -> str | None:
    """From `SOURCES`: an importer finds what lies in its folder, by the last part of its name."""
    package = module.rpartition(".")[0]
    return zipimporter(f"{SOURCES}/{package.replace('.', '/')}").get_source(module)


def definitions(source: str) -> dict[str, Definition]:
    """What ``source`` defines at its top level, by name, in order. Raises `SyntaxError`."""
    lines = source.splitlines()
    statements = ast.parse(source).body
    found = {}
    for statement, following in zip(statements, [*statements[1:], None], strict=True):
        name = defined_name(statement)
        if name:
            last = following if _is_text(following) and not _has_body(statement) else statement
            end = (last or statement).end_lineno or statement.lineno
            found[name] = Definition(name, _first_line(statement, lines), end)
    return found


def defined_name(statement: ast.stmt) -> str:
    """The one name that a statement defines, or nothing."""
    match statement:
        case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
            return name
        case ast.Assign(targets=[ast.Name(id=name)]) | ast.AnnAssign(target=ast.Name(id=name)):
            return name
        case _:
            return ""


def home(function: Callable[..., Any]) -> tuple[str, str]:
    """Full name of the module, and the definition in it, where ``function`` is written.

    A lambda or an inner function lies in the definition around it. Nothing, twice, where the
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
    first = min(line for line in _own_lines(statement))
    while first > 1 and lines[first - 2].startswith("#"):
        first -= 1
    return first


def _own_lines(statement: ast.stmt) -> Iterator[int]:
    yield statement.lineno
    for decorator in getattr(statement, "decorator_list", ()):
        yield decorator.lineno


def _has_body(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.FunctionDef | ast.ClassDef)


def _is_text(statement: ast.stmt | None) -> bool:
    """Whether it is a bare string: the docstring of the constant above it."""
    return (
        isinstance(statement, ast.Expr)
        and isinstance(statement.value, ast.Constant)
        and isinstance(statement.value.value, str)
    )
