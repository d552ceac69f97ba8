"""Runs of Markdown between parsing and rendering, what lies on a page, and what leads from one
place to another.

A passage is the parser's tokens, the same for each medium; the renderers in
``site_builder/render/`` make HTML, XHTML or plain words of it.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import PurePosixPath
from typing import Literal

from markdown_it.token import Token

from site_builder.diagnostics.diagnostic import unknown
from site_builder.references.terms import Symbol, Term

META = ("mathml", "before", "after", "target", "title", "id", "subId", "label")
"""What renderers use of a token's ``meta``: a formula as MathML and the text beside it, the target
of a heading or equation and the heading's words, the numbers of footnotes."""


@dataclass(frozen=True, slots=True)
class Passage:
    """Inline words, or paragraphs, lists, headings, formulae: what plain Markdown makes."""

    tokens: tuple[Token, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.tokens)


type Channel = Literal["text", "figure", "question"]


@dataclass(frozen=True, slots=True)
class Plain:
    """Plain text of a directive, which precedes the text of its inner blocks."""

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


@dataclass(frozen=True, slots=True)
class Heading:
    """A section's heading, as the table of contents shows it."""

    level: int
    id: str
    words: Passage
    deeper: bool = False
    """Whether it stands in a section beyond the first pass, or begins one."""


@dataclass(frozen=True, slots=True)
class Position:
    """Where a chapter stands in the book, as its outline lists them."""

    number: int
    """From 0; appendices are counted on."""
    mark: str
    """What readers see of it: ``4``, or ``A``."""
    kind: str = "Chapter"
    """``Chapter`` or ``Appendix``."""
    label: str = "Chapter"
    """The same in the words of the book."""
    part: str = ""
    """Title of the part of the book that it is in; nothing where it is in none."""

    @property
    def name(self) -> str:
        """``Chapter 4`` or ``Appendix A``."""
        return f"{self.label} {self.mark}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """What a reference may lead to: a chapter, a section, or a thing that is numbered."""

    kind: str
    """``Chapter``, ``Appendix``, ``Section``, ``Figure``, ``Equation``, ``Table``, ``Example``,
    ``Prediction`` or ``Question``."""
    chapter: str
    """Id of the chapter that it is, or stands in."""
    id: str
    """Element id; nothing for a chapter."""
    number: str
    """``4``, ``4.2`` or ``A.2``; nothing for a section."""
    title: str
    """Words of a chapter or section; nothing for other things."""
    line: int
    labelled: bool = False
    """Whether its author gave it its id, which then is unique in the book."""
    name: str = ""
    """``Chapter 4``, ``Figure 4.2``, ``Equation (4.7)``; a section's words, in quotes."""
    counted: bool = False
    """Whether its id ends in a number that depends on the order of the page."""
    deeper: bool = False
    """Whether it stands in a section beyond the first pass."""


@dataclass(frozen=True, slots=True)
class Reference:
    """A place in the text that names a target."""

    target: Target
    section: str
    """Element id of the heading above it; nothing before a chapter's first."""
    line: int


@dataclass(frozen=True, slots=True)
class Citation:
    """A place in the text where a work is cited."""

    key: str
    id: str
    """Element id."""


@dataclass(frozen=True, slots=True)
class TermUse:
    """A place in the text where a term of the glossary stands."""

    term: str
    """Its name in the glossary."""
    section: str
    """Element id of the heading above it; nothing before a chapter's first."""
    element: str
    """Element id of its mark; nothing where it has none."""
    line: int
    """In the source, counted from 1."""
    by_author: bool
    """Whether the author marked it with the role ``term``."""


@dataclass(frozen=True, slots=True)
class IndexMark:
    """A place in the text that the index lists."""

    entry: str
    section: str
    element: str


@dataclass(frozen=True, slots=True)
class Formula:
    """A formula of a chapter, wherever it stands."""

    tex: str
    line: int
    section: str
    """Element id of the heading above it; nothing before a chapter's first."""
    displayed: bool = False
    """Whether it stands on lines of its own."""


@dataclass(frozen=True, slots=True)
class Meaning:
    """A symbol as it is printed, with what it stands for in a chapter."""

    symbol: Symbol
    formula: Passage
    means: Passage


@dataclass(frozen=True, slots=True)
class Definition:
    """A term of the glossary as it is printed."""

    term: Term
    words: Passage
    explained: Target | None
    """The section that explains it; None where there is none, which is reported."""


@dataclass(frozen=True, slots=True)
class Need:
    """What a reader should know before a chapter."""

    words: Passage
    chapter: str
    """Id of the chapter that teaches it; nothing where none does."""
    line: int


@dataclass(frozen=True, slots=True)
class Link:
    """An author's link to a page of the book, checked once all pages are read."""

    target: str
    line: int


def chapter_id(file: str) -> str:
    """``lens-distortion`` for ``04-lens-distortion.md``."""
    return re.sub(r"^\d+-", "", PurePosixPath(file).stem) or "unnamed"


@dataclass(frozen=True, slots=True)
class Targets:
    """Targets of the whole book."""

    chapters: Mapping[str, Target] = field(default_factory=dict)
    """By their ids, in the order of the book."""
    inside: Mapping[str, Sequence[Target]] = field(default_factory=dict)
    """By the id of the chapter they stand in."""

    def find(self, given: str, here: str) -> Target:
        """What ``given`` names on the page ``here``: ``chapter``, ``chapter#id``, ``#id``, or an
        ``id`` of this page or, where no other page has it, of another. Raises `LookupError`."""
        chapter, mark, name = given.partition("#")
        if mark and not chapter:
            return _one(name, self.inside.get(here, ()), "target on this page")
        if mark:
            self._chapter(chapter)
            return _one(name, self.inside.get(chapter, ()), f"target in {chapter}")
        if given in self.chapters:
            return self.chapters[given]
        return self._anywhere(given, here)

    def _chapter(self, name: str) -> Target:
        if name not in self.chapters:
            raise LookupError(unknown("chapter", name, self.chapters))
        return self.chapters[name]

    def _anywhere(self, name: str, here: str) -> Target:
        for target in self.inside.get(here, ()):
            if target.id == name:
                return target
        every = [target for targets in self.inside.values() for target in targets]
        found = [target for target in every if target.id == name]
        if len(found) > 1:
            expected = " or ".join(repr(f"{target.chapter}#{name}") for target in found[:3])
            raise LookupError(f"target {name!r} is in {len(found)} chapters; legal: {expected}")
        if not found:
            names = dict.fromkeys((*self.chapters, *(target.id for target in every)))
            raise LookupError(unknown("target", name, names))
        return found[0]


def _one(name: str, targets: Sequence[Target], kind: str) -> Target:
    by_id = {target.id: target for target in targets}
    if name not in by_id:
        raise LookupError(unknown(kind, name, by_id))
    return by_id[name]
