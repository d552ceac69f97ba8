"""Mistakes and warnings about the sources, each with its place: collected, printed together.

A mistake fails the build, once, when all are found. A warning is of something that may be meant.
"""

import difflib
import json
import re
import sys
from collections.abc import Iterable, Iterator, Sequence, Sized
from dataclasses import KW_ONLY, dataclass, field
from pathlib import Path

from simulations.engine.message import legible
from site_builder.diagnostics.blame import place_in, place_of, settings_of, words_of
from site_builder.diagnostics.progress import say

BELOW = "all below"
TARGETS = ("unknown target", "unknown anchor", "unknown figure of this page", "is cited nowhere")
"""What follows where labels, figures or citations are lost."""
UNREAD = ("unknown prediction of this page", "unknown figure of this page")
"""What follows where a directive is not read."""
NOT_OPENED = ("closes no directive", "is no option here", "is no task", "defines nothing")
"""What follows below a directive that is not opened."""
MOST_LISTED = 20
"""Legal names that a message lists before it only counts them."""


@dataclass(frozen=True, slots=True, order=True)
class Diagnostic:
    """One mistake, or one warning."""

    path: str
    """File, relative to the root of the project."""
    line: int
    """Line, counted from 1."""
    message: str
    """What was found; what is legal, or what would be better."""
    _: KW_ONLY
    fails: bool = True
    """Whether the book cannot be built with it; else it is a warning."""
    raised_at: str = field(default="", compare=False)
    """Where an exception of an author's code was met first; it is reported once."""
    spoils: tuple[str, ...] = field(default=(), compare=False)
    """What follows from it: other mistakes with one of these in their path or message; with `BELOW`
    among them, all that stand below it in its file."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "message", legible(self.message))

    def __str__(self) -> str:
        word = "" if self.fails else "warning: "
        raised_at = f" (met at {self.raised_at})" if self.raised_at else ""
        return f"{legible(one_line(self.path))}:{self.line}: {word}{self.message}{raised_at}"


@dataclass(slots=True)
class Diagnostics:
    """What was found so far. Checks add to it and go on, so that one run shows it all."""

    found: list[Diagnostic] = field(default_factory=list)
    """Mistakes."""
    doubts: list[Diagnostic] = field(default_factory=list)
    """Warnings."""

    def add(
        self,
        path: str,
        line: int,
        message: str,
        error: BaseException | None = None,
        spoils: tuple[str, ...] = (),
    ) -> None:
        """``error``: what an author's code raised. It is reported at the line that did, if that is
        known, and once, however often it is met."""
        found = Diagnostic(path, line, message, spoils=spoils)
        self.found.append(_at_its_source(found, error) if error else found)

    def add_of(self, module: str, path: str, line: int, message: str) -> None:
        """A mistake of an author's module, at the line that has what the message quotes, once."""
        place, _, own = place_in(module, message).rpartition(":")
        found = Diagnostic(path, line, message)
        raised_at = f"{path}:{line}"
        self.found.append(
            Diagnostic(place, int(own), message, raised_at=raised_at) if place else found
        )

    def warn(self, path: str, line: int, message: str) -> None:
        self.doubts.append(Diagnostic(path=path, line=line, message=message, fails=False))

    def __bool__(self) -> bool:
        """Whether a mistake was found; warnings do not count."""
        return bool(self.found)


class BuildError(Exception):
    """The book cannot be built; carries every diagnostic that follows from no other, in the order
    of files and lines."""

    def __init__(self, diagnostics: Iterable[Diagnostic]) -> None:
        self.diagnostics = tuple(without_following(sorted(set(diagnostics))))
        super().__init__("\n".join(map(str, self.diagnostics)))


def without_following(found: Sequence[Diagnostic]) -> Iterator[Diagnostic]:
    """Those that would stay if the others were mended: not what a mistake spoils. Of two that
    spoil each other the first stays."""
    causes = [(place, one) for place, one in enumerate(found) if one.spoils]
    for place, one in enumerate(found):
        if not any(
            _follows(one, cause) and (first < place or not _follows(cause, one))
            for first, cause in causes
            if cause is not one
        ):
            yield one


def _follows(one: Diagnostic, cause: Diagnostic) -> bool:
    if BELOW in cause.spoils and one.path == cause.path and one.line > cause.line:
        return True
    below = one.path == cause.path and one.line > cause.line
    return any(
        phrase == one.path or (phrase in one.message and (below or phrase not in NOT_OPENED))
        for phrase in cause.spoils
    )


def _at_its_source(found: Diagnostic, error: BaseException | None) -> Diagnostic:
    while error and not place_of(error):
        error = error.__cause__
    if error is None:
        return found
    path, _, line = place_of(error).rpartition(":")
    at = f", {settings}" if (settings := settings_of(error)) else ""
    raised_at = f"{found.path}:{found.line}{at}"
    return Diagnostic(path, int(line), _message(error), raised_at=raised_at)


def counted(found: Sized, name: str) -> str:
    """``2 mistakes``."""
    return f"{len(found)} {name}{'s' * (len(found) != 1)}"


def one_line(name: str) -> str:
    """The name of a file, which may hold line breaks."""
    return " ".join(name.splitlines())


def nearest(given: str, names: Iterable[str], cutoff: float = 0.6) -> str:
    """The name that was meant; nothing where none is as like as ``cutoff``, from 0 to 1.
    Capitals do not count."""
    folded = {name.casefold(): name for name in names}
    near = difflib.get_close_matches(given.casefold(), folded, n=1, cutoff=cutoff)
    return folded[near[0]] if near else ""


def unknown(kind: str, given: str, expected: Iterable[str]) -> str:
    """``unknown KIND 'given'``, then the nearest legal name or, where none is near, the legal ones:
    all of them, or the first of many."""
    names = list(map(one_line, expected))
    near = nearest(given, names)
    listed = ", ".join(names[:MOST_LISTED]) or "none"
    rest = len(names) - MOST_LISTED
    every = f"{listed} and {rest} more" if rest > 0 else listed
    return f"unknown {kind} {quoted(given)}; " + (
        f"did you mean {quoted(near)}?" if near else f"legal: {every}"
    )


def quoted(name: str) -> str:
    """As `repr`, with the backslashes of TeX as they stand."""
    return repr(name).replace(r"\\", "\\")


def cause(error: Exception) -> str:
    """``ZeroDivisionError: a division by zero, at simulations/…/scene.py:12``: an exception of
    an author's code, and where it was raised."""
    place = place_of(error)
    return f"{_message(error)}, at {place}" if place else _message(error)


def _message(error: BaseException) -> str:
    words, name = words_of(error), type(error).__name__
    return f"{name}: {words}" if words else name


SUGGESTION = re.compile(r"(?:.*; )?(?:did you mean (.*)\?|(?:legal|better): (.*))", re.DOTALL)
QUOTED = re.compile(r"'((?:[^'\\]|\\.)+)'")


def as_json(found: Sequence[Diagnostic], root: Path) -> str:
    """``{"mistakes": 1, "warnings": 0, "diagnostics": […]}``; the fields of a diagnostic are
    ``file``, ``line``, ``column`` (or null), ``severity`` (``error`` or ``warning``), ``message``,
    and ``suggestion`` (or null). Fields may be added, none is changed."""
    mistakes = sum(one.fails for one in found)
    table = {
        "mistakes": mistakes,
        "warnings": len(found) - mistakes,
        "diagnostics": [
            {
                "file": one.path,
                "line": one.line,
                "column": column_of(one, root),
                "severity": "error" if one.fails else "warning",
                "message": one.message + (f" (met at {one.raised_at})" if one.raised_at else ""),
                "suggestion": suggestion_of(one.message),
            }
            for one in found
        ],
    }
    return json.dumps(table, ensure_ascii=False, indent=1) + "\n"


def suggestion_of(message: str) -> str | None:
    """The correction that a message proposes: the nearest name, or all that is legal."""
    match = SUGGESTION.match(message)
    return (match[1] or match[2]).strip() if match else None


def column_of(diagnostic: Diagnostic, root: Path) -> int | None:
    """The column, from 1, of what the message quotes first; None where its line does not hold it
    exactly once."""
    quoted = QUOTED.search(diagnostic.message)
    if quoted is None:
        return None
    try:
        lines = (root / diagnostic.path).read_text("utf-8", errors="replace").split("\n")
    except OSError:
        return None
    line = lines[diagnostic.line - 1] if 0 < diagnostic.line <= len(lines) else ""
    return line.index(quoted[1]) + 1 if line.count(quoted[1]) == 1 else None


END = "…"


def announce(step: str) -> None:
    """Print ``step`` as it begins: ``fetching Pyodide…``."""
    say(f"{step}{END}", sys.stderr)
