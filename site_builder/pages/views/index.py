"""The index of terms as its template needs it: where the glossary's terms and the author's own
marks are."""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from site_builder.document.book import Book
from site_builder.document.places import Target
from site_builder.pages.term_lists import Atlas, Letters, Place, atlas, by_letter

OFTEN = 2
"""Uses of a term in a section from which on the index names the section."""


@dataclass(frozen=True, slots=True)
class IndexEntry:
    """A line of the index."""

    name: str
    places: tuple[Place, ...]
    see: str = ""
    """The name that has the places of this one; nothing where they are here."""


def view_index(book: Book) -> Letters[IndexEntry]:
    """Terms with the sections that use them, their other names, and what authors marked."""
    places: dict[str, list[Place]] = {item.term.name: [] for item in book.glossary}
    explained = {item.term.name: item.explained for item in book.glossary}
    chapters = [atlas(chapter) for chapter in book.chapters]
    for chapter in chapters:
        for name, place in _sections(chapter, explained):
            places[name].append(place)
    for chapter in chapters:
        for mark in chapter.chapter.index_marks:
            there = chapter.place(mark.section, mark.element)
            places.setdefault(mark.entry, []).append(there)
    entries = [IndexEntry(name, tuple(found)) for name, found in places.items()]
    entries += [
        IndexEntry(name, (), see=definition.term.name)
        for definition in book.glossary
        for name in definition.term.also
    ]
    return by_letter((entry.name, entry) for entry in entries)


def _sections(places: Atlas, explained: Mapping[str, Target | None]) -> Iterator[tuple[str, Place]]:
    """Of the chapter, those that explain a term or use it often."""
    uses = Counter((use.term, use.section) for use in places.chapter.term_uses)
    for (name, section), count in uses.items():
        if name not in explained:
            continue
        target = explained[name]
        explains = target is not None and (target.chapter, target.id) == (
            places.card.id,
            section,
        )
        if explains or count >= OFTEN:
            yield name, places.place(section, "", explains=explains)
