"""What the answers of a question must be."""

from collections.abc import Sequence

from site_builder.document.questions import OTHERWISE, Option
from site_builder.markdown.directive import DirectiveCall
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.questions.answers import Answer


def check_answers(
    call: DirectiveCall,
    options: Sequence[Option],
    items: int,
    context: ParseContext,
    *,
    least: int = 2,
    form: str = "- [ ] …",
    right: str = "one",
) -> bool:
    """Whether ``items`` are enough, one of them is right and no two are alike; what is not so is
    reported. ``right`` says what is legal where several are; nothing: any number of them."""
    what = f"{call.name} {call.argument!r}"
    correct = sum(option.correct for option in options)
    if items < least:
        fault = f"{what} has {items} answers; legal: a list of {least} or more '{form}'"
    elif len(options) < items:
        return False  # a mistake already reported would be counted twice
    elif correct == 0:
        fault = f"{what} has no right answer; mark one with [x]"
    elif correct > 1 and right:
        fault = f"{what} has {correct} right answers; legal: {right}"
    elif len({option.text for option in options}) < len(options):
        fault = f"{what} gives the same answer twice; legal: answers that differ"
    else:
        return True
    context.problem(call.line, fault)
    return False


def check_otherwise(call: DirectiveCall, options: Sequence[Option], context: ParseContext) -> None:
    """The last answer is the reply to whatever no other recognises."""
    if options[-1].text != OTHERWISE:
        what = f"{call.name} {call.argument!r} has no reply to other answers"
        expected = f"'- [ ] {OTHERWISE}' at the end, with a ': …' line below it"
        context.problem(call.line, f"{what}; legal: {expected}")


def report_not_coded(answer: Answer, context: ParseContext) -> None:
    expected = f"an expression between backticks, or '- [ ] {OTHERWISE}'"
    context.problem(answer.line, f"answer {answer.text!r} is not computed; legal: {expected}")
