"""The pages behind the chapters: glossary, index, references and symbols."""

import unicodedata
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from site_builder.document.book import Book, Chapter
from site_builder.document.places import Definition, Meaning, Passage, Target
from site_builder.languages.words import Words
from site_builder.markdown.glossary import meanings_in
from site_builder.markdown.text.symbols import covers, spelt, symbols_of
from site_builder.references.bibliography import Work


@dataclass(frozen=True, slots=True, kw_only=True)
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
class TermLink:
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
    chapter: Chapter
    card: Card
    words: Mapping[str, Passage]
    """Its headings, by element id."""

    def place(self, section: str, element: str, *, explains: bool = False) -> TermLink:
        """Link to an element below the heading ``section``, or to the heading itself."""
        anchor = element or section
        address = f"{self.card.url}#{anchor}" if anchor else self.card.url
        return TermLink(address, self.card, self.words.get(section, Passage()), explains)


def atlas(chapter: Chapter) -> Atlas:
    words = {heading.id: heading.words for heading in chapter.headings}
    return Atlas(chapter, card(chapter), words)


def card(chapter: Chapter) -> Card:
    return Card(**{name: getattr(chapter, name) for name in Card.__slots__})


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


@dataclass(frozen=True, slots=True)
class GlossaryEntry:
    definition: Definition
    explained: TermLink | None
    uses: tuple[TermLink, ...]
    """The first in each chapter."""
    related: tuple[Definition, ...]


def marked_terms(chapter: Chapter, book: Book) -> list[Definition]:
    """The definitions that the chapter shows in place."""
    marked = {use.term for use in chapter.term_uses if use.element}
    return [definition for definition in book.glossary if definition.term.name in marked]


def view_glossary(book: Book) -> Letters[GlossaryEntry]:
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
    uses: Sequence[TermLink],
    by_name: Mapping[str, Definition],
) -> GlossaryEntry:
    target, explained = definition.explained, None
    if target and target.chapter in places:
        explained = places[target.chapter].place(target.id, target.id, explains=True)
    related = set(definition.term.related)
    others = tuple(other for name, other in by_name.items() if name in related)
    return GlossaryEntry(definition, explained, tuple(uses), others)


def _first_uses(chapters: Sequence[Atlas]) -> Mapping[str, Sequence[TermLink]]:
    """The marked use of each term in each chapter or, where none is, the first."""
    found: dict[str, list[TermLink]] = {}
    for places in chapters:
        first: dict[str, TermLink] = {}
        for use in sorted(places.chapter.term_uses, key=lambda use: not use.element):
            if use.term not in first:
                first[use.term] = places.place(use.section, use.element)
        for term, place in first.items():
            found.setdefault(term, []).append(place)
    return found


OFTEN = 2
"""Uses of a term in a section from which on the index names the section."""


@dataclass(frozen=True, slots=True)
class IndexEntry:
    name: str
    places: tuple[TermLink, ...]
    see: str = ""
    """The name that has the places of this one; nothing where they are here."""


def view_index(book: Book) -> Letters[IndexEntry]:
    """Terms with the sections that use them, their other names, and what authors marked."""
    places: dict[str, list[TermLink]] = {item.term.name: [] for item in book.glossary}
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


def _sections(
    places: Atlas, explained: Mapping[str, Target | None]
) -> Iterator[tuple[str, TermLink]]:
    """Links in the chapter to places that explain a term or use it often."""
    uses = Counter((use.term, use.section) for use in places.chapter.term_uses)
    for (name, section), count in uses.items():
        if name not in explained:
            continue
        target, here = explained[name], (places.card.id, section)
        explains = target is not None and (target.chapter, target.id) == here
        if explains or count >= OFTEN:
            yield name, places.place(section, "", explains=explains)


type Places = list[tuple[Card, list[str]]]


def cited_works(book: Book) -> list[tuple[Work, Places]]:
    """Each work with, by chapter, the element ids of its citations."""
    places: dict[str, Places] = {key: [] for key in book.bibliography}
    for chapter in book.chapters:
        ids: dict[str, list[str]] = {}
        for citation in chapter.citations:
            ids.setdefault(citation.key, []).append(citation.id)
        for key, found in ids.items():
            places.setdefault(key, []).append((card(chapter), found))
    return [(work, places[key]) for key, work in book.bibliography.items()]


def view_symbols(book: Book) -> list[tuple[Card, list[tuple[Meaning, TermLink]]]]:
    """The meanings of each chapter's symbols, in the order of their first use, each with the
    section in which it is introduced."""
    chapters = ((atlas(chapter), introductions(book, chapter)) for chapter in book.chapters)
    return [
        (places.card, [(item, places.place(section, section)) for item, section in rows])
        for places, rows in chapters
        if rows
    ]


def introductions(book: Book, chapter: Chapter) -> list[tuple[Meaning, str]]:
    """Each meaning, and the section in which its symbol is first used."""
    rows: dict[str, tuple[Meaning, str]] = {}
    seen: set[str] = set()
    expected = [(spelt(item.symbol.tex), item) for item in meanings_in(book, chapter)]
    for formula in sorted(chapter.formulae, key=lambda formula: formula.line):
        for symbol in symbols_of(formula.tex):
            if symbol in seen:
                continue
            seen.add(symbol)
            # An exact match comes before a symbol without the index.
            found = sorted(expected, key=lambda pair: pair[0] != symbol)
            item = next((item for name, item in found if covers(name, symbol)), None)
            if item:
                rows.setdefault(item.symbol.tex, (item, formula.section))
    return list(rows.values())


BACK_MATTER = {
    "glossary": "glossary.title",
    "symbols": "symbols.title",
    "references": "references.title",
    "index-of-terms": "index.title",
    "lecture-plan": "plan.title",
}
"""Keys of their titles, by address."""


def back_matter_pages(book: Book) -> dict[str, dict[str, Any]]:
    """The contexts of the templates of the pages after the chapters, by address."""
    found: dict[str, dict[str, Any]] = {
        "glossary": {"letters": view_glossary(book)} if book.glossary else {},
        "symbols": {"chapters": view_symbols(book)} if book.symbols else {},
        "references": {"works": cited_works(book)} if book.bibliography else {},
        "index-of-terms": {"letters": letters} if (letters := view_index(book)) else {},
        "lecture-plan": {"plan": book.lecture_plan} if book.lecture_plan else {},
    }
    return {name: context for name, context in found.items() if context}


def titled(addresses: Iterable[str], words: Words) -> list[tuple[str, str]]:
    """Addresses and titles, for the contents."""
    return [(address, words(BACK_MATTER[address])) for address in addresses]
