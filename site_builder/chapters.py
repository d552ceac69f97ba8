"""One chapter of the book: surveyed for what others may refer to, then read; both kept."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from markdown_it import MarkdownIt

from simulations.engine.scene import Scene
from site_builder.benchmarks.measurements import DATA as MEASUREMENTS
from site_builder.benchmarks.measurements import Measurements
from site_builder.book import Chapter
from site_builder.diagnostics import Diagnostics
from site_builder.kept.keeper import given_hash, kept_as, reads_file
from site_builder.kept.told import kept_reading
from site_builder.languages.words import Words
from site_builder.markdown.chapter import Draft, Survey, parse_chapter, read_chapter, survey
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.parser import make_parser
from site_builder.markdown.targets import Targets
from site_builder.markdown.text.macros import Macros
from site_builder.page_model.places import Position, Target, chapter_id
from site_builder.references.bibliography import FILE as BIBLIOGRAPHY
from site_builder.references.bibliography import Bibliography
from site_builder.references.glossary import FILE as GLOSSARY
from site_builder.references.glossary import Glossary


@dataclass(frozen=True, slots=True)
class Shared:
    """What all chapters are read with."""

    root: Path
    load_scene: Callable[[str], Scene[Any]]
    measurements: Measurements
    words: Words
    raw_html: bool
    """Whether the author's own HTML is let through."""
    macros: Macros
    """TeX commands of the author's own."""
    bibliography: Bibliography
    glossary: Glossary
    parser: MarkdownIt = field(init=False)
    """Of no chapter's own: to make one takes half as long as to parse a short chapter."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "parser", make_parser(self.words))


@dataclass(slots=True)
class Page:
    """A chapter's file."""

    path: str
    """Relative to the root of the project."""
    text: str
    position: Position
    shared: Shared
    _made_of: tuple[object, ...] = field(default=(), init=False)
    """Its path, and the hash of all that it is read with, which is asked for again and again."""
    _draft: Draft | None = field(default=None, init=False)
    """Parsed already, and not yet read: reading changes it."""

    def survey(self) -> Survey:
        """What others may refer to in it; its mistakes are told when it is read."""
        return kept_as("survey", self._given(), lambda: survey(self._parsed()))[0]

    def read(self, targets: Targets, known: bytes, problems: Diagnostics) -> Chapter:
        """The whole chapter; mistakes go to ``problems`` and reading goes on. ``known`` is what
        `targets_hash` says of the targets."""
        given = (*self._given(), known)
        chapter, made_from = kept_reading(
            "read", given, problems, lambda own: self._read(targets, own)
        )
        self._draft = None  # read, here or beside
        return replace(chapter, kept_as=made_from)

    def _given(self) -> tuple[object, ...]:
        if not self._made_of:
            shared = self.shared
            own = tuple(sorted(shared.macros.items()))
            given = self.path, self.text, self.position, shared.words, shared.raw_html, own
            self._made_of = (self.path, given_hash(*given))
        return self._made_of

    def _read(self, targets: Targets, problems: Diagnostics) -> Chapter:
        for file in (BIBLIOGRAPHY, GLOSSARY, MEASUREMENTS):
            reads_file(self.shared.root / file)
        draft, self._draft = self._parsed(), None
        chapter = read_chapter(draft, targets)
        own = draft.context.problems
        problems.found.extend(own.found)
        problems.doubts.extend(own.doubts)
        return chapter

    def _parsed(self) -> Draft:
        if self._draft is None:
            shared = self.shared
            context = ParseContext(
                self.path,
                shared.root,
                Diagnostics(),
                shared.load_scene,
                shared.parser,
                shared.measurements,
                words=shared.words,
                raw_html=shared.raw_html,
                macros=shared.macros,
                chapter=chapter_id(self.path),
                position=self.position,
                bibliography=shared.bibliography,
                glossary=shared.glossary,
            )
            self._draft = parse_chapter(self.text, context)
        return self._draft


def targets_hash(targets: Targets) -> bytes:
    """Of what a chapter can show of others: not on which line that stands."""

    def told(target: Target) -> tuple[object, ...]:
        return target.kind, target.chapter, target.id, target.number, target.title, target.labelled

    inside = {chapter: [told(one) for one in found] for chapter, found in targets.inside.items()}
    chapters = {chapter: told(target) for chapter, target in targets.chapters.items()}
    return given_hash(chapters, inside)
