"""``{note}``, ``{tip}``, ``{warning}`` and ``{key-idea}``: asides, with a title."""

from collections.abc import Sequence
from dataclasses import dataclass

from site_builder.document.blocks import Block
from site_builder.document.passage import Passage, Plain
from site_builder.markdown.bodies import BLOCKS
from site_builder.markdown.directive import Argument, Directive, DirectiveCall
from site_builder.markdown.inline import inline_passage
from site_builder.markdown.parse_context import ParseContext

KINDS = {
    "tip": "an aside that helps",
    "note": "an aside that adds",
    "warning": "an aside that warns",
    "key-idea": "what to remember",
}
"""Kinds of callout, which are their classes in the style sheet, and what each makes."""


@dataclass(frozen=True, slots=True)
class Callout:
    """An aside; its text is in the blocks inside."""

    kind: str
    title: Passage


def read_callout(call: DirectiveCall, _body: Sequence[Block], context: ParseContext) -> Callout:
    """With the title that the language has, where the author gives none."""
    title = call.argument or context.shared.words(f"callout.{call.name}")
    return Callout(call.name, inline_passage(title, call.line, context))


CALLOUTS = tuple(
    Directive(
        name=name,
        doc=doc,
        argument=Argument("Title"),
        body=BLOCKS,
        read=read_callout,
        template="callout",
        plain=lambda _callout: Plain(),
    )
    for name, doc in KINDS.items()
)
