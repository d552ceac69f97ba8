"""What the engine says to readers: not in words, which are those of the book's language."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Said:
    """One thing that is said; the page has the words for it."""

    key: str
    """Among the words of the interface, below ``script``."""
    values: Mapping[str, str] = field(default_factory=dict)
    """What stands in the places of the words: names, numbers, what Python itself says."""
