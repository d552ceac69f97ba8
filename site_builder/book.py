"""The page model: what a checked book is, before it becomes HTML. Frozen all the way down."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from simulations.engine.scene import Scene
from site_builder.measured.measurements import MeasuredLadder
from site_builder.measured.stage_costs import StageCosts


@dataclass(frozen=True, slots=True)
class Prose:
    """Paragraphs, lists, headings, formulae: anything that plain Markdown makes."""

    html: str


@dataclass(frozen=True, slots=True)
class Simulation:
    """A figure that comes alive in the page."""

    scene: Scene
    id: str
    """Element id: ``figure-`` and the scene's id, numbered where a page shows a scene twice."""
    values: Mapping[str, object]
    """Starting values that differ from the scene's defaults, already checked."""
    tier: str
    """Starting accuracy; the scene's default where the author named none."""
    caption_html: str
    path: str
    line: int


@dataclass(frozen=True, slots=True)
class Option:
    """One answer of a quiz."""

    html: str
    text: str
    correct: bool
    explanation_html: str


@dataclass(frozen=True, slots=True)
class Quiz:
    """A question with explained answers."""

    id: str
    """Unique in the book: the reader's answer is remembered under it."""
    kind: str
    """``single`` or ``multiple``."""
    prompt_html: str
    prompt_text: str
    options: tuple[Option, ...]
    path: str
    line: int


@dataclass(frozen=True, slots=True)
class Callout:
    """An aside: a tip, a note, a warning, a key idea, a prediction to make."""

    kind: str
    title_html: str
    body: "tuple[Block, ...]"


@dataclass(frozen=True, slots=True)
class Example:
    """A worked example."""

    title_html: str
    body: "tuple[Block, ...]"


@dataclass(frozen=True, slots=True)
class Listing:
    """The real source of a function of the book's own code."""

    module: str
    name: str
    path: str
    """File of the module, relative to the root of the project."""
    first_line: int
    html: str
    caption_html: str


@dataclass(frozen=True, slots=True)
class Illustration:
    """A picture file with a caption."""

    file: str
    """Path below ``content/``."""
    alt: str
    caption_html: str


@dataclass(frozen=True, slots=True)
class CaptionedTable:
    """A table that has a caption."""

    caption_html: str
    html: str


@dataclass(frozen=True, slots=True)
class LadderFigure:
    """A measured ladder: chart, table, and buttons to measure it where the page is read."""

    measured: MeasuredLadder
    id: str
    """Element id: ``ladder-`` and the ladder's id, numbered where a page shows one twice."""
    caption_html: str
    default_html: str
    """Why its default was chosen; nothing where another metric than the first judges."""


@dataclass(frozen=True, slots=True)
class LadderTable:
    """All measured ladders, a line each."""

    rows: tuple[MeasuredLadder, ...]
    caption_html: str


@dataclass(frozen=True, slots=True)
class StageCostTable:
    """What each moved control costs of a whole frame of one scene."""

    costs: StageCosts
    caption_html: str


@dataclass(frozen=True, slots=True)
class HardCase:
    """A line of a table of hard cases, every answer computed and put into words."""

    id: str
    call: str
    answer: str
    why: str
    returns: str
    naive: str
    naive_answer: str
    library: str
    library_answer: str


@dataclass(frozen=True, slots=True)
class HardCases:
    """What a model answers at the edge of what it is made for."""

    id: str
    """Element id: ``extremes-`` and the model's."""
    title: str
    rows: tuple[HardCase, ...]


type Block = (
    Prose
    | Simulation
    | Quiz
    | Callout
    | Example
    | Listing
    | Illustration
    | CaptionedTable
    | LadderFigure
    | LadderTable
    | StageCostTable
    | HardCases
)


@dataclass(frozen=True, slots=True)
class Heading:
    """A section's heading, as the table of contents shows it."""

    level: int
    id: str
    html: str


@dataclass(frozen=True, slots=True)
class Link:
    """A link of the author's, kept to be checked once all pages are read."""

    target: str
    line: int


@dataclass(frozen=True, slots=True)
class Chapter:
    """One page of the book."""

    number: int
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

    @property
    def url(self) -> str:
        """Address relative to the site's root."""
        return f"{self.id}/"

    @property
    def simulations(self) -> tuple[Simulation, ...]:
        return tuple(block for block in walk(self.body) if isinstance(block, Simulation))

    @property
    def quizzes(self) -> tuple[Quiz, ...]:
        return tuple(block for block in walk(self.body) if isinstance(block, Quiz))

    @property
    def listings(self) -> tuple[Listing, ...]:
        return tuple(block for block in walk(self.body) if isinstance(block, Listing))


@dataclass(frozen=True, slots=True)
class Book:
    """Everything that the site is made from, read and parsed."""

    title: str
    subtitle: str
    prerequisites: str
    hero: Simulation | None
    """The figure of the landing page."""
    chapters: tuple[Chapter, ...]

    @property
    def scenes(self) -> tuple[Scene, ...]:
        """Every scene that the book shows, once, in the order of first appearance."""
        figures = [figure for chapter in self.chapters for figure in chapter.simulations]
        if self.hero:
            figures.append(self.hero)
        return tuple({figure.scene.id: figure.scene for figure in figures}.values())


def walk(blocks: tuple[Block, ...]) -> Iterator[Block]:
    """All blocks, those inside callouts and examples included."""
    for block in blocks:
        yield block
        if isinstance(block, Callout | Example):
            yield from walk(block.body)
