"""``{ladder-table} Caption``: all measured ladders, a line each."""

from dataclasses import dataclass

from site_builder.benchmarks.measurements import MeasuredLadder, MeasurementError
from site_builder.document.passage import Passage
from site_builder.markdown.bodies import NO_BODY
from site_builder.markdown.directive import LABEL, Argument, Directive, DirectiveCall, Numbered
from site_builder.markdown.inline import inline_passage
from site_builder.markdown.parse_context import ParseContext


@dataclass(frozen=True, slots=True)
class LadderTable:
    """All measured ladders, a line each."""

    rows: tuple[MeasuredLadder, ...]
    caption: Passage


def read_ladder_table(
    call: DirectiveCall, _body: None, context: ParseContext
) -> LadderTable | None:
    try:
        rows = context.shared.measurements.all()
    except MeasurementError as error:
        context.problem(call.line, str(error))
        return None
    return LadderTable(rows, inline_passage(call.argument, call.line, context))


LADDER_TABLE = Directive(
    name="ladder-table",
    doc="all measured ladders",
    argument=Argument("Caption", lacks="has no caption"),
    options=(LABEL,),
    body=NO_BODY,
    read=read_ladder_table,
    template="ladder-table",
    numbered=Numbered("Table", lambda _use: "table-ladders"),
)
