"""A flat list of tokens to a tree of blocks: runs of prose, and directives read by constructs."""

from collections.abc import Iterable, Sequence
from itertools import accumulate

from markdown_it.token import Token

from site_builder.book import Block, Prose
from site_builder.diagnostics import unknown
from site_builder.markdown.fences import Directive
from site_builder.markdown.reading import Reading


def read_blocks(tokens: Sequence[Token], reading: Reading) -> tuple[Block, ...]:
    """Tokens at one level of nesting as blocks, in order."""
    blocks: list[Block] = []
    prose: list[Token] = []

    def end_prose() -> None:
        if prose and (html := reading.html(prose)):
            blocks.append(Prose(html))
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


def read_html(directive: Directive, tokens: Sequence[Token], reading: Reading) -> str:
    """The body of a directive that may hold only plain Markdown, as HTML."""
    for token in tokens:
        if token.type == "directive_open":
            inner: Directive = token.meta["directive"]
            reading.problem(
                inner.line,
                f"directive {{{inner.name}}} inside {{{directive.name}}}; legal: plain Markdown",
            )
            return ""
    return reading.html(tokens)


def check_options(directive: Directive, legal: Iterable[str], reading: Reading) -> None:
    """Report options that the directive does not have."""
    names = list(legal)
    for name, value in directive.options.items():
        if name not in names:
            reading.problem(value.line, unknown(f"option of {{{directive.name}}}", name, names))


def _end_of_element(tokens: Sequence[Token], start: int) -> int:
    depths = accumulate(token.nesting for token in tokens[start:])
    return start + next(count for count, depth in enumerate(depths, start=1) if depth == 0)


def _read_directive(element: Sequence[Token], reading: Reading) -> Block | None:
    directive: Directive = element[0].meta["directive"]
    construct = reading.constructs.get(directive.name)
    if construct is None:
        reading.problem(directive.line, unknown("directive", directive.name, reading.constructs))
        return None
    return construct(directive, element[1:-1], reading)


def _without_directives(element: Sequence[Token], reading: Reading) -> list[Token]:
    """Directives inside lists and quotations would be lost in a run of prose: report them."""
    for token in element:
        if token.type == "directive_open":
            directive: Directive = token.meta["directive"]
            reading.problem(
                directive.line,
                f"directive {{{directive.name}}} inside a list or quotation; "
                "legal: at the margin, or inside a callout or example",
            )
            return []
    return list(element)
