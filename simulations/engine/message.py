"""Messages of the engine to readers, by key: the words are in the language of the book. And the
messages of exceptions as they can be shown, on a screen, in a terminal or in JSON."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Message:
    """A message; the page looks up its words."""

    key: str
    """Key in the texts of the interface, below ``script``."""
    values: Mapping[str, str] = field(default_factory=dict)
    """Values of the placeholders: names, numbers, messages of Python."""


LONGEST = 2000
"""Letters of a message that are shown; `static/js/errors.ts` has the same."""
CONTROL = re.compile(
    "(?![\n\t])[\x00-\x1f\x7f-\x9f](?:\\[[0-9;?]*[A-Za-z])?|[\u202a-\u202e\u2066-\u2069]"
)
"""Escape sequences of terminals, control characters, and characters that reverse the direction."""


def legible(text: str) -> str:
    """A text that may hold anything, as it can be shown: without control characters, and cut."""
    start = CONTROL.sub("", text[:LONGEST]).rstrip()
    return f"{start} …" if len(text) > LONGEST else start
