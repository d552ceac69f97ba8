"""What lies on a page: headings and numbered things, and what leads from one to another."""

import re
from dataclasses import dataclass
from pathlib import PurePosixPath

from site_builder.document.passage import Passage
from site_builder.references.glossary import Term
from site_builder.references.symbols import Symbol


@dataclass(frozen=True, slots=True)
class Heading:
    """A section's heading, as the table of contents shows it."""

    level: int
    id: str
    words: Passage


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


@dataclass(frozen=True, slots=True)
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
