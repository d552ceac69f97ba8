"""Dashes, ellipses, and no-break spaces before units. (Quotation marks are markdown-it's
``smartquotes``; its ``replacements`` rule is not used, because it would turn an enumeration's
"(c)" into a copyright sign.)"""

import re

from markdown_it.rules_core import StateCore

UNITS = "nm|µm|mm|cm|m|km|px|dB|rad|ms|s|Hz|EV|DN|kB|MB"
"""Units that stay on the line of their number."""

REPLACEMENTS = (
    (re.compile(r"(?<!-)---(?!-)"), "—"),
    (re.compile(r"(?<!-)--(?!-)"), "–"),
    (re.compile(r"(?<!\.)\.\.\.(?!\.)"), "…"),
    (re.compile(rf"(?<=\d) (?=(?:{UNITS})\b)"), "\u00a0"),
)


def typography_rule(state: StateCore) -> None:
    """Replace in running text; code and formulae stay as they are."""
    for block in state.tokens:
        for token in block.children or ():
            if token.type == "text":
                for pattern, character in REPLACEMENTS:
                    token.content = pattern.sub(character, token.content)
