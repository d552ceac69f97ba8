"""``{example} Title``: a worked example."""

from collections.abc import Sequence
from dataclasses import dataclass

from site_builder.document.blocks import Block
from site_builder.document.passage import Passage, Plain
from site_builder.markdown.bodies import BLOCKS
from site_builder.markdown.directive import LABEL, Argument, Directive, DirectiveCall, Numbered
from site_builder.markdown.headings import slug
from site_builder.markdown.inline import inline_passage
from site_builder.markdown.parse_context import ParseContext


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
