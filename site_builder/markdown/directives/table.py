"""``{table} Caption``: a table that has a caption."""

from collections.abc import Sequence
from dataclasses import dataclass

from markdown_it.token import Token

from site_builder.markdown.bodies import plain_tokens
from site_builder.markdown.directive import LABEL, Argument, Body, Directive, Numbered, Use
from site_builder.markdown.headings import slug
from site_builder.markdown.inline import inline_html
from site_builder.markdown.reading import Reading


@dataclass(frozen=True, slots=True)
class Table:
    """A table that has a caption."""

    caption_html: str
    html: str


def _one_table(use: Use, tokens: Sequence[Token], reading: Reading) -> str:
    margin = [token.type for token in tokens if token.level == tokens[0].level]
    if margin != ["table_open", "table_close"]:
        found = "more than a table" if "table_open" in margin else "no table"
        reading.problem(use.line, f"{{table}} holds {found}; legal: one table, nothing else")
    return reading.html(plain_tokens(use, tokens, reading))


def read_table(use: Use, html: str, reading: Reading) -> Table:
    return Table(inline_html(use.argument, use.line, reading), html)


TABLE = Directive(
    name="table",
    says="a table that has a caption",
    argument=Argument("Caption", lacks="has no caption"),
    options=(LABEL,),
    body=Body("one table", _one_table),
    read=read_table,
    template="table",
    numbered=Numbered("Table", lambda use: f"table-{slug(use.argument)}"),
)
