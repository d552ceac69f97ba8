"""``{tip}``, ``{note}``, ``{warning}``, ``{key-idea}``: asides, with a title."""

from collections.abc import Sequence
from dataclasses import dataclass

from site_builder.book import Block
from site_builder.markdown.bodies import BLOCKS
from site_builder.markdown.directive import Argument, Directive, Use
from site_builder.markdown.inline import inline_html
from site_builder.markdown.reading import Reading


@dataclass(frozen=True, slots=True)
class Callout:
    """An aside; what it says is in the blocks inside."""

    kind: str
    """The name of its directive."""
    title_html: str


def read_callout(use: Use, _body: Sequence[Block], reading: Reading) -> Callout:
    title = use.argument or reading.words(f"callout.{use.name}")
    return Callout(use.name, inline_html(title, use.line, reading))


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
