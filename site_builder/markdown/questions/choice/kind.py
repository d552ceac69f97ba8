"""Answers to choose from: one that is right, or several."""

from collections.abc import Sequence

from markdown_it.token import Token

from site_builder.document.blocks import Option
from site_builder.markdown.calculation import truth
from site_builder.markdown.directive import DirectiveCall
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.questions.answers import Answer, check_answers, read_answers
from site_builder.markdown.questions.kind import QuestionBody, QuestionKind

SEVERAL = "multiple"
"""The name of a question that may have several right answers."""

MOST_RIGHT = 10
"""Of more, Moodle has no grade that all of them add up from."""


def read_choice(call: DirectiveCall, body: Sequence[Token], context: ParseContext) -> QuestionBody:
    answers = read_answers(call, body, context)
    judged = ((answer, _is_right(answer, context)) for answer in answers.read)
    options = tuple(
        Option(answer.words, answer.text, right, answer.reply)
        for answer, right in judged
        if right is not None
    )
    one = f"one, or ':kind: {SEVERAL}'" if call.name == "quiz" else "one"
    right = "" if call.text("kind") == SEVERAL else one
    check_answers(call, options, answers.count, context, right=right)
    if (count := sum(option.correct for option in options)) > MOST_RIGHT:
        message = f"{count} right answers, whose shares no platform has; better: {MOST_RIGHT}"
        context.problems.warn(context.path, call.line, f"quiz {call.argument!r} has {message}")
    return QuestionBody(answers.prompt, options)


def _is_right(answer: Answer, context: ParseContext) -> bool | None:
    """Judge by mark or condition; None, and a report, where it cannot be computed."""
    if answer.mark != "computed":
        return answer.mark == "right"
    if not answer.code:
        expected = "'- [?] `condition` some text'"
        context.problem(answer.line, f"answer {answer.text!r} has no condition; legal: {expected}")
        return None
    return truth(answer.code, answer.line, context)


CHOICE = QuestionKind(
    folder="choice",
    doc="answers to choose from: one is right or, of `multiple`, any number of them",
    read=read_choice,
    quiz=("single", SEVERAL),
    predict=("choice",),
    offered=lambda question: question.options,
)
