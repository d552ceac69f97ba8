"""Links from lists of terms to places in the text; lists ordered by letter."""

import unicodedata
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import groupby

from site_builder.document.book import Chapter
from site_builder.document.passage import Passage


@dataclass(frozen=True, slots=True)
class Card:
    """A chapter as other pages name it, without its content."""

    id: str
    url: str
    mark: str
    name: str
    title: str
    summary: str
    part: str
    """Title of the part of the book that it is in."""


@dataclass(frozen=True, slots=True)
class Place:
    """A link: its address, and the chapter and heading that it names."""

    address: str
    """Relative to the site's root."""
    chapter: Card
    section: Passage
    """Words of its heading; nothing before a chapter's first."""
    explains: bool = False
    """Whether the term is explained here."""


type Letters[T] = list[tuple[str, list[T]]]
"""Entries under their letters."""


@dataclass(frozen=True, slots=True)
class Atlas:
    """The places of a chapter."""

    chapter: Chapter
    card: Card
    words: Mapping[str, Passage]
    """Of its headings, by element id."""

    def place(self, section: str, element: str, *, explains: bool = False) -> Place:
        """Of an element below the heading ``section``; of the heading without an element."""
        anchor = element or section
        address = f"{self.card.url}#{anchor}" if anchor else self.card.url
        return Place(address, self.card, self.words.get(section, Passage()), explains)


def atlas(chapter: Chapter) -> Atlas:
    words = {heading.id: heading.words for heading in chapter.headings}
    return Atlas(chapter, card(chapter), words)


def card(chapter: Chapter) -> Card:
    return Card(
        chapter.id,
        chapter.url,
        chapter.mark,
        chapter.name,
        chapter.title,
        chapter.summary,
        chapter.part,
    )


def by_letter[T](named: Iterable[tuple[str, T]]) -> Letters[T]:
    """In alphabetical order, without regard to case and accents."""
    found = sorted(named, key=lambda pair: _plain(pair[0]))
    return [
        (letter, [entry for _, entry in group])
        for letter, group in groupby(found, key=lambda pair: _plain(pair[0])[:1].upper())
    ]


def _plain(name: str) -> str:
    letters = unicodedata.normalize("NFKD", name)
    return "".join(letter for letter in letters if not unicodedata.combining(letter)).casefold()
