"""Warnings of questions that give their keys away by length.

A key that is longer than every other answer, because only the truth was hedged and explained, is
the best known of the cues by which people answer who know nothing (Haladyna, Downing and Rodriguez,
*A review of multiple-choice item-writing guidelines*, 2002). The next, a favourite place, is none
here: each reader gets an order of their own. Questions with several keys are left alone.
"""

from collections.abc import Mapping

from simulations.engine.conditions import first_true
from simulations.engine.controls import ControlError, Slider
from simulations.engine.expressions import ExpressionError
from site_builder.diagnostics.diagnostic import Diagnostics, cause, unknown
from site_builder.document.blocks import Simulation
from site_builder.document.book import Book, Chapter
from site_builder.document.questions import Option, Quiz
from site_builder.figures.frames import frame_at
from site_builder.markdown.questions.figure.kind import Task, conditions
from site_builder.render.words import plain_words

STANDS_OUT = 1.4
"""How many times as long as the longest wrong answer a key may be, or the shortest wrong answer as
the key: lines of one paragraph differ as much, so up to there it is not seen at a glance."""
FEW_LETTERS = 12
"""Two words: among short answers a smaller difference has no meaning, whatever its ratio."""


def check_questions(book: Book, problems: Diagnostics) -> None:
    """Warn of each key that stands out."""
    for chapter in book.chapters:
        for quiz in single_choice(chapter):
            faults = filter(None, map(fault_of_length, quiz.variants))
            if message := next(faults, ""):
                problems.warn(quiz.path, quiz.line, message)


def single_choice(chapter: Chapter) -> list[Quiz]:
    """The questions with exactly one key, and something else to choose."""
    return [
        quiz
        for quiz in chapter.quizzes
        if quiz.kind == "single" and len(quiz.options) > 1
        if sum(option.correct for option in quiz.options) == 1
    ]


def letters(option: Option) -> int:
    """Length of an answer as it is read: a formula counts what it shows, not its source."""
    return len(plain_words(option.words).strip())


def fault_of_length(quiz: Quiz) -> str:
    """What the key's length gives away, or nothing."""
    key, *wrong = [letters(option) for option in sorted(quiz.options, key=lambda o: not o.correct)]
    for what, other, short, long in (
        ("longest", max(wrong), max(wrong), key),
        ("shortest", min(wrong), key, min(wrong)),
    ):
        if long > STANDS_OUT * short and long - short >= FEW_LETTERS:
            return (
                f"the key of quiz {quiz.id!r} stands out: its length is {key}, that of the {what} "
                f"wrong answer {other}; better: within a factor of {STANDS_OUT:g}"
            )
    return ""


def check_figure_questions(chapter: Chapter, problems: Diagnostics) -> None:
    """The solution that the author states is right by the conditions, and the start is not."""
    figures = {figure.id: figure for figure in chapter.simulations}
    for quiz in chapter.quizzes:
        task = quiz.details
        if not isinstance(task, Task) or not task.figure or not task.solution:
            continue
        figure = figures.get(task.figure)
        error = None
        if figure:
            try:
                message = fault_of(quiz, task.solution, figure)
            except Exception as raised:  # whatever a scene's own code may raise
                error = raised
                message = f"quiz {quiz.id!r}: {figure.scene.id!r} cannot be drawn: {cause(raised)}"
        elif task.figure in chapter.figures:  # reported where it is
            message = ""
        else:
            message = unknown("figure of this page", task.figure, chapter.figures)
        if message:
            problems.add(quiz.path, quiz.line, message, error)


def fault_of(quiz: Quiz, solution: Mapping[str, str], figure: Simulation) -> str:
    """What is wrong with the question, or nothing. Raises whatever the scene does."""
    what = f"quiz {quiz.id!r}"
    stated = " ".join(f"{name}={value}" for name, value in solution.items())
    try:
        if message := _unreachable(solution, figure):
            return f"{what}: {message}"
        if not reply_at(quiz, figure, {**figure.values, **solution}).correct:
            return f"{what} is not solved by {stated!r}; legal: settings that its [x] is true of"
        if reply_at(quiz, figure, figure.values).correct:
            return f"{what} is solved before it is asked; legal: a start that its [x] is false of"
    except (ControlError, ExpressionError) as error:
        return f"{what}: {error}"
    return ""


def _unreachable(solution: Mapping[str, str], figure: Simulation) -> str:
    """The stated setting that no slider can show, if there is one."""
    for control in figure.scene.controls:
        value = solution.get(control.name)
        if isinstance(control, Slider) and value and not control.reaches(control.check(value)):
            expected = f"{control.minimum:g} and steps of {control.step:g}"
            return f"{control.name}: {value} is between two steps; legal: {expected}"
    return ""


def reply_at(quiz: Quiz, figure: Simulation, values: Mapping[str, object]) -> Option:
    """The answer that holds at these settings. Raises `ControlError`, `ExpressionError`."""
    settings = figure.scene.check(values)
    frame = frame_at(figure.scene, settings, figure.tier)
    asked = conditions(quiz)
    met = first_true(asked, settings, frame)
    return quiz.options[len(asked) if met is None else met]
