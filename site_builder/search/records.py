"""What the search finds: a record for each section of each page that is searched."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count

from site_builder.document.book import Book
from site_builder.pages.back_matter import introductions
from site_builder.render.sections import Describe, Section, chapter_sections, glossary_sections
from site_builder.render.words import plain_words


@dataclass(frozen=True, slots=True)
class Record:
    """A section as the index stores it; the names are those of ``static/js/search/ranking.ts``."""

    id: int
    address: str
    """Relative to the site's root."""
    chapter: str
    """Title of its page."""
    title: str
    """Its heading; nothing for what stands before a page's first."""
    introduced: tuple[str, ...]
    """Terms that the book emphasises here first."""
    explains: tuple[str, ...]
    """Names of the glossary's terms that are explained here, entries of the index that lead here,
    and symbols that are introduced here."""
    text: str
    figures: str
    questions: str


@dataclass(slots=True)
class Records:
    """Makes the records of pages that come in their order."""

    explained: Mapping[str, Sequence[str]]
    """Terms by the address of the section that explains them."""
    _introduced: set[str] = field(default_factory=set)
    _numbers: Iterator[int] = field(default_factory=count)

    def of_page(self, path: str, sections: Sequence[Section]) -> tuple[Record, ...]:
        return tuple(self._record(path, section, sections[0].title) for section in sections)

    def _record(self, path: str, section: Section, title: str) -> Record:
        introduced = self._introduced
        fresh = [term for term in section.terms if term.casefold() not in introduced]
        if section.anchor:  # what stands before it names things that are explained later
            introduced |= {term.casefold() for term in fresh}
        address = _address(path, section.anchor)
        return Record(
            id=next(self._numbers),
            address=address,
            chapter=title,
            title=section.title if section.anchor else "",
            introduced=tuple(fresh),
            explains=tuple(self.explained.get(address, ())),
            text=section.text,
            figures=section.figures,
            questions=section.questions,
        )


type PageRecords = tuple[tuple[Record, ...], ...]
"""Number of each page, in the order of the pages."""


def make_records(book: Book, describe: Describe) -> PageRecords:
    """The records of all chapters, then those of the glossary."""
    records = Records(explained_terms(book))
    pages = [
        (f"{chapter.url}index.html", chapter_sections(chapter, describe))
        for chapter in book.chapters
    ]
    if book.glossary:
        summary = book.words("glossary.summary", count=len(book.glossary))
        pages.append(("glossary/index.html", tuple(glossary_sections(book, summary))))
    return tuple(records.of_page(path, sections) for path, sections in pages)


def translated_records(book: Book, describe: Describe) -> PageRecords:
    """Records of the chapters that a translation has; the others are in the original's."""
    records = Records(explained_terms(book))
    return tuple(
        records.of_page(f"{chapter.url}index.html", chapter_sections(chapter, describe))
        for chapter in book.chapters
        if chapter.folder
    )


def explained_terms(book: Book) -> Mapping[str, Sequence[str]]:
    """By the address of a section: the names of the glossary's terms that it explains, the entries
    that authors have marked in it for the index, and the symbols that it introduces."""
    explained: dict[str, list[str]] = {}
    for definition in book.glossary:
        if target := definition.explained:
            address = _address(f"{book.folder}{target.chapter}/index.html", target.id)
            explained.setdefault(address, []).extend(definition.term.names)
    for chapter in book.chapters:
        for mark in chapter.index_marks:
            address = _address(f"{chapter.url}index.html", mark.section)
            explained.setdefault(address, []).extend(_names(mark.entry))
        for meaning, section in introductions(book, chapter):
            address = _address(f"{chapter.url}index.html", section)
            explained.setdefault(address, []).append(plain_words(meaning.formula))
    return explained


def _names(entry: str) -> Iterator[str]:
    """
    >>> list(_names("DoF (depth of field)"))
    ['DoF (depth of field)', 'DoF', 'depth of field']
    """
    yield entry
    if parts := re.fullmatch(r"(.+) \((.+)\)", entry):
        yield from parts.groups()


def _address(path: str, anchor: str) -> str:
    folder = path.removesuffix("index.html")
    return f"{folder}#{anchor}" if anchor else folder
