"""The list of chapters that stands beside every page."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from site_builder.book import Chapter
from site_builder.pages.places import Card

BEFORE, BEHIND = "\0before\0", "\0behind\0"
"""Where a page has the entries of the chapters before its own, and of those behind it. No text has
such a character. They are put in last: of a thousand pages with a thousand entries each, what is
kept, packed and handed from one process to the next would be little else."""


@dataclass(frozen=True, slots=True)
class Entries:
    """Every chapter's entry, made once for all pages from which the chapters are as far."""

    entries: Sequence[bytes]
    places: Mapping[str, int]
    """Of each chapter by its id."""

    def put_into(self, page: bytes, chapter: Chapter | None) -> bytes:
        """The whole page; one that is no chapter has all entries in the first place, or neither
        place."""
        place = self.places[chapter.id] if chapter else len(self.entries)
        begin, found, rest = page.partition(BEFORE.encode())
        if not found:
            return page
        own, _, end = rest.partition(BEHIND.encode())
        return b"".join((begin, *self.entries[:place], own, *self.entries[place + 1 :], end))


def chapter_entries(cards: Sequence[Card], entry: Callable[[Card], str]) -> Entries:
    """Those of all chapters, of which ``entry`` makes one."""
    places = {card.id: place for place, card in enumerate(cards)}
    return Entries([entry(card).encode() for card in cards], places)
