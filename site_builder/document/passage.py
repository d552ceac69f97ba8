"""A run of Markdown between parsing and rendering: the parser's tokens, the same for each medium.

The renderers in ``site_builder/render/`` make HTML, XHTML or plain words of it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from markdown_it.token import Token

META = ("mathml", "before", "after", "target", "id", "subId", "label")
"""What renderers use of a token's ``meta``: a formula as MathML and the text beside it, the target
of a heading or equation, the numbers of footnotes."""


@dataclass(frozen=True, slots=True)
class Passage:
    """Inline words, or paragraphs, lists, headings, formulae: what plain Markdown makes."""

    tokens: tuple[Token, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.tokens)


type Channel = Literal["text", "figure", "question"]


@dataclass(frozen=True, slots=True)
class Plain:
    """What a directive is in plain words, before those of the blocks inside it."""

    words: tuple[str | Passage, ...] = ()
    channel: Channel = "text"
    """What the search takes them for."""


def passage(tokens: Sequence[Token]) -> Passage:
    """A passage of tokens without directives; copies, without what only reading needed."""
    return Passage(tuple(_copy(token) for token in tokens if not _is_empty(token)))


def _is_empty(token: Token) -> bool:
    if token.type == "inline":
        return not token.children
    if token.type in ("html_block", "html_inline"):
        return not token.content.strip()
    return token.type == "front_matter"


def _copy(token: Token) -> Token:
    return Token(
        token.type,
        token.tag,
        token.nesting,
        attrs=dict(token.attrs),
        children=None if token.children is None else [_copy(child) for child in token.children],
        content=token.content,
        info=token.info,
        meta={name: token.meta[name] for name in META if name in token.meta},
        block=token.block,
        hidden=token.hidden,
    )
