"""What may stand between the fences of a directive: the kinds that several directives share."""

from collections.abc import Sequence

from markdown_it.token import Token

from site_builder.document.blocks import Block
from site_builder.document.passage import Passage, passage
from site_builder.markdown.blocks import read_blocks
from site_builder.markdown.directive import Body, DirectiveCall
from site_builder.markdown.parse_context import ParseContext


def plain_tokens(
    call: DirectiveCall, tokens: Sequence[Token], context: ParseContext
) -> Sequence[Token]:
    """The tokens as they are; a directive among them, which would not be shown, is reported."""
    inner = next((token for token in tokens if token.type == "directive_open"), None)
    if inner is not None:
        found: DirectiveCall = inner.meta["call"]
        where = f"directive {{{found.name}}} inside {{{call.name}}}"
        context.problem(found.line, f"{where}; legal: plain Markdown")
    return tokens


def _passage(call: DirectiveCall, tokens: Sequence[Token], context: ParseContext) -> Passage:
    return passage(plain_tokens(call, tokens, context))


def _inner_blocks(
    call: DirectiveCall, tokens: Sequence[Token], context: ParseContext
) -> tuple[Block, ...]:
    if not tokens:
        context.problem(call.line, f"{{{call.name}}} is empty; legal: some text")
    return read_blocks(tokens, context)


def _nothing(call: DirectiveCall, tokens: Sequence[Token], context: ParseContext) -> None:
    if tokens:
        context.problem(call.line, f"{{{call.name}}} with a body; legal: nothing below its options")


CAPTION = Body("a caption", _passage)
"""Plain Markdown, or nothing; the reader gets a `Passage`."""
BLOCKS = Body("text and other directives", _inner_blocks, nests=True)
"""Anything, but something; the template gets it as ``inside``."""
NO_BODY = Body("nothing", _nothing)
