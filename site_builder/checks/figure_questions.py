"""Questions that are answered by setting a figure: each can be, and is not before one begins."""

from collections.abc import Mapping

from simulations.engine.conditions import first_true
from simulations.engine.controls import ControlError, Slider
from simulations.engine.expressions import ExpressionError
from site_builder.diagnostics.diagnostic import Diagnostics, cause, unknown
from site_builder.document.blocks import Simulation
from site_builder.document.book import Chapter
from site_builder.document.questions import Option, Quiz
from site_builder.figures.frames import frame_at
from site_builder.markdown.questions.figure.kind import Task, conditions


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
