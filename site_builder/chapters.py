"""One chapter of the book: surveyed for what others may refer to, then read; both cached."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from markdown_it import MarkdownIt

from simulations.engine.scene import Scene
from site_builder.benchmarks.measurements import Measurements
from site_builder.book import Chapter
from site_builder.cache import cached_reading, cached_result, hash_of
from site_builder.diagnostics import Diagnostics
from site_builder.languages.words import Words
from site_builder.markdown.chapter import Draft, Survey, parse_chapter, read_chapter, survey
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.parser import make_parser
from site_builder.markdown.targets import Targets
from site_builder.markdown.text.math import Macros
from site_builder.page_model.places import Position, Target, chapter_id
from site_builder.references.bibliography import Bibliography
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
    state: bytes
    """Hash of all this, and of all files that a chapter may show or run, besides the chapters."""
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
    _draft: Draft | None = field(default=None, init=False)
    """Parsed already, and not yet read: reading changes it."""

    def survey(self) -> Survey:
        """What others may refer to in it; its mistakes are reported when it is read."""
        return cached_result("survey", self._given(), lambda: survey(self._parsed()))

    def read(self, targets: Targets, state: bytes, problems: Diagnostics) -> Chapter:
        """The whole chapter; mistakes go to ``problems`` and reading goes on. ``state``:
        `targets_state` of the targets."""
        key = hash_of(self._given(), state)

        def read(own: Diagnostics) -> Chapter:
            draft, self._draft = self._parsed(), None
            chapter = read_chapter(draft, targets)
            own.found.extend(draft.context.problems.found)
            own.doubts.extend(draft.context.problems.doubts)
            return replace(chapter, cache_key=key)

        return cached_reading("chapter", (key, self.shared.load_scene), problems, read)

    def _given(self) -> tuple[object, ...]:
        return self.shared.state, self.path, self.text, self.position

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


def targets_state(targets: Targets) -> bytes:
    """Hash of what a chapter can show of others: not on which line that stands."""

    def shown(target: Target) -> tuple[object, ...]:
        return target.kind, target.chapter, target.id, target.number, target.title, target.labelled

    inside = {chapter: [shown(one) for one in found] for chapter, found in targets.inside.items()}
    chapters = {chapter: shown(target) for chapter, target in targets.chapters.items()}
    return hash_of(chapters, inside)
