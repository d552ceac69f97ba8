"""``{answer} id``: what is shown once the reader has guessed, or asked to see it."""

from collections.abc import Sequence

from site_builder.markdown.bodies import BLOCKS
from site_builder.markdown.directive import Argument, Directive, Use
from site_builder.markdown.questions.question import prediction_id
from site_builder.markdown.reading import Reading
from site_builder.page_model.blocks import Block
from site_builder.page_model.questions import Reveal


def read_reveal(use: Use, _body: Sequence[Block], reading: Reading) -> Reveal:
    name = reading.free_id(f"answer-{use.argument}", use.line)
    asked = (item.name for item in reading.placed.values() if item.id == prediction_id(use))
    return Reveal(use.argument, name, next(asked, ""), reading.path, use.line)


ANSWER = Directive(
    name="answer",
    says="what waits until the guess of that id is made",
    argument=Argument("id", lacks="names no prediction"),
    body=BLOCKS,
    read=read_reveal,
    template="answer",
)
