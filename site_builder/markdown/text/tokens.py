"""Walking the parser's tokens."""

from collections.abc import Iterator, Sequence

from markdown_it.token import Token


def located(tokens: Sequence[Token]) -> Iterator[tuple[Token, int]]:
    """All tokens, those inside paragraphs included, each with its line counted from 1."""
    line = 1
    for token in tokens:
        line = token.map[0] + 1 if token.map else line
        yield token, line
        offset = 0
        for child in token.children or ():
            yield child, line + offset
            is_break = child.type in ("softbreak", "hardbreak")
            offset += 1 if is_break else child.content.count("\n")


def plain_text(inline: Token) -> str:
    """The words of a paragraph or heading, without markup."""
    parts = (
        " " if child.type in ("softbreak", "hardbreak") else child.content
        for child in inline.children or ()
    )
    return "".join(parts).strip()
