"""``{ray}`the ray```: words in the colour of their idea, as in the figures."""

import re

from markdown_it import MarkdownIt
from markdown_it.rules_inline import StateInline

ROLE = re.compile(r"\{([\w-]+)\}`([^`\n]+)`")


def roles_plugin(parser: MarkdownIt) -> None:
    parser.inline.ruler.before("backticks", "role", _rule)
    parser.inline.add_terminator_char("{")


def _rule(state: StateInline, silent: bool) -> bool:
    match = ROLE.match(state.src, state.pos)
    if not match:
        return False
    if not silent:
        token = state.push("role_open", "span", 1)
        token.attrSet("class", f"role-{match[1]}")
        token.info = match[1]
        state.push("text", "", 0).content = match[2]
        state.push("role_close", "span", -1)
    state.pos = match.end()
    return True
