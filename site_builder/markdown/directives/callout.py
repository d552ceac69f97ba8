"""``{note}``, ``{tip}``, ``{warning}``, ``{key-idea}`` and ``{example}``: boxes with titles."""

from collections.abc import Sequence
from dataclasses import dataclass

from site_builder.document.blocks import Block
from site_builder.document.passage import Passage, Plain
from site_builder.markdown.bodies import BLOCKS
from site_builder.markdown.directive import LABEL, Argument, Directive, DirectiveCall, Numbered
from site_builder.markdown.headings import slug
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


@dataclass(frozen=True, slots=True)
class Example:
    """A worked example; its text is in the blocks inside."""

    title: Passage


def read_example(call: DirectiveCall, _body: Sequence[Block], context: ParseContext) -> Example:
    return Example(inline_passage(call.argument, call.line, context))


EXAMPLE = Directive(
    name="example",
    doc="a worked number",
    argument=Argument("Title", lacks="has no title"),
    options=(LABEL,),
    body=BLOCKS,
    read=read_example,
    template="example",
    numbered=Numbered("Example", lambda call: f"example-{slug(call.argument)}"),
    plain=lambda example: Plain((example.title,)),
)
