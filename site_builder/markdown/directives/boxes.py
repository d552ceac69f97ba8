"""``{note}``, ``{tip}``, ``{warning}``, ``{key-idea}`` and ``{example}``, boxes with titles, and
boxes that a book adds; and ``{table}``, a table that has a caption."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from markdown_it.token import Token

from site_builder.document.blocks import Block
from site_builder.document.places import Passage, Plain, passage
from site_builder.markdown.annotation import inline_passage
from site_builder.markdown.block_tree import BLOCKS, plain_tokens
from site_builder.markdown.directive import (
    LABEL,
    Argument,
    Body,
    Directive,
    DirectiveCall,
    Numbered,
)
from site_builder.markdown.numbering import slug
from site_builder.markdown.parse_context import ParseContext

KINDS = {
    "tip": "an aside that helps",
    "note": "an aside that adds",
    "warning": "an aside that warns",
    "key-idea": "what to remember",
}
"""Kinds of callout, which are their classes in the style sheet, and what each makes."""


@dataclass(frozen=True, slots=True)
class Box:
    """A callout or a worked example, whose text is in the blocks inside; or a table."""

    kind: str
    """Name of the directive."""
    title: Passage
    table: Passage


def read_box(call: DirectiveCall, body: Sequence[Block] | Passage, context: ParseContext) -> Box:
    """With the title that the language has, where the author gives none."""
    title = call.argument or context.shared.words(f"callout.{call.name}")
    table = body if isinstance(body, Passage) else Passage()
    return Box(call.name, inline_passage(title, call.line, context), table)


def _one_table(call: DirectiveCall, tokens: Sequence[Token], context: ParseContext) -> Passage:
    margin = [token.type for token in tokens if token.level == tokens[0].level]
    if margin != ["table_open", "table_close"]:
        found = "more than a table" if "table_open" in margin else "no table"
        context.problem(call.line, f"{{table}} holds {found}; legal: one table, nothing else")
    return passage(plain_tokens(call, tokens, context))


CALLOUTS = tuple(
    Directive(
        name=name,
        doc=doc,
        argument=Argument("Title"),
        body=BLOCKS,
        read=read_box,
        template="callout",
        plain=lambda _callout: Plain(),
    )
    for name, doc in KINDS.items()
)
EXAMPLE = Directive(
    name="example",
    doc="a worked number",
    argument=Argument("Title", lacks="has no title"),
    options=(LABEL,),
    body=BLOCKS,
    read=read_box,
    template="example",
    numbered=Numbered("Example", lambda call: f"example-{slug(call.argument)}"),
    plain=lambda example: Plain((example.title,)),
)
TABLE = Directive(
    name="table",
    doc="a table that has a caption",
    argument=Argument("Caption", lacks="has no caption"),
    options=(LABEL,),
    body=Body("one table", _one_table),
    read=read_box,
    template="table",
    numbered=Numbered("Table", lambda call: f"table-{slug(call.argument)}"),
    plain=lambda table: Plain((table.title, table.table)),
)


def book_boxes(titles: Mapping[str, str]) -> Iterator[Directive[Any]]:
    """The directives that a book adds by ``[boxes]`` in ``book.toml``: notes that are numbered and
    begin with these titles, which are given by the names of the directives."""
    (note,) = (callout for callout in CALLOUTS if callout.name == "note")
    for name, title in titles.items():
        numbered = Numbered(name, _box_id, again=True, label=title)
        yield replace(note, name=name, options=(LABEL,), numbered=numbered, read=_read_book_box)


def _box_id(call: DirectiveCall) -> str:
    return f"{call.name}-{slug(call.argument)}" if call.argument else call.name


def _read_book_box(
    call: DirectiveCall, _body: Sequence[Block] | Passage, context: ParseContext
) -> Box:
    return Box("note", inline_passage(call.argument, call.line, context), Passage())
