"""``{tip}``, ``{note}``, ``{warning}``, ``{key-idea}``: asides, with a title."""

from collections.abc import Sequence
from dataclasses import dataclass

from site_builder.book import Block
from site_builder.markdown.bodies import BLOCKS
from site_builder.markdown.directive import Argument, Directive, Use
from site_builder.markdown.inline import inline_html
from site_builder.markdown.reading import Reading

TITLES = {
    "tip": "Tip",
    "note": "Note",
    "warning": "Warning",
    "key-idea": "Key idea",
}
"""Kinds of callout, and the title of each where the author gives none."""


@dataclass(frozen=True, slots=True)
class Callout:
    """An aside; what it says is in the blocks inside."""

    kind: str
    """The name of its directive."""
    title_html: str


def read_callout(use: Use, _body: Sequence[Block], reading: Reading) -> Callout:
    return Callout(use.name, inline_html(use.argument or TITLES[use.name], use.line, reading))


def _callout(name: str, says: str) -> Directive[tuple[Block, ...]]:
    return Directive(
        name=name,
        says=says,
        argument=Argument("Title"),
        body=BLOCKS,
        read=read_callout,
        template="callout",
    )


CALLOUTS = (
    _callout("tip", "an aside that helps"),
    _callout("note", "an aside that adds"),
    _callout("warning", "an aside that warns"),
    _callout("key-idea", "what to remember"),
)
