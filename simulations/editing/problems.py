"""Locates errors in the reader's edits."""

from collections.abc import Sequence
from dataclasses import dataclass
from traceback import walk_tb

from simulations.editing.definitions import is_editable
from simulations.editing.program import Place, RefusedEditError
from simulations.engine.message import Message, legible


@dataclass(frozen=True, slots=True)
class Problem:
    """An exception, and the line of an edit that caused it."""

    message: str | Message
    """Message of Python or of the engine."""
    definition: str = ""
    """``MODULE:NAME`` of the edited definition; empty if no edited definition was running."""
    line: int = 0
    """Line of its text, from 1; 0 for none."""


def problem_of(error: BaseException, places: Sequence[Place]) -> Problem:
    """The problem to show for ``error``, raised while a program with edits at ``places`` ran.

    It has the innermost edited line. If the book's own code, called from there, raised the error,
    the message states where.
    """
    if isinstance(error, RefusedEditError):
        return Problem(error.message, error.definition, error.line)
    text = _text_of(error)
    steps = [
        (str(frame.f_globals.get("__name__")), line) for frame, line in walk_tb(error.__traceback__)
    ]
    edited = [
        (i, place, line)
        for i, (module, line) in enumerate(steps)
        for place in places
        if place.holds(module, line)
    ]
    if not edited:
        return Problem(_with_place(text, steps, places))
    depth, place, line = edited[-1]
    message = _with_place(text, steps[depth + 1 :], places)
    return Problem(message, place.definition, line - place.first + 1)


def _text_of(error: BaseException) -> str | Message:
    """Its class and message; only its class where it raises another error when it is asked."""
    if isinstance(error, EOFError):
        return Message("workshop.no_input")
    try:
        return legible(f"{type(error).__name__}: {error}".removesuffix(": "))
    except BaseException:
        return type.__repr__(type(error))


def _with_place(
    error: str | Message, steps: Sequence[tuple[str, int]], places: Sequence[Place]
) -> str | Message:
    """The message with the innermost line of the book's own code."""
    if isinstance(error, Message):
        return error
    for module, line in reversed(steps):
        if is_editable(module):
            above = (p.added for p in places if p.module == module and p.first < line)
            place = {"file": f"{module.replace('.', '/')}.py", "line": str(line - sum(above))}
            return Message("workshop.raised_in", {"error": error, **place})
    return error
