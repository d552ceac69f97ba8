"""``{answer} id``: what is hidden until the reader has guessed, or asked to see it."""

from collections.abc import Sequence

from site_builder.document.blocks import Block
from site_builder.document.questions import Reveal
from site_builder.markdown.bodies import BLOCKS
from site_builder.markdown.directive import Argument, Directive, DirectiveCall
from site_builder.markdown.parse_context import ParseContext


def read_reveal(call: DirectiveCall, _body: Sequence[Block], context: ParseContext) -> Reveal:
    name = context.free_id(f"answer-{call.argument}", call.line)
    return Reveal(call.argument, name, context.path, call.line)


ANSWER = Directive(
    name="answer",
    doc="what is hidden until the prediction of that id is answered",
    argument=Argument("id", lacks="names no prediction"),
    body=BLOCKS,
    read=read_reveal,
    template="answer",
)
