"""Numbers that a chapter works out in its own text, and where they stand in its source.

A chapter may have modules ``tests/content/numbers_NN….py``: ``CHAPTER`` is its file, and its
generators are calculations, which compute again with the models and yield the phrases in which
the results stand.
"""

import re
from collections.abc import Callable, Iterator
from pathlib import Path

CONTENT = Path(__file__).resolve().parents[2] / "content"
type Phrases = Iterator[str]
type Calculation = Callable[[], Phrases]

SLOW: set[Calculation] = set()
"""Calculations of more than a few seconds, which `make test-deep` runs."""


def slow(calculation: Calculation) -> Calculation:
    """Leave a calculation to the deep tests."""
    SLOW.add(calculation)
    return calculation


def source(chapter: str) -> str:
    """The chapter as written; no-break spaces count as spaces, links as their words, symbols have
    no colour, and citations are left out."""
    text = (CONTENT / f"{chapter}.md").read_text(encoding="utf-8").replace("\u00a0", " ")
    text = re.sub(r" ?\{cite\}`[^`]*`", "", text)
    text = re.sub(r"\{calc\}`[^`]*`|\\calc\{[^{}]*\}", "0", text)
    text = re.sub(r"\\role\{\w+\}\{((?:[^{}]|\{[^{}]*\})*)\}", r"\1", text)
    return re.sub(r"\{(?:set|ref)\}`([^`<]*?)\s*<[^`]*>`", r"\1", text)
