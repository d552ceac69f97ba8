"""``{ladder-table} Caption``: all measured ladders, a line each."""

from dataclasses import dataclass

from site_builder.markdown.bodies import no_body
from site_builder.markdown.directive import LABEL, Argument, Directive, Numbered, Use
from site_builder.markdown.inline import inline_html
from site_builder.markdown.reading import Reading
from site_builder.measured.measurements import MeasuredLadder, MeasurementError


@dataclass(frozen=True, slots=True)
class LadderTable:
    """All measured ladders, a line each."""

    rows: tuple[MeasuredLadder, ...]
    caption_html: str


def read_ladder_table(use: Use, _body: None, reading: Reading) -> LadderTable | None:
    try:
        rows = reading.measurements.all()
    except MeasurementError as error:
        reading.problem(use.line, str(error))
        return None
    return LadderTable(rows, inline_html(use.argument, use.line, reading))


LADDER_TABLE = Directive(
    name="ladder-table",
    says="all measured ladders",
    argument=Argument("Caption", lacks="has no caption"),
    options=(LABEL,),
    body=no_body("a caption behind its name, no more"),
    read=read_ladder_table,
    template="ladder-table",
    numbered=Numbered("Table", lambda _use: "table-ladders"),
)
