"""The answers of a question as its page offers or recognises them: one reader for each kind."""

import math
from collections.abc import Sequence

from markdown_it.token import Token

from simulations.engine.frame import format_number
from site_builder.benchmarks.quantities import with_unit
from site_builder.languages.words import Words
from site_builder.markdown.calculation import number, truth
from site_builder.markdown.directive import DirectiveCall, OptionLine
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.questions.answers import Answer, Item, read_answer
from site_builder.page_model.passage import Passage, passage
from site_builder.page_model.questions import Option

OTHERWISE = "otherwise"
"""The answer that stands for whatever no other recognises."""
UNIT = OptionLine("unit", doc="of a number")
WITHIN = OptionLine("within", doc="how far from the right number is right, `0.5` or `2%`")


def chosen_options(items: Sequence[Item], context: ParseContext) -> tuple[Option, ...]:
    """Answers to choose from, right by their mark or by a condition."""
    answers = (read_answer(item, context) for item in items)
    judged = ((answer, _is_right(answer, context)) for answer in answers if answer)
    return tuple(
        Option(answer.words, answer.text, right, answer.reply)
        for answer, right in judged
        if right is not None
    )


def _is_right(answer: Answer, context: ParseContext) -> bool | None:
    """None, and a report, of a condition that cannot be worked out."""
    if answer.mark != "computed":
        return answer.mark == "right"
    if not answer.code:
        expected = "'- [?] `condition` some text'"
        context.problem(answer.line, f"answer {answer.text!r} has no condition; legal: {expected}")
        return None
    return truth(answer.code, answer.line, context)


def ordered_options(items: Sequence[Item], context: ParseContext) -> tuple[Option, ...]:
    """Things to put in order, in the right one."""
    answers = (read_answer(item, context, marked=False) for item in items)
    return tuple(
        Option(answer.words, answer.text, True, answer.reply) for answer in answers if answer
    )


def state_options(items: Sequence[Item], context: ParseContext) -> tuple[Option, ...]:
    """Conditions on a figure; what is wrong with them shows when the figure is drawn."""
    options: list[Option] = []
    for answer in (read_answer(item, context, coded=True) for item in items):
        if answer and (answer.code or answer.text == OTHERWISE):
            right = answer.mark == "right"
            options.append(Option(Passage(), answer.code or OTHERWISE, right, answer.reply))
        elif answer:
            _not_coded(answer, context)
    return tuple(options)


def number_options(
    call: DirectiveCall, items: Sequence[Item], context: ParseContext, *, replies: bool = True
) -> tuple[tuple[Option, ...], float]:
    """Numbers worked out now, the right one and those that known mistakes lead to, and how far
    from them an answer may be."""
    answers = [read_answer(item, context, coded=True, replies=replies) for item in items]
    values: list[tuple[Answer, float | None]] = []
    for answer in (answer for answer in answers if answer):
        if answer.code:
            value = number(answer.code, answer.line, context)
            values += [(answer, value)] if value is not None else []
        elif answer.text == OTHERWISE and answer.mark == "wrong":
            values.append((answer, None))
        else:
            _not_coded(answer, context)
    right = next((value for answer, value in values if answer.mark == "right"), None)
    tolerance = _tolerance(call, right, context)
    _check_apart(values, tolerance, context)
    options = (_number_option(call, *pair, tolerance, context.shared.words) for pair in values)
    return tuple(options), tolerance


def _number_option(
    call: DirectiveCall, answer: Answer, value: float | None, tolerance: float, words: Words
) -> Option:
    text = OTHERWISE if value is None else number_text(value, tolerance, call.text("unit"), words)
    right = answer.mark == "right"
    return Option(passage([_text(text)]), text, right, answer.reply, value)


def number_text(value: float, tolerance: float, unit: str, words: Words) -> str:
    """The number to the last digit that its tolerance leaves a meaning, with its unit."""
    decimals = max(0, math.ceil(-math.log10(tolerance) - 1e-9)) if tolerance else 2
    return with_unit(words.numeral(format_number(value, decimals)), unit)


def _tolerance(call: DirectiveCall, right: float | None, context: ParseContext) -> float:
    """In the unit of the answer."""
    given = call.options.get("within")
    text = given.text if given else ""
    share = text.endswith("%")
    try:
        tolerance = float(text.removesuffix("%"))
    except ValueError:
        tolerance = -1.0
    if not 0 < tolerance < math.inf:
        expected = "a line ':within: 0.5' or ':within: 2%'"
        what = f"{call.name} {call.argument!r} is right within {text!r}"
        context.problem(given.line if given else call.line, f"{what}; legal: {expected}")
        return 1.0
    return tolerance / 100 * abs(right or 1.0) if share else tolerance


def _check_apart(
    values: Sequence[tuple[Answer, float | None]], tolerance: float, context: ParseContext
) -> None:
    """No two numbers are taken for one another."""
    seen: list[tuple[Answer, float]] = []
    for answer, value in values:
        if value is None:
            continue
        for other, taken in seen:
            if abs(value - taken) <= tolerance:
                context.problem(
                    answer.line,
                    f"{answer.code!r} is {value:g} and {other.code!r} is {taken:g}: within "
                    f"{tolerance:g} they cannot be told apart; legal: numbers that differ by more",
                )
        seen.append((answer, value))


def _not_coded(answer: Answer, context: ParseContext) -> None:
    expected = f"an expression between backticks, or '- [ ] {OTHERWISE}'"
    context.problem(answer.line, f"answer {answer.text!r} is not computed; legal: {expected}")


def _text(words: str) -> Token:
    return Token("inline", "", 0, children=[Token("text", "", 0, content=words)])
