"""Messages of the engine to readers, by key: the words are in the language of the book."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Message:
    """A message; the page looks up its words."""

    key: str
    """Key in the texts of the interface, below ``script``."""
    values: Mapping[str, str] = field(default_factory=dict)
    """Values of the placeholders: names, numbers, messages of Python."""
