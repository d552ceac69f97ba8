"""Roles whose words become other words, such as ``{measured}`srgb exact native```: the author
asks, and what stands in the text is looked up or computed."""

import re
from collections.abc import Sequence
from functools import partial
from html import escape

from markdown_it import MarkdownIt
from markdown_it.renderer import RendererProtocol
from markdown_it.rules_inline import StateInline
from markdown_it.token import Token
from markdown_it.utils import EnvType, OptionsDict

TEXT_ROLES = ("measured", "readout")
"""All of them; what their words ask for is found in `inline`."""


def text_role(parser: MarkdownIt, name: str) -> None:
    """``{name}`words``` becomes a token ``name`` that holds the words, until annotation replaces
    them. Must be used after the plugin of coloured roles, before which it looks."""
    pattern = re.compile(rf"\{{{name}\}}`([^`\n]+)`")
    parser.inline.ruler.before("role", name, partial(_rule, name, pattern))
    parser.add_render_rule(name, _render)


def _rule(name: str, pattern: re.Pattern[str], state: StateInline, silent: bool) -> bool:
    match = pattern.match(state.src, state.pos)
    if not match:
        return False
    if not silent:
        state.push(name, "", 0).content = match[1]
    state.pos = match.end()
    return True


def _render(
    _renderer: RendererProtocol, tokens: Sequence[Token], index: int, _o: OptionsDict, _e: EnvType
) -> str:
    return escape(tokens[index].content)
