"""Walking the parser's tokens."""

from collections.abc import Iterator, Sequence
from itertools import accumulate

from markdown_it.token import Token


def located(tokens: Sequence[Token]) -> Iterator[tuple[Token, int]]:
    """All tokens, those inside paragraphs included, each with its line counted from 1."""
    line = 1
    for token in tokens:
        line = token.map[0] + 1 if token.map else line
        yield token, line
        if token.children:
            yield from children_located(token, line)


def children_located(inline: Token, line: int) -> Iterator[tuple[Token, int]]:
    """What is inside of a paragraph, which begins on ``line``, each with its own line."""
    for child in inline.children or ():
        yield child, line
        if child.type in ("softbreak", "hardbreak"):
            line += 1
        elif "\n" in child.content:
            line += child.content.count("\n")


def end_of_element(tokens: Sequence[Token], start: int) -> int:
    """The index behind the token that closes what the one at ``start`` opens."""
    depths = accumulate(token.nesting for token in tokens[start:])
    return start + next(count for count, depth in enumerate(depths, start=1) if depth == 0)


def plain_text(inline: Token) -> str:
    """The words of a paragraph or heading, without markup."""
    parts = (
        " " if child.type in ("softbreak", "hardbreak") else child.content
        for child in inline.children or ()
    )
    return "".join(parts).strip()
