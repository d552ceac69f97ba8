"""The list of chapters that stands beside every page."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from markupsafe import Markup

from site_builder.book import Chapter
from site_builder.pages.places import Card


@dataclass(frozen=True, slots=True)
class Entries:
    """Every chapter's entry, made once for all pages from which the chapters are as far: as many
    entries for each of as many pages would take longer than all else."""

    entries: Sequence[Markup]
    places: Mapping[str, int]
    """Of each chapter by its id."""

    def before(self, chapter: Chapter | None) -> Markup:
        """Those before the page's own; all on a page that is no chapter."""
        return _joined(self.entries[: self.places[chapter.id]] if chapter else self.entries)

    def behind(self, chapter: Chapter | None) -> Markup:
        return _joined(self.entries[self.places[chapter.id] + 1 :] if chapter else ())


def chapter_entries(cards: Sequence[Card], entry: Callable[[Card], str]) -> Entries:
    """Those of all chapters, of which ``entry`` makes one."""
    places = {card.id: place for place, card in enumerate(cards)}
    return Entries([Markup(entry(card)) for card in cards], places)


def _joined(entries: Sequence[Markup]) -> Markup:
    """As `Markup.join` does it, which looks at each of them once more."""
    return Markup("".join(entries))
