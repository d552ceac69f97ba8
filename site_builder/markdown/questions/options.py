"""The answers of a question as its page offers or recognises them: one reader for each kind."""

import math
from collections.abc import Sequence

from simulations.engine.frame import format_number
from site_builder.languages.words import Words
from site_builder.markdown.directive import OptionLine, Use
from site_builder.markdown.questions.answers import Answer, Item, read_answer
from site_builder.markdown.questions.computed import names_for, number, truth
from site_builder.markdown.reading import Reading
from site_builder.measured.quantities import with_unit
from site_builder.page_model.questions import Option

OTHERWISE = "otherwise"
"""The answer that stands for whatever no other recognises."""
USES = OptionLine("uses", says="functions that its expressions call, `package.module:function`")
UNIT = OptionLine("unit", says="of a number")
WITHIN = OptionLine("within", says="how far from the right number is right, `0.5` or `2%`")


def chosen_options(use: Use, items: Sequence[Item], reading: Reading) -> tuple[Option, ...]:
    """Answers to choose from, right by their mark or by a condition."""
    names = names_for(use, reading)
    answers = (read_answer(item, reading) for item in items)
    judged = ((answer, _is_right(answer, names, reading)) for answer in answers if answer)
    return tuple(
        Option(answer.html, answer.text, right, answer.reply_html)
        for answer, right in judged
        if right is not None
    )


def _is_right(answer: Answer, names: dict[str, object], reading: Reading) -> bool | None:
    """None, and a report, of a condition that cannot be worked out."""
    if answer.mark != "computed":
        return answer.mark == "right"
    if not answer.code:
        legal = "'- [?] `condition` some text'"
        reading.problem(answer.line, f"answer {answer.text!r} has no condition; legal: {legal}")
        return None
    return truth(answer.code, names, answer.line, reading)


def ordered_options(items: Sequence[Item], reading: Reading) -> tuple[Option, ...]:
    """Things to put in order, in the right one."""
    answers = (read_answer(item, reading, marked=False) for item in items)
    return tuple(
        Option(answer.html, answer.text, True, answer.reply_html) for answer in answers if answer
    )


def state_options(items: Sequence[Item], reading: Reading) -> tuple[Option, ...]:
    """Conditions on a figure; what is wrong with them shows when the figure is drawn."""
    options: list[Option] = []
    for answer in (read_answer(item, reading, coded=True) for item in items):
        if answer and (answer.code or answer.text == OTHERWISE):
            right = answer.mark == "right"
            options.append(Option("", answer.code or OTHERWISE, right, answer.reply_html))
        elif answer:
            _not_coded(answer, reading)
    return tuple(options)


def number_options(
    use: Use, items: Sequence[Item], reading: Reading, *, replies: bool = True
) -> tuple[tuple[Option, ...], float]:
    """Numbers worked out now, the right one and those that known mistakes lead to, and how far
    from them an answer may be."""
    names = names_for(use, reading)
    answers = [read_answer(item, reading, coded=True, replies=replies) for item in items]
    values: list[tuple[Answer, float | None]] = []
    for answer in (answer for answer in answers if answer):
        if answer.code:
            value = number(answer.code, names, answer.line, reading)
            values += [(answer, value)] if value is not None else []
        elif answer.text == OTHERWISE and answer.mark == "wrong":
            values.append((answer, None))
        else:
            _not_coded(answer, reading)
    right = next((value for answer, value in values if answer.mark == "right"), None)
    tolerance = _tolerance(use, right, reading)
    _check_apart(values, tolerance, reading)
    options = (_number_option(use, *pair, tolerance, reading.words) for pair in values)
    return tuple(options), tolerance


def _number_option(
    use: Use, answer: Answer, value: float | None, tolerance: float, words: Words
) -> Option:
    text = OTHERWISE if value is None else number_text(value, tolerance, use.text("unit"), words)
    right = answer.mark == "right"
    return Option(text, text, right, answer.reply_html, value)


def number_text(value: float, tolerance: float, unit: str, words: Words) -> str:
    """The number to the last digit that its tolerance leaves a meaning, with its unit."""
    decimals = max(0, math.ceil(-math.log10(tolerance) - 1e-9)) if tolerance else 2
    return with_unit(words.numeral(format_number(value, decimals)), unit)


def _tolerance(use: Use, right: float | None, reading: Reading) -> float:
    """In the unit of the answer."""
    given = use.options.get("within")
    text = given.text if given else ""
    share = text.endswith("%")
    try:
        tolerance = float(text.removesuffix("%"))
    except ValueError:
        tolerance = -1.0
    if not 0 < tolerance < math.inf:
        legal = "a line ':within: 0.5' or ':within: 2%'"
        what = f"{use.name} {use.argument!r} is right within {text!r}"
        reading.problem(given.line if given else use.line, f"{what}; legal: {legal}")
        return 1.0
    return tolerance / 100 * abs(right or 1.0) if share else tolerance


def _check_apart(
    values: Sequence[tuple[Answer, float | None]], tolerance: float, reading: Reading
) -> None:
    """No two numbers are taken for one another."""
    seen: list[tuple[Answer, float]] = []
    for answer, value in values:
        if value is None:
            continue
        for other, taken in seen:
            if abs(value - taken) <= tolerance:
                reading.problem(
                    answer.line,
                    f"{answer.code!r} is {value:g} and {other.code!r} is {taken:g}: within "
                    f"{tolerance:g} they cannot be told apart; legal: numbers that differ by more",
                )
        seen.append((answer, value))


def _not_coded(answer: Answer, reading: Reading) -> None:
    legal = f"an expression between backticks, or '- [ ] {OTHERWISE}'"
    reading.problem(answer.line, f"answer {answer.text!r} is not computed; legal: {legal}")
