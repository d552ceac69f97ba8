"""What stands in every page and is the same in all: the style sheet, and the list of chapters.

It is put in last. Of a thousand pages, each with the style sheet and a thousand entries, what is
kept, packed and handed from one process to the next would be little else.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from site_builder.book import Chapter
from site_builder.pages.places import Card

STYLES, BEFORE, BEHIND = "\0styles\0", "\0before\0", "\0behind\0"
"""Where a page has the style sheet, the entries of the chapters before its own, and of those behind
it, in this order. No text has such a character."""


type Listed = Chapter | Card
"""One of the chapters."""


@dataclass(frozen=True, slots=True)
class Common:
    """Made once for all pages from which the site's root is as far."""

    styles: bytes
    entries: Sequence[bytes]
    """Every chapter's."""
    places: Mapping[str, int]
    """Of each chapter by its id."""

    def put_into(self, page: bytes, chapter: Listed | None) -> bytes:
        """The whole page; one that is no chapter has all entries in the first place. It may lack
        each of the places."""
        own = self.places[chapter.id] if chapter else len(self.entries)
        given = {
            STYLES: (self.styles,),
            BEFORE: self.entries[:own],
            BEHIND: self.entries[own + 1 :],
        }
        parts: list[bytes] = []
        for place, common in given.items():
            before, found, behind = page.partition(place.encode())
            if found:
                parts += (before, *common)
                page = behind
        return b"".join((*parts, page))


def common_parts(styles: str, cards: Sequence[Card], entry: Callable[[Card], str]) -> Common:
    """With the entries of all chapters, of which ``entry`` makes one."""
    places = {card.id: place for place, card in enumerate(cards)}
    return Common(styles.encode(), [entry(card).encode() for card in cards], places)
