"""What every question has: an id, options that fit its kind, and answers, some of them right."""

import re
from collections.abc import Mapping, Sequence

from site_builder.markdown.directive import Use
from site_builder.markdown.questions.answers import Parts
from site_builder.markdown.reading import Reading
from site_builder.markdown.text.tokens import plain_text
from site_builder.page_model.questions import Option

ID = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")


def check_id(use: Use, reading: Reading) -> None:
    """Report what is no id."""
    if not ID.fullmatch(use.argument):
        legal = "small letters, digits and hyphens"
        reading.problem(use.line, f"{use.name} id {use.argument!r}; legal: {legal}")


def prediction_id(use: Use) -> str:
    """Element id of the prediction that this is, or is the answer to."""
    return f"predict-{use.argument}"


def check_options_belong(
    use: Use, kind: str, belongs: Mapping[str, tuple[str, ...]], reading: Reading
) -> None:
    """Report options that mean nothing to this kind of question."""
    for name, option in use.options.items():
        kinds = belongs.get(name, (kind,))
        if kind not in kinds:
            legal = " or ".join(f"with ':kind: {each}'" for each in kinds)
            reading.problem(
                option.line, f"option {name!r} of a {kind!r} {use.name}; legal: {legal}"
            )


def prompt_text(parts: Parts) -> str:
    """What is asked, without markup."""
    return " ".join(plain_text(token) for token in parts.prompt if token.type == "inline")


def check_answers(
    use: Use,
    options: Sequence[Option],
    items: int,
    reading: Reading,
    *,
    least: int = 2,
    form: str = "- [ ] …",
    right: str = "one",
) -> bool:
    """Whether ``items`` are enough, one of them is right and no two are alike; what is not so is
    reported. ``right`` says what is legal where several are; nothing: any number of them."""
    what = f"{use.name} {use.argument!r}"
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
    reading.problem(use.line, fault)
    return False
