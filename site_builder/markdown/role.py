"""A role, ``{name}`words``` in running text, as one value, and the inline rule that finds it."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from markdown_it.rules_inline import StateInline
from markdown_it.token import Token

from site_builder.markdown.parse_context import ParseContext

USE = re.compile(r"\{([\w:-]+)\}`([^`\n]+(?:\n[^`\n]+)?)`")
MEANT = re.compile(r"(.*?)\s*(?:<([^<>]*)>)?", re.DOTALL)
"""Words of a link, and what stands behind them in ``<…>``."""


@dataclass(frozen=True, slots=True)
class Linked:
    """What becomes of a role that is a link."""

    attributes: Mapping[str, str]
    fill: Callable[[str], str] | None = None
    """What each run of its words becomes; without it they stay."""
    meta: Mapping[str, object] = field(default_factory=dict)
    """For later passes over the page."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Role:
    """One role; ``roles/__init__.py`` lists them all."""

    name: str
    form: str
    """What stands between the backticks, as the author's guide shows it."""
    doc: str
    """What becomes of it, for the same guide."""
    text: Callable[[str, ParseContext], str] | None = None
    """The text in place of the words; without it the words stay, in the role's colour."""
    link: Callable[[str, str | None, int, ParseContext], Linked] | None = None
    """The link that the words become. It gets them, what stands in ``<…>`` at their end, and its
    line; and reports what is wrong there."""
    inline: Callable[[str, int, ParseContext], Sequence[Token]] | None = None
    """What stands instead of the words, several links for example; reports what is wrong."""
    refuses: type[Exception] = LookupError
    """What ``text`` raises where its words are wrong."""


def role_rule(roles: Mapping[str, Role], state: StateInline, silent: bool) -> bool:
    """A token ``role`` that holds the words, until annotation replaces them; or the words within
    ``role_open`` and ``role_close``, coloured or linked. Annotation reports unknown names."""
    match = USE.match(state.src, state.pos)
    if not match:
        return False
    if not silent:
        name, words = match.groups()
        role = roles.get(name)
        if role and (role.text or role.inline):
            token = state.push("role", "", 0)
            token.content = words
            token.meta = {"role": role}
        elif role and role.link:
            _push_link(role, match, state)
        else:
            token = state.push("role_open", "span", 1)
            token.attrSet("class", f"role-{name}")
            token.info = name
            state.push("text", "", 0).content = words
            state.push("role_close", "span", -1)
    state.pos = match.end()
    return True


def _push_link(role: Role, match: re.Match[str], state: StateInline) -> None:
    """``role_open`` and ``role_close`` around the words, which may hold formulae and emphasis."""
    meant = MEANT.fullmatch(match[2])
    assert meant  # any words fit
    words, given = (part and " ".join(part.split()) for part in meant.groups())
    token = state.push("role_open", "a", 1)
    inside = state.md.inline.parse(meant[1], state.md, state.env, [])
    token.info = role.name
    token.meta = {"role": role, "words": words, "given": given, "inside": inside}
    state.tokens.extend(inside)
    state.push("role_close", "a", -1)
