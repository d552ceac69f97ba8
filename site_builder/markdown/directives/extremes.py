"""``{extremes} model``: the hard cases of a model, asked while the book is built."""

from collections.abc import Sequence

from markdown_it.token import Token

from simulations.engine.extreme import ExtremeCase, ExtremeTable, answer, naive_answer, show
from simulations.extremes.tables import TABLES
from site_builder.book import HardCase, HardCases
from site_builder.diagnostics import unknown
from site_builder.markdown.blocks import check_options
from site_builder.markdown.fences import Directive
from site_builder.markdown.reading import Reading


def read_extremes(
    directive: Directive, body: Sequence[Token], reading: Reading
) -> HardCases | None:
    check_options(directive, (), reading)
    if body:
        reading.problem(directive.line, "{extremes} with a body; legal: the table speaks alone")
    tables = {table.id: table for table in TABLES}
    if directive.argument not in tables:
        reading.problem(directive.line, unknown("table of extremes", directive.argument, tables))
        return None
    table = tables[directive.argument]
    name = reading.take_id(f"extremes-{table.id}", directive.line, "table")
    return HardCases(name, table.title, tuple(_row(table, case) for case in table.cases))


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
