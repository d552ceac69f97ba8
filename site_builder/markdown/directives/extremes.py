"""``{extremes} model``: a table of a model's hard cases, computed while the book is built."""

from dataclasses import dataclass
from functools import partial

from simulations.engine.hard_cases import (
    HardCase,
    HardCases,
    answer,
    naive_answer,
    read_table,
    show,
)
from simulations.registry import hard_case_tables
from site_builder.diagnostics.diagnostic import cause
from site_builder.markdown.bodies import NO_BODY
from site_builder.markdown.directive import Argument, Directive, DirectiveCall, Numbered
from site_builder.markdown.parse_context import ParseContext
from site_builder.sandbox.pool import run_limited

FILES = hard_case_tables()


@dataclass(frozen=True, slots=True)
class HardCaseRow:
    """A line of a table: a hard case with every answer computed and put into words."""

    id: str
    call: str
    answer: str
    why: str
    returns: str
    naive: str
    naive_answer: str
    library: str
    library_answer: str


@dataclass(frozen=True, slots=True)
class HardCaseTable:
    """What a model answers at the edge of what it is made for."""

    id: str
    """Element id: ``extremes-`` and the model's."""
    title: str
    rows: tuple[HardCaseRow, ...]


def read_hard_cases(
    call: DirectiveCall, _body: None, context: ParseContext
) -> HardCaseTable | None:
    name = context.placed[call.line].id
    try:
        text = FILES[call.argument].read_text(encoding="utf-8")
        title, rows = run_limited(partial(_computed, call.argument, text))
        return HardCaseTable(name, title, rows)
    except Exception as error:  # whatever its code may raise is the author's to see
        message = f"hard cases {call.argument!r} cannot be computed: {cause(error)}"
        context.problem(call.line, message, error)
        return None


def _computed(table_id: str, text: str) -> tuple[str, tuple[HardCaseRow, ...]]:
    """Title and rows of a table."""
    table = read_table(table_id, text)
    return table.title, tuple(_row(table, case) for case in table.cases)


def _row(table: HardCases, case: HardCase) -> HardCaseRow:
    return HardCaseRow(
        id=case.id,
        call=case.call,
        answer=show(answer(table, case.call)),
        why=case.why,
        returns=case.returns,
        naive=case.naive,
        naive_answer=show(naive_answer(table, case.naive)) if case.naive else "",
        library=case.library,
        library_answer=case.library_answer,
    )


EXTREMES = Directive(
    name="extremes",
    doc="the hard cases of a model",
    argument=Argument("model", "names no table", FILES, "table of extremes"),
    body=NO_BODY,
    read=read_hard_cases,
    template="extremes",
    numbered=Numbered("Table", lambda call: f"extremes-{call.argument}"),
)
