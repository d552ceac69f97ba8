"""``{tabs}`` and, in it, ``{tab} Title``: the same thing in several ways, one on show at a time.

On paper, and where no script runs, they stand one below the other.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from markdown_it.token import Token

from site_builder.markdown.blocks import read_blocks
from site_builder.markdown.bodies import BLOCKS
from site_builder.markdown.directive import Argument, Body, Directive, DirectiveCall
from site_builder.markdown.headings import slug
from site_builder.markdown.inline import inline_passage
from site_builder.markdown.parse_context import ParseContext
from site_builder.page_model.blocks import Block
from site_builder.page_model.passage import Passage, Plain

LEGAL = "two or more ':::{tab} Title'"


@dataclass(frozen=True, slots=True)
class Tabs:
    """Alternatives; each is a `Tab` in a block inside."""


@dataclass(frozen=True, slots=True)
class Tab:
    """One of several alternatives; what it says is in the blocks inside."""

    id: str
    """Element id."""
    title: Passage


def _read_tabs_body(
    call: DirectiveCall, tokens: Sequence[Token], context: ParseContext
) -> tuple[Block, ...]:
    margin = [token for token in tokens if token.level == tokens[0].level]
    openings = [token for token in margin if token.type == "directive_open"]
    tabs = [token for token in openings if _name(token) == "tab"]
    for token in margin:
        if token.nesting >= 0 and token not in tabs:
            what = f"directive {{{_name(token)}}}" if token in openings else "text"
            line = (token.map or [call.line - 1])[0] + 1
            context.problem(line, f"{what} between the tabs of {{tabs}}; legal: {LEGAL}")
    if len(tabs) < 2:
        count = "one" if tabs else "no"
        context.problem(call.line, f"{{tabs}} with {count} tab; legal: {LEGAL}")
    context.tabs.update(token.meta["call"].line for token in tabs)
    return read_blocks(tokens, context)


def _name(token: Token) -> str:
    call: DirectiveCall = token.meta["call"]
    return call.name


def read_tabs(_use: DirectiveCall, _body: Sequence[Block], _reading: ParseContext) -> Tabs:
    return Tabs()


def read_tab(call: DirectiveCall, _body: Sequence[Block], context: ParseContext) -> Tab | None:
    if call.line not in context.tabs:
        context.problem(call.line, "{tab} outside of {tabs}; legal: inside ':::{tabs}'")
        return None
    name = context.free_id(f"tab-{slug(call.argument)}", call.line)
    return Tab(name, inline_passage(call.argument, call.line, context))


TABS = Directive(
    name="tabs",
    doc="alternatives, of which the reader chooses one",
    argument=None,
    body=Body(LEGAL.replace("':::{tab} Title'", "`{tab}`"), _read_tabs_body, nests=True),
    read=read_tabs,
    template="tabs",
    plain=lambda _tabs: Plain(),
)
TAB = Directive(
    name="tab",
    doc="one of them",
    argument=Argument("Title", lacks="has no title"),
    body=BLOCKS,
    read=read_tab,
    template="tab",
    plain=lambda tab: Plain((tab.title,)),
)
