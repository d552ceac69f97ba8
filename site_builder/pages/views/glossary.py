"""The glossary as its template needs it, and the terms that a chapter marks."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from site_builder.document.book import Book, Chapter
from site_builder.document.places import Definition
from site_builder.pages.term_lists import Atlas, Letters, Place, atlas, by_letter


@dataclass(frozen=True, slots=True)
class Entry:
    """A term with its places."""

    definition: Definition
    explained: Place | None
    uses: tuple[Place, ...]
    """The first in each chapter."""
    related: tuple[Definition, ...]


def marked_terms(chapter: Chapter, book: Book) -> list[Definition]:
    """The definitions that the chapter shows in place."""
    marked = {use.term for use in chapter.term_uses if use.element}
    return [definition for definition in book.glossary if definition.term.name in marked]


def view_glossary(book: Book) -> Letters[Entry]:
    """Every entry, under its letter."""
    places = {chapter.id: atlas(chapter) for chapter in book.chapters}
    uses = _first_uses(list(places.values()))
    by_name = {item.term.name: item for item in book.glossary}
    return by_letter(
        (item.term.name, _entry(item, places, uses.get(item.term.name, ()), by_name))
        for item in book.glossary
    )


def _entry(
    definition: Definition,
    places: Mapping[str, Atlas],
    uses: Sequence[Place],
    by_name: Mapping[str, Definition],
) -> Entry:
    target, explained = definition.explained, None
    if target and target.chapter in places:
        explained = places[target.chapter].place(target.id, target.id, explains=True)
    related = set(definition.term.related)
    others = tuple(other for name, other in by_name.items() if name in related)
    return Entry(definition, explained, tuple(uses), others)


def _first_uses(chapters: Sequence[Atlas]) -> Mapping[str, Sequence[Place]]:
    """By term and chapter, the use that is marked or, where none is, the first."""
    found: dict[str, list[Place]] = {}
    for places in chapters:
        first: dict[str, Place] = {}
        for use in sorted(places.chapter.term_uses, key=lambda use: not use.element):
            if use.term not in first:
                first[use.term] = places.place(use.section, use.element)
        for term, place in first.items():
            found.setdefault(term, []).append(place)
    return found
