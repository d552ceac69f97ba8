"""A chapter and the whole book, read, before they are checked and rendered."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import groupby
from operator import attrgetter
from typing import Any

from simulations.engine.scene import Scene
from site_builder.document.blocks import (
    Block,
    Deeper,
    Prediction,
    Quiz,
    Simulation,
    Source,
    contents,
)
from site_builder.document.places import (
    Citation,
    Definition,
    Formula,
    Heading,
    IndexMark,
    Link,
    Meaning,
    Need,
    Passage,
    Position,
    Reference,
    Target,
    TermUse,
)
from site_builder.languages.words import ENGLISH, Words
from site_builder.references.bibliography import NO_WORKS, Works
from site_builder.references.terms import NewsItem
from site_builder.settings.declared import TEXT, key, texts
from site_builder.settings.model import FILE_NAME, Settings

OUTLINE = FILE_NAME
"""The file that names the book, its chapters and the figure on its cover."""
UNSET = Settings(title="", subtitle="", prerequisites="", chapters=())

type Colours = Mapping[str, tuple[str, str]]
"""Names of the book's own colours, each with its values on light and on dark paper."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Chapter:
    """One page of the book."""

    position: Position
    id: str
    """The slug: ``lens-distortion`` for ``04-lens-distortion.md``."""
    path: str
    """Its Markdown file, relative to the root of the project."""
    title: str
    summary: str
    body: tuple[Block, ...]
    headings: tuple[Heading, ...]
    anchors: frozenset[str]
    """Element ids that a link may point to: headings and figures."""
    links: tuple[Link, ...]
    citations: tuple[Citation, ...] = ()
    term_uses: tuple[TermUse, ...] = ()
    """In the order of the page."""
    references: tuple[Reference, ...] = ()
    """Roles ``ref`` and ``set``, and the figures of questions and parts."""
    index_marks: tuple[IndexMark, ...] = ()
    formulae: tuple[Formula, ...] = ()
    """Formulae of text and questions, in the order in which they were read."""
    before: tuple[Need, ...] = ()
    """What to know before reading it."""
    after: tuple[Passage, ...] = ()
    """What its reader can do afterwards."""
    figures: tuple[str, ...] = ()
    """Element ids of its simulations, also of those that cannot be shown."""
    cache_key: bytes = b""
    """Hash of the chapter's inputs; the cache uses it in place of the contents."""

    @property
    def number(self) -> int:
        return self.position.number

    @property
    def mark(self) -> str:
        """Its number as readers see it: ``4``, or ``A`` for an appendix."""
        return self.position.mark

    @property
    def name(self) -> str:
        """``Chapter 4`` or ``Appendix A``."""
        return self.position.name

    @property
    def part(self) -> str:
        """Title of the part of the book that it is in; nothing where it is in none."""
        return self.position.part

    @property
    def is_appendix(self) -> bool:
        return self.position.kind == "Appendix"

    @property
    def url(self) -> str:
        """Address relative to the site's root."""
        return f"{self.id}/"

    @property
    def first_pass(self) -> tuple[Block, ...]:
        """What is not folded."""
        return tuple(block for block in self.body if not isinstance(block.content, Deeper))

    @property
    def simulations(self) -> tuple[Simulation, ...]:
        return tuple(contents(self.body, Simulation))

    @property
    def quizzes(self) -> tuple[Quiz, ...]:
        return tuple(contents(self.body, Quiz))

    @property
    def predictions(self) -> tuple[Prediction, ...]:
        return tuple(contents(self.body, Prediction))

    @property
    def sources(self) -> tuple[Source, ...]:
        return tuple(contents(self.body, Source))


@dataclass(frozen=True, slots=True)
class Taught:
    """A section of a chapter, with its figures and questions."""

    chapter: Target
    section: Target
    figures: tuple[Target, ...]
    questions: tuple[Target, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Lesson:
    """A section of another textbook, and what teaches it here."""

    number: str = key(TEXT)
    title: str = key(TEXT)
    note: str = key(TEXT)
    taught: tuple[str, ...] = key(texts('["chapter#section"]', least=1))
    """The sections that teach it, as their author names them."""
    sections: tuple[Taught, ...] = ()
    """The same, found."""
    closing: tuple[Taught, ...] = ()
    """The questions at the end of the chapters that these stand in."""


@dataclass(frozen=True, slots=True)
class LecturePlan:
    """Another textbook's sections, in its order."""

    intro: str
    lessons: tuple[Lesson, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Book:
    """Everything that the site is made from, read and parsed."""

    title: str
    subtitle: str
    prerequisites: str
    hero: Simulation | None
    """The figure of the landing page."""
    chapters: tuple[Chapter, ...]
    """Appendices at the end."""
    starts: tuple[tuple[str, str], ...] = ()
    """Words and addresses of the links of the landing page, relative to the site's root."""
    stops: tuple[tuple[str, str], ...] = ()
    """Those of its path."""
    bibliography: Works = NO_WORKS
    lecture_plan: LecturePlan | None = None
    search_words: tuple[tuple[Target, tuple[str, ...]], ...] = ()
    """Sections, and words by which readers look for them."""
    glossary: tuple[Definition, ...] = ()
    """In alphabetical order."""
    symbols: Mapping[str, tuple[Meaning, ...]] = field(default_factory=dict)
    """By the chapter for which they are declared, or `BOOK`."""
    settings: Settings = UNSET
    """Settings in ``book.toml``."""
    words: Words = ENGLISH
    """Words of the interface."""
    address: str = ""
    """Where the site will be, a slash at the end; nothing where that is not known."""
    source: str = ""
    """Where its sources can be read, with ``{path}`` in it; nothing where they cannot."""
    news: tuple[NewsItem, ...] = ()
    """Newest first."""

    @property
    def colours(self) -> Colours:
        pairs = {name: text.partition(" ") for name, text in self.settings.colours.items()}
        return {name: (light, dark) for name, (light, _, dark) in pairs.items()}

    @property
    def parts(self) -> tuple[tuple[str, tuple[Chapter, ...]], ...]:
        """Title and chapters of each, the appendices last; chapters in no part have no title."""
        groups = groupby(self.chapters, attrgetter("part"))
        return tuple((title, tuple(chapters)) for title, chapters in groups)

    @property
    def scenes(self) -> tuple[Scene[Any], ...]:
        """Every scene that the book shows, once, in the order of first appearance."""
        figures = [figure for chapter in self.chapters for figure in chapter.simulations]
        if self.hero:
            figures.append(self.hero)
        return tuple({figure.scene.id: figure.scene for figure in figures}.values())
