"""What every question has: an id, options that fit its kind, and answers, some of them right."""

import re
from collections.abc import Mapping, Sequence

from site_builder.markdown.directive import DirectiveCall
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.questions.answers import Parts
from site_builder.markdown.text.tokens import plain_text
from site_builder.page_model.questions import Option

ID = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")


def check_id(call: DirectiveCall, context: ParseContext) -> None:
    """Report what is no id."""
    if not ID.fullmatch(call.argument):
        expected = "small letters, digits and hyphens"
        context.problem(call.line, f"{call.name} id {call.argument!r}; legal: {expected}")


def prediction_id(call: DirectiveCall) -> str:
    """Element id of the prediction that this is, or is the answer to."""
    return f"predict-{call.argument}"


def check_options_belong(
    call: DirectiveCall, kind: str, belongs: Mapping[str, tuple[str, ...]], context: ParseContext
) -> None:
    """Report options that mean nothing to this kind of question."""
    for name, option in call.options.items():
        kinds = belongs.get(name, (kind,))
        if kind not in kinds:
            expected = " or ".join(f"with ':kind: {each}'" for each in kinds)
            context.problem(
                option.line, f"option {name!r} of a {kind!r} {call.name}; legal: {expected}"
            )


def prompt_text(parts: Parts) -> str:
    """What is asked, without markup."""
    return " ".join(plain_text(token) for token in parts.prompt if token.type == "inline")


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
