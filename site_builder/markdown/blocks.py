"""A flat list of tokens to a tree of blocks: runs of prose, and what directives make."""

from collections.abc import Sequence
from typing import Any

from markdown_it.token import Token

from site_builder.document.blocks import Block, Prose
from site_builder.document.passage import passage
from site_builder.markdown.directive import Directive, DirectiveCall
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.text.tokens import end_of_element
from site_builder.markdown.usage import checked


def read_blocks(tokens: Sequence[Token], context: ParseContext) -> tuple[Block, ...]:
    """Tokens at one level of nesting as blocks, in order."""
    if not any(token.type == "directive_open" for token in tokens):
        words = passage(tokens)
        return (Block("prose", Prose(words)),) if words else ()
    blocks: list[Block] = []
    prose: list[Token] = []

    def end_prose() -> None:
        if words := passage(prose):
            blocks.append(Block("prose", Prose(words)))
        prose.clear()

    position = 0
    while position < len(tokens):
        end = end_of_element(tokens, position)
        element = tokens[position:end]
        if element[0].type == "directive_open":
            end_prose()
            if block := _read_directive(element, context):
                blocks.append(block)
        else:
            prose.extend(_without_directives(element, context))
        position = end
    end_prose()
    return tuple(blocks)


def _read_directive(element: Sequence[Token], context: ParseContext) -> Block | None:
    directive: Directive[Any] | None = element[0].meta["directive"]
    call: DirectiveCall = element[0].meta["call"]
    if directive is None:  # of an unknown name, which is reported
        return None
    expected = checked(directive, call, context)
    body = directive.body.read(call, element[1:-1], context)
    content = directive.read(expected, body, context) if expected else None
    if content is None:
        return None
    inside = body if directive.body.nests else ()
    return Block(directive.template, content, inside, context.placed.get(call.line))


def _without_directives(element: Sequence[Token], context: ParseContext) -> list[Token]:
    """Prose; a directive inside a list or quotation, which has no place there, is reported."""
    for token in element:
        if token.type == "directive_open":
            call: DirectiveCall = token.meta["call"]
            context.problem(
                call.line,
                f"directive {{{call.name}}} inside a list or quotation; "
                "legal: at the margin, or inside a callout or example",
            )
            return []
    return list(element)
