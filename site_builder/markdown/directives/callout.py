"""``{tip}``, ``{note}``, ``{warning}``, ``{key-idea}``, ``{predict}``: asides, with a title."""

from collections.abc import Sequence

from markdown_it.token import Token

from site_builder.book import Callout
from site_builder.markdown.blocks import check_options, read_blocks
from site_builder.markdown.fences import Directive
from site_builder.markdown.reading import Reading

TITLES = {
    "tip": "Tip",
    "note": "Note",
    "warning": "Warning",
    "key-idea": "Key idea",
    "predict": "Predict, then try",
}
"""Kinds of callout, and the title of each where the author gives none."""


def read_callout(directive: Directive, body: Sequence[Token], reading: Reading) -> Callout | None:
    check_options(directive, (), reading)
    if not body:
        reading.problem(directive.line, f"{{{directive.name}}} is empty; legal: some text")
        return None
    title = directive.argument or TITLES[directive.name]
    title_html = reading.inline_html(title, directive.line)
    return Callout(directive.name, title_html, read_blocks(body, reading))
