"""One chapter of the book: surveyed for what others may refer to, then read; both cached."""

from dataclasses import dataclass, field, replace

from site_builder.cache.hashing import hash_of
from site_builder.cache.results import cached_reading, cached_result
from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.document.book import Chapter
from site_builder.document.places import Position, Target, chapter_id
from site_builder.markdown.chapter import Draft, Survey, parse_chapter, read_chapter, survey
from site_builder.markdown.parse_context import ParseContext, Shared
from site_builder.markdown.targets import Targets


@dataclass(slots=True)
class ChapterFile:
    """A chapter's file."""

    path: str
    """Relative to the root of the project."""
    text: str
    position: Position
    shared: Shared
    state: bytes
    """Hash of what is shared, and of all files that a chapter may show or run, besides chapters."""
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
        return self.state, self.path, self.text, self.position

    def _parsed(self) -> Draft:
        if self._draft is None:
            context = ParseContext(
                self.path,
                self.shared,
                Diagnostics(),
                chapter=chapter_id(self.path),
                position=self.position,
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
