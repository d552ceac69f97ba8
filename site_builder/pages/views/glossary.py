"""The glossary as its template needs it, and what a chapter's marks tell."""

from collections.abc import Iterator
from dataclasses import dataclass

from site_builder.book import Book, Chapter
from site_builder.page_model.places import Definition
from site_builder.pages.places import Letters, Place, by_letter, place


@dataclass(frozen=True, slots=True)
class Entry:
    """A term with its places."""

    definition: Definition
    explained: Place | None
    uses: tuple[Place, ...]
    """The first in each chapter."""
    related: tuple[Definition, ...]


def marked_terms(chapter: Chapter, book: Book) -> list[Definition]:
    """What the chapter's marks tell."""
    marked = {use.term for use in chapter.term_uses if use.element}
    return [definition for definition in book.glossary if definition.term.name in marked]


def view_glossary(book: Book) -> Letters[Entry]:
    """Every entry, under its letter."""
    return by_letter((item.term.name, _entry(item, book)) for item in book.glossary)


def _entry(definition: Definition, book: Book) -> Entry:
    target, explained = definition.explained, None
    for chapter in book.chapters:
        if target and chapter.id == target.chapter:
            explained = place(chapter, target.id, target.id, explains=True)
    related = [other for other in book.glossary if other.term.name in definition.term.related]
    return Entry(definition, explained, tuple(_first_uses(definition, book)), tuple(related))


def _first_uses(definition: Definition, book: Book) -> Iterator[Place]:
    """By chapter, the use that is marked or, where none is, the first."""
    for chapter in book.chapters:
        uses = [use for use in chapter.term_uses if use.term == definition.term.name]
        for use in sorted(uses, key=lambda use: not use.element)[:1]:
            yield place(chapter, use.section, use.element)
