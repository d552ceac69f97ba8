"""The index of terms as its template needs it: where the glossary's terms and the author's own
marks stand."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from site_builder.book import Book
from site_builder.page_model.places import Definition
from site_builder.pages.places import Letters, Place, by_letter, place

OFTEN = 2
"""Uses of a term in a section from which the index leads there: named once is not spoken of."""


@dataclass(frozen=True, slots=True)
class IndexEntry:
    """A line of the index."""

    name: str
    places: tuple[Place, ...]
    see: str = ""
    """The name that has the places of this one; nothing where they are here."""


def view_index(book: Book) -> Letters[IndexEntry]:
    """Terms with the sections that speak of them, their other names, and what authors marked."""
    places: dict[str, list[Place]] = {}
    for definition in book.glossary:
        places.setdefault(definition.term.name, []).extend(_sections(definition, book))
    for chapter in book.chapters:
        for mark in chapter.index_marks:
            there = place(chapter, mark.section, mark.element)
            places.setdefault(mark.entry, []).append(there)
    entries = [IndexEntry(name, tuple(found)) for name, found in places.items()]
    entries += [
        IndexEntry(name, (), see=definition.term.name)
        for definition in book.glossary
        for name in definition.term.also
    ]
    return by_letter((entry.name, entry) for entry in entries)


def _sections(definition: Definition, book: Book) -> Iterator[Place]:
    """Those that explain the term or use it often."""
    target = definition.explained
    for chapter in book.chapters:
        uses = [use for use in chapter.term_uses if use.term == definition.term.name]
        for section, count in Counter(use.section for use in uses).items():
            explains = target is not None and (target.chapter, target.id) == (chapter.id, section)
            if explains or count >= OFTEN:
                yield place(chapter, section, "", explains=explains)
