"""The page model: what a checked book is, before it becomes HTML. Frozen all the way down.

A directive keeps the class of what it shows in its own file. Here are those that other parts of
the builder ask for: simulations are drawn, quizzes catalogued, predictions matched with what
answers them, quoted modules get a page.
"""

import hashlib
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import PurePosixPath
from typing import Any

from simulations.engine.scene import Scene
from site_builder.beside.bibliography import EMPTY, Bibliography
from site_builder.beside.glossary import Term
from site_builder.beside.news import News
from site_builder.beside.symbols import Symbol
from site_builder.languages.words import ENGLISH, Words
from site_builder.settings.model import FILE_NAME, Settings

OUTLINE = FILE_NAME
"""The file that names the book, its chapters and the figure on its cover."""
UNSET = Settings("", "", "", ())


@dataclass(frozen=True, slots=True)
class Block:
    """A part of a page: a run of plain Markdown, or what one directive says."""

    template: str
    """Its file below ``templates/blocks/``, without ``.html``."""
    content: object
    """What the template shows; most directives have a class of their own for it."""
    inside: "tuple[Block, ...]" = ()
    """The blocks in it, as a callout has them."""
    target: "Target | None" = None
    """Its number and where a link to it leads; None where it is not numbered."""


def contents[T](blocks: Iterable[Block], kind: type[T]) -> Iterator[T]:
    """What the blocks of one kind show, those inside other blocks included."""
    for block in blocks:
        if isinstance(block.content, kind):
            yield block.content
        yield from contents(block.inside, kind)


@dataclass(frozen=True, slots=True)
class Prose:
    """Paragraphs, lists, headings, formulae: anything that plain Markdown makes."""

    html: str


@dataclass(frozen=True, slots=True)
class Simulation:
    """A figure that comes alive in the page."""

    scene: Scene[Any]
    id: str
    """Element id: ``figure-`` and the scene's id, numbered where a page shows a scene twice."""
    values: Mapping[str, object]
    """Starting values that differ from the scene's defaults, already checked."""
    tier: str
    """Starting accuracy; the scene's default where the author named none."""
    caption_html: str
    path: str
    line: int
    workings_open: bool = False
    """Whether it shows at first how it was computed."""


@dataclass(frozen=True, slots=True)
class Option:
    """One answer of a question, offered or recognised."""

    html: str
    text: str
    correct: bool
    explanation_html: str
    value: float | None = None
    """Where a number is asked for: the one that this answer is."""


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked, and the answers that are offered or recognised."""

    id: str
    """Unique in the book among its like: the reader's answer is remembered under it."""
    kind: str
    prompt_html: str
    prompt_text: str
    options: tuple[Option, ...]
    path: str
    line: int
    unit: str = ""
    """Of a number."""
    tolerance: float = 0.0
    """How far from the right number is right."""


def _edition(question: Question, judged_by: object) -> str:
    """A mark of what is asked and what is right: an answer to another edition is forgotten."""
    answers = [(option.text, option.correct) for option in question.options]
    asked = (question.kind, question.prompt_text, answers, judged_by)
    return hashlib.sha256(repr(asked).encode()).hexdigest()[:8]


@dataclass(frozen=True, slots=True)
class Quiz(Question):
    """A question with explained answers: ``single``, ``multiple``, ``number``, ``order`` with its
    options in the right one, or ``figure``, whose options are conditions on its state."""

    figure: str = ""
    """Element id of the figure that is to be set."""
    solution: Mapping[str, str] = field(default_factory=dict)
    """Settings of that figure that are right."""

    @property
    def edition(self) -> str:
        return _edition(self, self.tolerance)


@dataclass(frozen=True, slots=True)
class Curve:
    """A curve to be sketched, and the axes that it is sketched on."""

    x: "Axis"
    y: "Axis"
    samples: tuple[tuple[float, float], ...]
    """Along the axis, from its start to its end."""


@dataclass(frozen=True, slots=True)
class Axis:
    """From where to where, and what of."""

    start: float
    end: float
    label: str


@dataclass(frozen=True, slots=True)
class Prediction(Question):
    """A question before its answer is looked up, ``number``, ``choice`` or ``sketch``; guess and
    answer then stand side by side."""

    curve: Curve | None = None

    @property
    def edition(self) -> str:
        return _edition(self, (self.curve.x, self.curve.y) if self.curve else None)


@dataclass(frozen=True, slots=True)
class Reveal:
    """What waits for a prediction; what it says is in the blocks inside."""

    prediction: str
    id: str
    """Element id."""
    asked: str
    """What the prediction is called: ``Prediction 4.2``."""
    path: str
    line: int


@dataclass(frozen=True, slots=True)
class Source:
    """The real source of a function of the book's own code."""

    module: str
    name: str
    path: str
    """File of the module, relative to the root of the project."""
    first_line: int
    html: str
    caption_html: str


@dataclass(frozen=True, slots=True)
class Heading:
    """A section's heading, as the table of contents shows it."""

    level: int
    id: str
    html: str


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


@dataclass(frozen=True, slots=True)
class IndexMark:
    """A place in the text that its author wants in the index."""

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


@dataclass(frozen=True, slots=True)
class Meaning:
    """A symbol as it is printed, with what it stands for in a chapter."""

    symbol: Symbol
    html: str
    means_html: str


@dataclass(frozen=True, slots=True)
class Definition:
    """A term of the glossary as it is printed."""

    term: Term
    html: str
    explained: Target | None
    """The section that explains it; None where there is none, which is reported."""


@dataclass(frozen=True, slots=True)
class Need:
    """What a reader should know before a chapter."""

    html: str
    chapter: str
    """Id of the chapter that teaches it; nothing where none does."""
    line: int


@dataclass(frozen=True, slots=True)
class Link:
    """A link of the author's, kept to be checked once all pages are read."""

    target: str
    line: int


def chapter_id(file: str) -> str:
    """``lens-distortion`` for ``04-lens-distortion.md``."""
    return re.sub(r"^\d+-", "", PurePosixPath(file).stem) or "unnamed"


@dataclass(frozen=True, slots=True)
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
    index_marks: tuple[IndexMark, ...] = ()
    formulae: tuple[Formula, ...] = ()
    """Of text and questions, in the order in which they were read."""
    files: frozenset[str] = frozenset()
    """Files below ``content/`` that it hands out, besides pictures."""
    kept_as: bytes = b""
    """The hash of all that it was made from; nothing where that is unknown."""

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
    def is_appendix(self) -> bool:
        return self.position.kind == "Appendix"

    before: tuple[Need, ...] = ()
    """What to know before reading it."""
    after: tuple[str, ...] = ()
    """What its reader can do afterwards, each as HTML."""
    figures: tuple[str, ...] = ()
    """Element ids of its simulations, also of those that cannot be shown."""
    outside: tuple[Link, ...] = ()
    """Links that lead out of the book."""

    @property
    def url(self) -> str:
        """Address relative to the site's root."""
        return f"{self.id}/"

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
    """A section of a chapter, with what it shows and asks."""

    chapter: Target
    section: Target
    figures: tuple[Target, ...]
    questions: tuple[Target, ...]


@dataclass(frozen=True, slots=True)
class Lesson:
    """A section of another textbook, and what teaches it here."""

    number: str
    title: str
    note: str
    taught: tuple[Taught, ...]
    closing: tuple[Taught, ...]
    """The questions at the end of the chapters that these stand in."""


@dataclass(frozen=True, slots=True)
class LecturePlan:
    """Another textbook's sections, in its order."""

    intro: str
    lessons: tuple[Lesson, ...]


@dataclass(frozen=True, slots=True)
class Book:
    """Everything that the site is made from, read and parsed."""

    title: str
    subtitle: str
    prerequisites: str
    hero: Simulation | None
    """The figure of the landing page."""
    chapters: tuple[Chapter, ...]
    """Appendices at the end."""
    bibliography: Bibliography = EMPTY
    lecture_plan: LecturePlan | None = None
    glossary: tuple[Definition, ...] = ()
    """In alphabetical order."""
    symbols: Mapping[str, tuple[Meaning, ...]] = field(default_factory=dict)
    """By the chapter for which they are declared, or `BOOK`."""
    settings: Settings = UNSET
    """All that ``book.toml`` says."""
    words: Words = ENGLISH
    """Those of the interface."""
    address: str = ""
    """Where the site will be, a slash at the end; nothing where that is not known."""
    source: str = ""
    """Where its sources can be read, with ``{path}`` in it; nothing where they cannot."""
    news: tuple[News, ...] = ()
    """Newest first."""

    @property
    def scenes(self) -> tuple[Scene[Any], ...]:
        """Every scene that the book shows, once, in the order of first appearance."""
        figures = [figure for chapter in self.chapters for figure in chapter.simulations]
        if self.hero:
            figures.append(self.hero)
        return tuple({figure.scene.id: figure.scene for figure in figures}.values())
