"""``{extremes} model``: the hard cases of a model, asked while the book is built."""

from dataclasses import dataclass

from simulations.engine.extreme import ExtremeCase, ExtremeTable, answer, naive_answer, show
from simulations.extremes.tables import TABLES
from site_builder.markdown.bodies import no_body
from site_builder.markdown.directive import Argument, Directive, Use
from site_builder.markdown.reading import Reading

BY_MODEL = {table.id: table for table in TABLES}


@dataclass(frozen=True, slots=True)
class HardCase:
    """A line of a table of hard cases, every answer computed and put into words."""

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
class Extremes:
    """What a model answers at the edge of what it is made for."""

    id: str
    """Element id: ``extremes-`` and the model's."""
    title: str
    rows: tuple[HardCase, ...]


def read_extremes(use: Use, _body: None, reading: Reading) -> Extremes:
    table = BY_MODEL[use.argument]
    name = reading.take_id(f"extremes-{table.id}", use.line, "table")
    return Extremes(name, table.title, tuple(_row(table, case) for case in table.cases))


def _row(table: ExtremeTable, case: ExtremeCase) -> HardCase:
    return HardCase(
        id=case.id,
        call=case.call,
        answer=show(answer(table, case)),
        why=case.why,
        returns=case.returns,
        naive=case.naive,
        naive_answer=show(naive_answer(table, case)) if case.naive else "",
        library=case.library.call if case.library else "",
        library_answer=case.library.answer if case.library else "",
    )


EXTREMES = Directive(
    name="extremes",
    says="the hard cases of a model",
    argument=Argument("model", legal=tuple(BY_MODEL), kind="table of extremes"),
    body=no_body("the table speaks alone"),
    read=read_extremes,
    template="extremes",
)
