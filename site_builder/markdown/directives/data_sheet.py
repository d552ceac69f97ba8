"""``{data-sheet}``: the results of all instruments of the page in one table, to print and to save;
the body is what the reader should know of it."""

from dataclasses import dataclass

from site_builder.document.passage import Passage, Plain
from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import Directive, DirectiveCall
from site_builder.markdown.parse_context import ParseContext


@dataclass(frozen=True, slots=True)
class DataSheet:
    """Where the results stand."""

    words: Passage
    """May be empty."""


def read_data_sheet(_call: DirectiveCall, words: Passage, _context: ParseContext) -> DataSheet:
    return DataSheet(words)


DATA_SHEET = Directive(
    name="data-sheet",
    doc="the results of the instruments of a page",
    argument=None,
    body=CAPTION,
    read=read_data_sheet,
    template="data-sheet",
    plain=lambda sheet: Plain((sheet.words,)),
)
