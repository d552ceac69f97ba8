"""A flat list of tokens to a tree of blocks: runs of prose, and what directives make."""

from collections.abc import Sequence
from itertools import accumulate
from typing import Any

from markdown_it.token import Token

from site_builder.markdown.directive import Directive, Use
from site_builder.markdown.reading import Reading
from site_builder.markdown.usage import checked
from site_builder.page_model.blocks import Block, Prose


def read_blocks(tokens: Sequence[Token], reading: Reading) -> tuple[Block, ...]:
    """Tokens at one level of nesting as blocks, in order."""
    if not any(token.type == "directive_open" for token in tokens):
        html = reading.html(tokens) if tokens else ""
        return (Block("prose", Prose(html)),) if html else ()
    blocks: list[Block] = []
    prose: list[Token] = []

    def end_prose() -> None:
        if prose and (html := reading.html(prose)):
            blocks.append(Block("prose", Prose(html)))
        prose.clear()

    position = 0
    while position < len(tokens):
        end = _end_of_element(tokens, position)
        element = tokens[position:end]
        if element[0].type == "directive_open":
            end_prose()
            if block := _read_directive(element, reading):
                blocks.append(block)
        else:
            prose.extend(_without_directives(element, reading))
        position = end
    end_prose()
    return tuple(blocks)


def _read_directive(element: Sequence[Token], reading: Reading) -> Block | None:
    directive: Directive[Any] | None = element[0].meta["directive"]
    use: Use = element[0].meta["use"]
    if directive is None:  # of an unknown name, which is reported
        return None
    legal = checked(directive, use, reading)
    body = directive.body.read(use, element[1:-1], reading)
    content = directive.read(legal, body, reading) if legal else None
    if content is None:
        return None
    inside = body if directive.body.nests else ()
    return Block(directive.template, content, inside, reading.placed.get(use.line))


def _end_of_element(tokens: Sequence[Token], start: int) -> int:
    depths = accumulate(token.nesting for token in tokens[start:])
    return start + next(count for count, depth in enumerate(depths, start=1) if depth == 0)


def _without_directives(element: Sequence[Token], reading: Reading) -> list[Token]:
    """Directives inside lists and quotations would be lost in a run of prose: report them."""
    for token in element:
        if token.type == "directive_open":
            use: Use = token.meta["use"]
            reading.problem(
                use.line,
                f"directive {{{use.name}}} inside a list or quotation; "
                "legal: at the margin, or inside a callout or example",
            )
            return []
    return list(element)
