"""``{example} Title``: a worked example."""

from collections.abc import Sequence

from markdown_it.token import Token

from site_builder.book import Example
from site_builder.markdown.blocks import check_options, read_blocks
from site_builder.markdown.fences import Directive
from site_builder.markdown.reading import Reading


def read_example(directive: Directive, body: Sequence[Token], reading: Reading) -> Example | None:
    check_options(directive, (), reading)
    if not directive.argument:
        reading.problem(directive.line, "{example} has no title; legal: ':::{example} Title'")
        return None
    if not body:
        reading.problem(directive.line, "{example} is empty; legal: some text")
        return None
    title_html = reading.inline_html(directive.argument, directive.line)
    return Example(title_html, read_blocks(body, reading))
