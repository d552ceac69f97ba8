"""A number: right within a tolerance, or one that a known mistake leads to."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from markdown_it.token import Token

from simulations.engine.frame import format_number
from site_builder.benchmarks.judgements import with_unit
from site_builder.document.blocks import OTHERWISE, Option, Prediction, Question
from site_builder.document.places import passage
from site_builder.languages.words import Words
from site_builder.markdown.calculation import number
from site_builder.markdown.directive import DirectiveCall, OptionLine
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.questions.answers import (
    Answer,
    check_answers,
    read_answers,
    report_not_coded,
)
from site_builder.markdown.questions.kind import QuestionBody, QuestionKind


@dataclass(frozen=True, slots=True)
class Measure:
    """What the number is measured in, and how exactly."""

    unit: str
    tolerance: float
    """How far from the right number is right."""

    def tolerance_of(self, option: Option) -> float:
        """Largest distance at which an answer counts as this option; of a wrong one at most half of
        its size, so that no answer nearer to 0 matches it."""
        size = abs(option.value or 0.0)
        return self.tolerance if option.correct else min(self.tolerance, size / 2)


def read_number(call: DirectiveCall, body: Sequence[Token], context: ParseContext) -> QuestionBody:
    is_quiz = call.name == "quiz"
    answers = read_answers(call, body, context, coded=True, replies=is_quiz)
    options, tolerance = _read_options(call, answers.read, context)
    least, form = (2, "- [ ] …") if is_quiz else (1, "- [x] `expression`")
    check_answers(call, options, answers.count, context, least=least, form=form, otherwise=is_quiz)
    measure = Measure(call.text("unit"), tolerance)
    return QuestionBody(answers.prompt, options, measure, decides=tolerance if is_quiz else None)


def _read_options(
    call: DirectiveCall, answers: Sequence[Answer], context: ParseContext
) -> tuple[tuple[Option, ...], float]:
    """The right number and those that known mistakes lead to, computed, and the tolerance."""
    values: list[tuple[Answer, float | None]] = []
    for answer in answers:
        if answer.code:
            value = number(answer.code, answer.line, context)
            values += [(answer, value)] if value is not None else []
        elif answer.text == OTHERWISE and answer.mark == "wrong":
            values.append((answer, None))
        else:
            report_not_coded(call, answer, context)
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


def _text(words: str) -> Token:
    return Token("inline", "", 0, children=[Token("text", "", 0, content=words)])


def _page_data(question: Question) -> Mapping[str, object]:
    tolerance = question.details.tolerance
    if not isinstance(question, Prediction):
        return {"tolerance": tolerance}
    truth = next((option.text for option in question.options if option.correct), "")
    return {"tolerance": tolerance, "truth": truth}


def _catalogue(question: Question) -> Mapping[str, object]:
    measure: Measure = question.details
    if isinstance(question, Prediction):
        return {}
    return {"unit": measure.unit, "tolerance": measure.tolerance}


NUMBER = QuestionKind(
    folder="number",
    doc="a number, with replies to those that known mistakes lead to",
    read=read_number,
    quiz=("number",),
    predict=("number",),
    options=(
        OptionLine(name="unit", doc="of a number"),
        OptionLine(name="within", doc="how far from the right number is right, `0.5` or `2%`"),
    ),
    page_data=_page_data,
    catalogue=_catalogue,
)
