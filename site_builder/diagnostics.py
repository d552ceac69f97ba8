"""Mistakes in the sources, each with its place: collected, printed together, failing once."""

import difflib
from collections.abc import Iterable
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True, order=True)
class Diagnostic:
    """One mistake."""

    path: str
    """File, relative to the root of the project."""
    line: int
    """Line, counted from 1."""
    message: str
    """What was found; what is legal."""

    def __str__(self) -> str:
        return f"{self.path}:{self.line}: {self.message}"


@dataclass(slots=True)
class Diagnostics:
    """The mistakes found so far. Checks add to it and go on, so that one run shows them all."""

    found: list[Diagnostic] = field(default_factory=list)

    def add(self, path: str, line: int, message: str) -> None:
        self.found.append(Diagnostic(path, line, message))

    def __bool__(self) -> bool:
        return bool(self.found)


class BuildError(Exception):
    """The book cannot be built; carries every diagnostic, in the order of files and lines."""

    def __init__(self, diagnostics: Iterable[Diagnostic]) -> None:
        self.diagnostics = tuple(sorted(set(diagnostics)))
        super().__init__("\n".join(map(str, self.diagnostics)))


def unknown(kind: str, given: str, legal: Iterable[str]) -> str:
    """``unknown KIND 'given'``, then the nearest legal name or, where none is near, all of them."""
    names = list(legal)
    near = difflib.get_close_matches(given, names, n=1)
    hint = f"did you mean {near[0]!r}?" if near else f"legal: {', '.join(names) or 'none'}"
    return f"unknown {kind} {given!r}; {hint}"
