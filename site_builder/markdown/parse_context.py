"""What one Markdown file is read with, and what is collected while it is read."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from markdown_it import MarkdownIt

from simulations.engine.scene import Scene
from site_builder.benchmarks.measurements import Measurements
from site_builder.benchmarks.quoted_numbers import Readouts
from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.document.blocks import Simulation
from site_builder.document.places import (
    Citation,
    Heading,
    IndexMark,
    Link,
    Position,
    Target,
    Targets,
    TermUse,
)
from site_builder.formulae.temml import Macros
from site_builder.languages.words import ENGLISH, Words
from site_builder.references.bibliography import NO_WORKS, Works
from site_builder.references.terms import NO_TERMS, Glossary

FIRST = Position(0, "0")
PAGE_IDS = ("main", "contents", "progress-title", "keys-title")
"""Element ids of the frame around every chapter."""


@dataclass(frozen=True, slots=True)
class FigurePlace:
    """Where a figure stands in its file."""

    id: str
    """Element id."""
    scene_id: str
    """The author's spelling, known or not."""
    lines: tuple[int, int]
    """First and last, counted from 1."""
    leader: str = ""
    """The author's name for the figure whose settings it shares; nothing where they are its own."""

    def distance(self, line: int) -> int:
        """Lines between ``line`` and the figure; 0 inside it."""
        first, last = self.lines
        return max(first - line, line - last, 0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Shared:
    """What all files of a book are read with."""

    root: Path
    """The project: where quoted modules and picture files are looked up."""
    load_scene: Callable[[str], Scene[Any]]
    parser: MarkdownIt
    words: Words = ENGLISH
    """Words of the interface, in the book's language."""
    measurements: Measurements = field(default_factory=Measurements)
    """Where numbers about speed and accuracy come from."""
    raw_html: bool = False
    """Whether the book's author trusts the HTML of its chapters."""
    macros: Macros = field(default_factory=dict)
    """TeX commands of the book's own."""
    bibliography: Works = NO_WORKS
    glossary: Glossary = NO_TERMS
    colours: tuple[str, ...] = ()
    """Names of the book's own."""


@dataclass(slots=True, kw_only=True)
class ParseContext:
    """The state of reading one page; dropped once its `Chapter` is made."""

    path: str
    """The file, relative to the root of the project."""
    shared: Shared
    problems: Diagnostics
    chapter: str = ""
    """Id of the chapter; nothing where it is none."""
    position: Position = FIRST
    targets: Targets = field(default_factory=Targets)
    """What references may lead to: none before all chapters are parsed."""
    values: dict[str, object] = field(default_factory=dict)
    """Functions and values that ``calc`` blocks of the page name."""
    env: dict[str, Any] = field(default_factory=dict)
    """The parser's own state: link references, footnotes."""
    headings: list[Heading] = field(default_factory=list)
    links: list[Link] = field(default_factory=list)
    """Links that lead out of the book."""
    ids: dict[str, int] = field(default_factory=lambda: dict.fromkeys(PAGE_IDS, 0))
    """Element ids taken in the page, with their lines; 0 where the page itself took them."""
    figures: list[FigurePlace] = field(default_factory=list)
    """All of the page, in order, found before its text is read, which may refer to them."""
    simulations: dict[str, Simulation] = field(default_factory=dict)
    """Those that were read, by element id."""
    placed: dict[int, Target] = field(default_factory=dict)
    """Numbered directives of the page, by the line that opens them."""
    introduced: set[str] = field(default_factory=set)
    """Chapters that the page has named with their titles."""
    citations: list[Citation] = field(default_factory=list)
    term_uses: list[TermUse] = field(default_factory=list)
    references: list[tuple[Target, int]] = field(default_factory=list)
    """Targets that the text names, each with the line of that."""
    index_marks: list[IndexMark] = field(default_factory=list)
    formulae: list[tuple[int, str, bool]] = field(default_factory=list)
    """Line and TeX of each, and whether it is displayed."""
    readouts: Readouts = field(init=False)
    """Where numbers that figures show come from."""

    def __post_init__(self) -> None:
        self.readouts = Readouts(self.shared.load_scene)

    @property
    def content(self) -> Path:
        """The folder of the book's own files."""
        return self.shared.root / "content"

    def problem(
        self,
        line: int,
        message: str,
        error: BaseException | None = None,
        spoils: tuple[str, ...] = (),
    ) -> None:
        """``error`` and ``spoils`` as `Diagnostics.add` has them."""
        self.problems.add(self.path, line, message, error, spoils)

    def find_figure(self, name: str, line: int) -> FigurePlace | None:
        """The figure that an author names, by its id or that without ``figure-``; None, and a
        report, where the page has none of that name."""
        places = {place.id.removeprefix("figure-"): place for place in self.figures}
        found = places.get(name.removeprefix("figure-"))
        if found:
            target = self.placed[found.lines[0]]
            self.warn_of_count(target, line)
            self.references.append((target, line))
        else:
            self.problem(line, unknown("figure", name, places))
        return found

    def leading(self, place: FigurePlace) -> FigurePlace:
        """The figure whose settings those of a figure are: most often itself."""
        wanted = place.leader.removeprefix("figure-")
        leaders = (each for each in self.figures if each.id.removeprefix("figure-") == wanted)
        return next(leaders, place)

    def warn_of_count(self, target: Target, line: int) -> None:
        """Warn of a reference to an id that changes when the page gets another such figure."""
        if target.counted:
            where = f"better: a ':label:' on line {target.line}"
            message = f"{target.id!r} depends on the order of the page; {where}"
            self.problems.warn(self.path, line, message)

    def take_id(self, wanted: str, line: int, kind: str) -> str:
        """Claim an element id; taking one twice is a mistake."""
        if wanted in self.ids:
            first = self.ids[wanted]
            place = f"first used on line {first}" if first else "the page itself uses it"
            self.problem(line, f"duplicate {kind} id {wanted!r}; {place}")
        self.ids.setdefault(wanted, line)
        return wanted

    def free_id(self, wanted: str, line: int) -> str:
        """Claim an element id, numbered where it is taken."""
        number = 2
        chosen = wanted
        while chosen in self.ids:
            chosen, number = f"{wanted}-{number}", number + 1
        self.ids[chosen] = line
        return chosen
