"""Patterns that are looked for only where a text has what each of them asks for: to look for a
letter takes a hundredth of the time."""

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

HIDDEN = re.compile(r"%[0-9A-Fa-f]{2}|[^\W\D0-9]")
"""What a page may show otherwise than its source has it, an address by its letters, and digits
besides the ten."""


class Suspect(NamedTuple):
    """What stands in running text only by mistake."""

    marks: tuple[str, ...]
    """One of these is in all that the pattern fits. A single letter is looked for ten times as
    quickly as two."""
    pattern: re.Pattern[str]
    """Its first group is what is reported."""
    expected: str


def possible(suspects: Sequence[Suspect], source: str) -> list[Suspect]:
    """Those that may be found in the text of a page."""
    if ("%" in source or not source.isascii()) and HIDDEN.search(source):
        return [each._replace(marks=("",)) for each in suspects]
    return [each for each in suspects if has_one(source, each.marks)]


def marks_of(suspects: Sequence[Suspect]) -> tuple[str, ...]:
    """All that they ask for, each once."""
    return tuple(dict.fromkeys(mark for each in suspects for mark in each.marks))


def has_one(text: str, marks: Sequence[str]) -> bool:
    """Whether one of ``marks`` is in ``text``."""
    for mark in marks:  # noqa: SIM110  (asked of each paragraph: `any` takes three times as long)
        if mark in text:
            return True
    return False


def suspicious(
    text: str, suspects: Sequence[Suspect], all_marks: Sequence[str]
) -> Iterable[tuple[str, str]]:
    """What is found in ``text``, and what would be legal; each once. ``all_marks`` are those that
    `marks_of` has of the suspects."""
    return _found(text, suspects) if has_one(text, all_marks) else ()


def _found(text: str, suspects: Sequence[Suspect]) -> Iterator[tuple[str, str]]:
    for marks, pattern, expected in suspects:
        if has_one(text, marks) and (found := pattern.search(text)):
            yield found[1], expected
