"""What an exercise says of itself is true: its solution is right and equals its model, what it
starts with is not, and each wrong answer is wrong and recognised."""

import operator
from dataclasses import asdict
from functools import partial
from time import perf_counter
from typing import Any

from simulations.editing.exercise import Exercise, check_claims, findings, model_miss
from simulations.registry import LADDER_MODULES, load_ladder
from site_builder.cache.hashing import imports_hash
from site_builder.cache.results import cached_result
from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.document.blocks import Quiz
from site_builder.document.book import Book, Chapter
from site_builder.markdown.questions.code.kind import CodeTask
from site_builder.pool.processes import run_in_pool

COMPARED = "equal answers, or an 'assert' behind the cases that compares the two"


def check_exercises(book: Book, problems: Diagnostics) -> None:
    for chapter in book.chapters:
        for quiz in chapter.quizzes:
            if isinstance(quiz.details, CodeTask):
                for line, message in _faults(quiz, quiz.details, chapter):
                    problems.add(quiz.path, line, f"exercise {quiz.id!r}: {message}")


def _faults(quiz: Quiz, task: CodeTask, chapter: Chapter) -> list[tuple[int, str]]:
    figures = [figure.id for figure in chapter.simulations]
    if task.figure and task.figure not in (*figures, *chapter.figures):
        return [(quiz.line, unknown("figure of this page", task.figure, figures))]
    if task.measured:
        tiers = [tier.id for tier in task.measured.ladder.tiers]
        if task.exercise.tier not in tiers:
            return [(quiz.line, unknown("tier", task.exercise.tier, tiers))]
    given = task.exercise, task.starter, _sources(task)
    found = cached_result(
        "faults", given, lambda: _find_faults(task.exercise, task.starter), is_final=operator.not_
    )
    return [(quiz.line if at is None else task.lines[at], message) for at, message in found]


def _sources(task: CodeTask) -> bytes:
    """The hash of the sources of what the exercise runs."""
    exercise = task.exercise
    ladder = LADDER_MODULES.get(exercise.ladder, "")
    modules = [f"import {name}" for name in (exercise.model.partition(":")[0], ladder) if name]
    programs = exercise.check, exercise.adapter, task.starter, exercise.solution, *exercise.wrong
    return imports_hash("\n".join([*modules, *programs]))


def _find_faults(exercise: Exercise, starter: str) -> list[tuple[int | None, str]]:
    """What is wrong, with the number of the answer: 0 for the solution, None for the start."""
    try:
        run_in_pool(partial(check_claims, exercise))
        if miss := _judgement(exercise, exercise.solution, "values")["miss"]:
            return [(0, f"the solution is wrong: {_difference(miss)}; legal: a right one")]
        if exercise.hard:
            _judgement(exercise, exercise.solution, "hard")  # it need not pass them
    except Exception as error:  # whatever the author's code raises
        return [(0, f"the solution fails: {type(error).__name__}: {error}")]
    found: list[tuple[int | None, str]] = []
    try:
        if missed := run_in_pool(partial(model_miss, exercise)):
            message = f"the solution is not its model: {_difference(asdict(missed))}"
            found.append((0, f"{message}; legal: {COMPARED}"))
    except Exception as error:
        message = f"the model fails at a case: {type(error).__name__}: {error}"
        found.append((0, f"{message}; legal: {COMPARED}"))
    if not _is_wrong(exercise, starter):
        found.append((None, "what it starts with is right; legal: a start that is not"))
    for index, code in enumerate(exercise.wrong):
        try:
            miss = _judgement(exercise, code, "values")["miss"]
        except Exception as error:
            found.append((index + 1, f"a wrong answer fails: {type(error).__name__}: {error}"))
            continue
        if not miss:
            found.append((index + 1, "a wrong answer is right; legal: one that a check finds"))
        elif miss["recognised"] != index:
            message = f"a wrong answer is taken for another: {_difference(miss)}"
            found.append((index + 1, f"{message}; legal: answers that differ"))
    return found


def _judgement(exercise: Exercise, code: str, stage: str) -> dict[str, Any]:
    return run_in_pool(partial(findings, exercise, code, stage, load_ladder, perf_counter))


def _is_wrong(exercise: Exercise, code: str) -> bool:
    try:
        return _judgement(exercise, code, "values")["miss"] is not None
    except Exception:  # it need not run
        return True


def _difference(found: dict[str, Any]) -> str:
    return f"{found['call']} is {found['got']}, expected {found['expected']}"
