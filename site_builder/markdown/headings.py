"""Headings: a place in the table of contents for each; those out of order reported."""

import re
import unicodedata
from collections.abc import Sequence
from itertools import pairwise

from markdown_it.rules_core import StateCore
from markdown_it.token import Token

from site_builder.document.passage import passage
from site_builder.document.places import Heading
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.text.tokens import plain_text

GIVEN = re.compile(r"\s*(?<!\\)\{#([^\s{}]+)\}\s*$")


def heading_ids_rule(state: StateCore) -> None:
    """Take the id from the end of each heading's words into the ``meta`` of its opening token."""
    for opening, inline in zip(state.tokens, state.tokens[1:], strict=False):
        last = inline.children[-1] if opening.type == "heading_open" and inline.children else None
        if last is None or last.type != "text" or not (found := GIVEN.search(last.content)):
            continue
        opening.meta["id"] = found[1]
        last.content = last.content[: found.start()]
        inline.content = GIVEN.sub("", inline.content)


def list_headings(tokens: Sequence[Token], context: ParseContext) -> None:
    """Give the page its list of headings, which have their ids."""
    for opening, inline in pairwise(tokens):
        if opening.type != "heading_open":
            continue
        line, level = (opening.map or [0])[0] + 1, int(opening.tag[1])
        text = plain_text(inline)
        if not text:
            context.problem(line, "heading without words; legal: '## Some words'")
        if opening.markup in ("-", "="):
            expected = f"'## {text}', or an empty line above the rule"
            context.problem(line, f"{text!r} underlined is a heading; legal: {expected}")
        _check_level(level, text, line, context)
        name = str(opening.attrGet("id"))
        context.headings.append(Heading(level, name, passage(_without_links(inline))))


def _check_level(level: int, text: str, line: int, context: ParseContext) -> None:
    previous = context.headings[-1].level if context.headings else 1
    if level == 1:
        context.problem(line, f"heading '# {text}'; legal: '##' and deeper, below the title")
    elif level > previous + 1:
        expected = f"{'#' * (previous + 1)!r} or higher"
        context.problem(
            line, f"heading of level {level} below one of level {previous}; legal: {expected}"
        )


def _without_links(inline: Token) -> list[Token]:
    """A heading as it may stand inside a link of the table of contents."""
    children = [
        child
        for child in inline.children or ()
        if child.type not in ("link_open", "link_close", "footnote_ref")
        and not (child.tag == "a" and child.type in ("role_open", "role_close"))
    ]
    return [Token("inline", "", 0, children=children)]


def slug(text: str) -> str:
    """Words of a heading as an id: lower case, letters with their marks and digits, joined by
    hyphens.

    >>> slug("Zoë’s हिन्दी, or 2")
    'zoë-s-हिन्दी-or-2'
    """
    letters = unicodedata.normalize("NFC", text.lower())
    kept = (c if c.isalnum() or unicodedata.category(c)[0] == "M" else "-" for c in letters)
    return re.sub("-+", "-", "".join(kept)).strip("-") or "section"
