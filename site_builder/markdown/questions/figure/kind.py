"""A figure to set: the answers are conditions on its state."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from markdown_it.token import Token

from site_builder.document.blocks import OTHERWISE, Option, Question, Simulation
from site_builder.document.places import Passage
from site_builder.markdown.directive import DirectiveCall, OptionLine
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.questions.answers import check_answers, read_answers, report_not_coded
from site_builder.markdown.questions.kind import FIGURE_LINE, QuestionBody, QuestionKind


@dataclass(frozen=True, slots=True)
class FigureTask:
    """What is to be set."""

    figure: str
    """Its element id."""
    solution: Mapping[str, str]
    """Settings that are right."""
    line: int
    """Where they stand."""


def read_state(call: DirectiveCall, body: Sequence[Token], context: ParseContext) -> QuestionBody:
    """What is wrong with the conditions is reported when the figure is drawn."""
    answers = read_answers(call, body, context, coded=True)
    options: list[Option] = []
    for answer in answers.read:
        if answer.code or answer.text == OTHERWISE:
            right = answer.mark == "right"
            options.append(Option(Passage(), answer.code or OTHERWISE, right, answer.reply))
        else:
            report_not_coded(call, answer, context)
    check_answers(call, options, answers.count, context, otherwise=True)
    solution, line = _solution(call, context), call.line_of("solution")
    task = FigureTask(call.text("figure"), solution, line)
    return QuestionBody(answers.prompt, tuple(options), task)


def _solution(call: DirectiveCall, context: ParseContext) -> dict[str, str]:
    """``k1=-0.1 k2=0``."""
    pairs = call.text("solution").split()
    if not call.text("figure") or not pairs or not all("=" in pair for pair in pairs):
        expected = "lines ':figure: figure-SCENE' and ':solution: control=value …'"
        message = f"quiz {call.argument!r} cannot be solved; legal: {expected}"
        context.problem(call.line_of("solution"), message)
    return dict(pair.split("=", 1) for pair in pairs if "=" in pair)


def conditions(question: Question) -> list[str]:
    """Conditions of the answers, in order; a state that meets none gets the last answer."""
    return [option.text for option in question.options if option.text != OTHERWISE]


def _catalogue(question: Question) -> Mapping[str, object]:
    task: FigureTask = question.details
    return {"figure": task.figure, "solution": dict(task.solution)}


def _solved(question: Question, figures: Sequence[Simulation]) -> str:
    """Settings that are right, as the figure's controls are labelled."""
    task: FigureTask = question.details
    labels = {
        control.name: control.label
        for figure in figures
        if figure.id == task.figure
        for control in figure.scene.controls
    }
    return ", ".join(f"{labels.get(name, name)} {value}" for name, value in task.solution.items())


FIGURE = QuestionKind(
    folder="figure",
    doc="a figure to set, judged by conditions on its settings and readouts",
    read=read_state,
    quiz=("figure",),
    options=(
        FIGURE_LINE,
        OptionLine(name="solution", doc="settings that solve it, `control=value …`"),
    ),
    page_data=lambda question: {"conditions": conditions(question)},
    catalogue=_catalogue,
    form_data=lambda question: {"figure": question.details.figure},
    view=_solved,
    needs_page=True,
)
