"""``## Words {#id}``: a heading whose element id is given, and not made of its words."""

import re

from markdown_it.rules_core import StateCore

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
