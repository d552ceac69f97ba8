"""Numbers in the text of a chapter, computed again, and the phrases in which they occur.

A chapter may have modules ``tests/content/numbers_NN….py``: ``CHAPTER`` is its file, and its
generators are calculations, which compute with the models and yield the phrases with the results.
"""

import re
from collections.abc import Callable, Iterator
from pathlib import Path

CONTENT = Path(__file__).resolve().parents[2] / "content"
type Phrases = Iterator[str]
type Calculation = Callable[[], Phrases]

SLOW: set[Calculation] = set()
"""Calculations that take more than a few seconds; `make test-deep` runs them."""


def slow(calculation: Calculation) -> Calculation:
    """Leave a calculation to the deep tests."""
    SLOW.add(calculation)
    return calculation


def source(chapter: str) -> str:
    """The source of a chapter with plain spaces, the texts of links, and symbols without colour;
    without citations."""
    text = (CONTENT / f"{chapter}.md").read_text(encoding="utf-8").replace("\u00a0", " ")
    text = re.sub(r" ?\{cite\}`[^`]*`", "", text)
    text = re.sub(r"\{calc\}`[^`]*`|\\calc\{[^{}]*\}", "0", text)
    text = re.sub(r"\\role\{\w+\}\{((?:[^{}]|\{[^{}]*\})*)\}", r"\1", text)
    return re.sub(r"\{(?:set|ref)\}`([^`<]*?)\s*<[^`]*>`", r"\1", text)
