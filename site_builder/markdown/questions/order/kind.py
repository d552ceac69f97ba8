"""Things to put in order; they are written in the right one."""

import hashlib
from collections.abc import Sequence

from markdown_it.token import Token

from site_builder.document.blocks import Option, Question, Simulation
from site_builder.markdown.directive import DirectiveCall
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.questions.answers import check_answers, read_answers
from site_builder.markdown.questions.kind import QuestionBody, QuestionKind


def read_order(call: DirectiveCall, body: Sequence[Token], context: ParseContext) -> QuestionBody:
    answers = read_answers(call, body, context, kind="ordered", marked=False)
    options = tuple(Option(each.words, each.text, True, each.reply) for each in answers.read)
    check_answers(call, options, answers.count, context, form="1. …", right="")
    return QuestionBody(answers.prompt, options)


def in_any_order(
    question: Question, _figures: Sequence[Simulation] = ()
) -> list[tuple[int, Option]]:
    """The options in an order that gives nothing away and never changes, each with its place in
    the right one."""
    mixed = sorted(
        enumerate(question.options), key=lambda item: hashlib.sha256(item[1].text.encode()).digest()
    )
    places = [place for place, _ in mixed]
    return mixed if places != sorted(places) else mixed[::-1]


ORDER = QuestionKind(
    folder="order",
    doc="things to put in order, written in the right one",
    read=read_order,
    quiz=("order",),
    numbered=True,
    view=in_any_order,
    offered=lambda question: [option for _, option in in_any_order(question)],
)
