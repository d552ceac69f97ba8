"""Passages as plain words: for the search, and for lengths as they are read."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from xml.etree import ElementTree

from markdown_it.token import Token

from site_builder.document.passage import Passage

LONGEST_FORMULA = 14
"""Characters of a formula that the search shows; a longer one becomes an ellipsis."""
SILENT = ("fence", "code_block", "math_block", "math_block_label", "html_block", "html_inline")


@dataclass(frozen=True, slots=True)
class Piece:
    """Some words of a passage."""

    text: str
    term: str = ""
    """What they end: words that are emphasised, which is how terms are introduced."""
    heading: str | None = None
    """Element id of the heading that they belong to; None for other words."""


def plain_words(passage: Passage) -> str:
    """All of it but code and displayed formulae."""
    return " ".join("".join(piece.text for piece in pieces(passage, 10**6)).split())


def pieces(passage: Passage, longest_formula: int = LONGEST_FORMULA) -> Iterator[Piece]:
    """Its words in order. A space ends each paragraph, list item and cell."""
    heading: str | None = None
    for token in passage.tokens:
        if token.type == "heading_open":
            heading = str(token.attrGet("id"))
        elif token.type == "heading_close":
            heading = None
        elif token.type == "inline":
            yield from _inline_pieces(token.children or (), heading, longest_formula)
        elif token.nesting <= 0 and token.type not in SILENT:
            yield Piece(" ")


def _inline_pieces(
    children: Sequence[Token], heading: str | None, longest_formula: int
) -> Iterator[Piece]:
    emphasised: list[str] = []
    depth = 0
    for child in children:
        if child.type in ("strong_open", "em_open"):
            depth += 1
        elif child.type in ("strong_close", "em_close"):
            depth -= 1
            if not depth:
                yield Piece("", term="".join(emphasised))
                emphasised.clear()
        elif text := _text(child, longest_formula):
            if depth:
                emphasised.append(text)
            yield Piece(text, heading=heading)


def _text(token: Token, longest_formula: int) -> str:
    if token.type in ("softbreak", "hardbreak"):
        return " "
    if token.type in SILENT:
        return ""
    if token.type == "math_inline":
        formula = _formula(str(token.meta.get("mathml", "")))
        shown = formula if len(formula) <= longest_formula else "…"
        return str(token.meta.get("before", "")) + shown + str(token.meta.get("after", ""))
    if token.children:
        return "".join(_text(child, longest_formula) for child in token.children)
    return token.content


def _formula(mathml: str) -> str:
    """The letters of a formula, without spaces."""
    return "".join("".join(ElementTree.fromstring(f"<m>{mathml}</m>").itertext()).split())
