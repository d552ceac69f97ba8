"""What may stand between the fences of a directive: the kinds that several directives share."""

from collections.abc import Sequence

from markdown_it.token import Token

from site_builder.markdown.blocks import read_blocks
from site_builder.markdown.directive import Body, Use
from site_builder.markdown.reading import Reading
from site_builder.page_model.blocks import Block


def plain_tokens(use: Use, tokens: Sequence[Token], reading: Reading) -> Sequence[Token]:
    """The tokens as they are; a directive among them, which would not be shown, is reported."""
    inner = next((token for token in tokens if token.type == "directive_open"), None)
    if inner is not None:
        found: Use = inner.meta["use"]
        where = f"directive {{{found.name}}} inside {{{use.name}}}"
        reading.problem(found.line, f"{where}; legal: plain Markdown")
    return tokens


def _html(use: Use, tokens: Sequence[Token], reading: Reading) -> str:
    return reading.html(plain_tokens(use, tokens, reading))


def _inner_blocks(use: Use, tokens: Sequence[Token], reading: Reading) -> tuple[Block, ...]:
    if not tokens:
        reading.problem(use.line, f"{{{use.name}}} is empty; legal: some text")
    return read_blocks(tokens, reading)


CAPTION = Body("a caption", _html)
"""Plain Markdown, or nothing; the reader gets HTML."""
BLOCKS = Body("text and other directives", _inner_blocks, nests=True)
"""Anything, but something; the template gets it as ``inside``."""


def no_body(legal: str) -> Body[None]:
    """Nothing at all; ``legal`` says what stands in its place."""

    def refuse(use: Use, tokens: Sequence[Token], reading: Reading) -> None:
        if tokens:
            reading.problem(use.line, f"{{{use.name}}} with a body; legal: {legal}")

    return Body("nothing", refuse)
