"""``{table} Caption``: a table that has a caption."""

from collections.abc import Sequence
from dataclasses import dataclass

from markdown_it.token import Token

from site_builder.document.passage import Passage, Plain, passage
from site_builder.markdown.bodies import plain_tokens
from site_builder.markdown.directive import (
    LABEL,
    Argument,
    Body,
    Directive,
    DirectiveCall,
    Numbered,
)
from site_builder.markdown.headings import slug
from site_builder.markdown.inline import inline_passage
from site_builder.markdown.parse_context import ParseContext


@dataclass(frozen=True, slots=True)
class Table:
    """A table that has a caption."""

    caption: Passage
    table: Passage


def _one_table(call: DirectiveCall, tokens: Sequence[Token], context: ParseContext) -> Passage:
    margin = [token.type for token in tokens if token.level == tokens[0].level]
    if margin != ["table_open", "table_close"]:
        found = "more than a table" if "table_open" in margin else "no table"
        context.problem(call.line, f"{{table}} holds {found}; legal: one table, nothing else")
    return passage(plain_tokens(call, tokens, context))


def read_table(call: DirectiveCall, table: Passage, context: ParseContext) -> Table:
    return Table(inline_passage(call.argument, call.line, context), table)


TABLE = Directive(
    name="table",
    doc="a table that has a caption",
    argument=Argument("Caption", lacks="has no caption"),
    options=(LABEL,),
    body=Body("one table", _one_table),
    read=read_table,
    template="table",
    numbered=Numbered("Table", lambda call: f"table-{slug(call.argument)}"),
    plain=lambda table: Plain((table.caption, table.table)),
)
