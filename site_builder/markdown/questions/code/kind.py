"""A function to write: judged by values, by the workload of a ladder and by hard cases.

What it is judged by, and its wrong answers, are Python in the blocks ``starter``, ``check``,
``solution``, ``wrong`` and ``adapter`` of its body; a list gives the hints.
"""

import ast
import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field

from markdown_it.token import Token

from simulations.editing.exercise import Exercise
from site_builder.benchmarks.measurements import MeasuredLadder
from site_builder.diagnostics.diagnostic import unknown
from site_builder.document.blocks import Option, Question
from site_builder.document.places import Passage, passage
from site_builder.files.engine import book_or_engine_file
from site_builder.markdown.directive import DirectiveCall, OptionLine
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.questions.answers import read_answers
from site_builder.markdown.questions.kind import FIGURE_LINE, QuestionBody, QuestionKind
from site_builder.markdown.text.code import PARTS

DEFINITION = r"simulations(\.\w+)+:\w+"


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeTask:
    """What is to be written. Translations have the same, but for words."""

    exercise: Exercise = field(compare=False)
    starter: str = field(compare=False)
    hints: tuple[Passage, ...] = field(compare=False)
    lines: tuple[int, ...] = field(compare=False)
    """Of the solution, and of each wrong answer."""
    measured: MeasuredLadder | None = field(default=None, compare=False)
    figure: str = ""
    """Element id of the figure that can be drawn by the reader's function, and its settings."""
    settings: Mapping[str, str] | None = None


def read_task(
    call: DirectiveCall, body: Sequence[Token], context: ParseContext
) -> QuestionBody | None:
    parts: dict[str, list[Token]] = {name: [] for name in PARTS}
    for token in body:
        if token.type == "fence" and token.info.strip() in PARTS:
            parts[token.info.strip()].append(token)
    rest = [token for token in body if not any(token in part for part in parts.values())]
    hints = read_answers(call, rest, context, kind="ordered", marked=False, replies=False)
    for name in ("starter", "check", "solution"):
        if len(parts[name]) != 1:
            count = len(parts[name]) or "no"
            message = f"exercise {call.argument!r} has {count} '```{name}'; legal: one"
            context.problem(call.line, message, spoils=(f"of quiz {call.argument!r}",))
            return None
    ladder, _, tier = call.text("ladder").partition(" ")
    figure, _, settings = call.text("figure").partition(" ")
    names = re.findall(r"^def (\w+)", parts["starter"][0].content, re.MULTILINE)
    if not names:
        context.problem(call.line, f"exercise {call.argument!r} starts with no function")
        return None
    exercise = Exercise(
        name=names[-1],
        check=parts["check"][0].content,
        solution=parts["solution"][0].content,
        wrong=tuple(token.content for token in parts["wrong"]),
        model=call.text("model"),
        adapter="\n\n".join(token.content for token in parts["adapter"]),
        ladder=ladder,
        tier=tier,
        hard=_hard_cases(call, context),
    )
    answers = (*parts["solution"], *parts["wrong"])
    options = tuple(_option(token, context) for token in answers)
    task = CodeTask(
        exercise=exercise,
        starter=parts["starter"][0].content,
        hints=tuple(hint.words for hint in hints.read),
        lines=tuple(token.map[0] + 1 if token.map else call.line for token in answers),
        measured=context.shared.measurements.find(ladder, "") if ladder else None,
        figure=figure,
        settings=dict(pair.split("=", 1) for pair in settings.split() if "=" in pair),
    )
    judges = [exercise.check, exercise.model, exercise.adapter, call.text("ladder")]
    return QuestionBody(hints.prompt, options, task, decides=[judges, exercise.hard])


def _option(token: Token, context: ParseContext) -> Option:
    """The code, and what its first lines, which are comments, say of it."""
    lines = token.content.splitlines()
    said = [line.removeprefix("# ") for line in lines if line.startswith("# ")]
    right = token.info.strip() == "solution"
    if not right and not said:
        line = token.map[0] + 1 if token.map else 1
        message = "a wrong answer without a word on it; legal: '# …' in its first line"
        context.problem(line, message)
    words = [] if right else [Token("text", "", 0, content=" ".join(said))]
    reply = passage([Token("inline", "", 0, children=words)]) if words else Passage()
    return Option(passage([token]), _without_comments(token.content), right, reply)


def _without_comments(code: str) -> str:
    try:
        return ast.unparse(ast.parse(code))
    except SyntaxError:  # reported when it is tried
        return code


def _hard_cases(call: DirectiveCall, context: ParseContext) -> Mapping[str, object]:
    """The cases of a table whose questions call the function; nothing without a table."""
    table, name = call.text("hard"), call.text("model").partition(":")[2]
    if not table:
        return {}
    path = f"simulations/hard_cases/{table.replace('-', '_')}.toml"
    file = book_or_engine_file(context.shared.root, path)
    if not file.is_file():
        known = sorted(each.stem for each in file.parent.glob("*.toml"))
        context.problem(call.line_of("hard"), unknown("table of hard cases", table, known))
        return {}
    data = tomllib.loads(file.read_text(encoding="utf-8-sig"))
    cases = {
        key: case for key, case in data["cases"].items() if re.search(rf"\b{name}\(", case["call"])
    }
    if not cases:
        message = f"table {table!r} has no case that calls {name!r}; legal: one that has"
        context.problem(call.line_of("hard"), message)
        return {}
    return {**data, "cases": cases}


def _page_data(question: Question) -> Mapping[str, object]:
    task: CodeTask = question.details
    return {
        "program": asdict(task.exercise),
        "starter": task.starter,
        "figure": task.figure,
        "settings": dict(task.settings or {}),
    }


def _cells(question: Question) -> tuple[str, str]:
    """The function to write, with the names that a page gives it; and its checks."""
    task: CodeTask = question.details
    module = task.exercise.model.partition(":")[0]
    names = ("import numpy as np", f"from {module} import *" if module else "")
    return "\n".join((*filter(None, names), "", task.starter)), task.exercise.check


CODE = QuestionKind(
    folder="code",
    doc="a function to write, judged by values, a ladder's workload and hard cases",
    read=read_task,
    quiz=("code",),
    options=(
        OptionLine(
            name="model",
            doc="the book's function for the same, `simulations.models.room.module:function`; the "
            "solution has to equal it in every case, or in an `assert` behind the cases",
            form=DEFINITION,
        ),
        OptionLine(
            name="ladder", doc="a ladder, and its tier of the same method, `ladder-id tier`"
        ),
        OptionLine(name="hard", doc="a table of hard cases"),
        FIGURE_LINE,
    ),
    page_data=_page_data,
    catalogue=lambda question: {"starter": question.details.starter},
    cells=_cells,
    is_program=True,
    needs_page=True,
)
