"""What a role is, ``{name}`words``` in running text, and the inline rule that finds its uses."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from markdown_it.rules_inline import StateInline

from site_builder.markdown.reading import Reading

USE = re.compile(r"\{([\w-]+)\}`([^`\n]+)`")
MEANT = re.compile(r"(.*?)\s*(?:<([^<>]*)>)?")
"""Words of a link, and what stands behind them in ``<…>``."""


@dataclass(frozen=True, slots=True)
class Role:
    """One role; ``roles/__init__.py`` lists them all."""

    name: str
    form: str
    """What stands between the backticks, as the author's guide shows it."""
    says: str
    """What becomes of it, for the same guide."""
    text: Callable[[str, Reading], str] | None = None
    """What the page says instead of the words; without it the words stay, in the role's colour."""
    link: Callable[[str, int, Reading], Mapping[str, str]] | None = None
    """Attributes of the link that the words become. It gets what stands in ``<…>`` at their end,
    with its line, and reports what is wrong there."""
    refuses: type[Exception] = LookupError
    """What ``text`` raises where the words ask for nothing that there is."""


def role_rule(roles: Mapping[str, Role], state: StateInline, silent: bool) -> bool:
    """A token ``role`` that holds the words, until annotation replaces them; or the words within
    ``role_open`` and ``role_close``, coloured or linked. Unknown names are left to annotation too,
    which knows their line."""
    match = USE.match(state.src, state.pos)
    if not match:
        return False
    if not silent:
        name, words = match.groups()
        role = roles.get(name)
        if role and role.text:
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
    token = state.push("role_open", "a", 1)
    token.info = role.name
    token.meta = {"role": role, "given": meant[2] or ""}
    state.tokens.extend(state.md.inline.parse(meant[1], state.md, state.env, []))
    state.push("role_close", "a", -1)
