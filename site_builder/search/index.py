"""The index of the search, made under Node by the library that the page searches with: a record for
each section of each page that is searched."""

import json
import re
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields
from itertools import count
from pathlib import Path

from site_builder.cache.results import cached_result
from site_builder.document.book import Book
from site_builder.files.engine import STATIC
from site_builder.files.folders import file_hash
from site_builder.languages.words import Words
from site_builder.pages.back_matter import introductions
from site_builder.programs.node import NODE, Package, installed_packages, read_package
from site_builder.render.words import (
    Describe,
    SectionText,
    chapter_sections,
    glossary_sections,
    plain_words,
)


@dataclass(frozen=True, slots=True, kw_only=True)
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
    asked: tuple[str, ...]
    """Words by which readers look for it."""
    text: str
    figures: str
    questions: str


@dataclass(slots=True)
class Records:
    """Makes the records of pages that come in their order."""

    explained: Mapping[str, Sequence[str]]
    """Terms by the address of the section that explains them."""
    search_words: Mapping[str, Sequence[str]] = field(default_factory=dict)
    """Words by which readers look for a section, by its address."""
    _introduced: set[str] = field(default_factory=set)
    _numbers: Iterator[int] = field(default_factory=count)

    def of_page(self, path: str, sections: Sequence[SectionText]) -> tuple[Record, ...]:
        return tuple(self._record(path, section, sections[0].title) for section in sections)

    def _record(self, path: str, section: SectionText, title: str) -> Record:
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
            asked=tuple(self.search_words.get(address, ())),
            text=section.text("text"),
            figures=section.text("figure"),
            questions=section.text("question"),
        )


type PageRecords = tuple[tuple[Record, ...], ...]
"""Number of each page, in the order of the pages."""


def make_records(book: Book, describe: Describe) -> PageRecords:
    """The records of all chapters, then those of the glossary."""
    search_words = {
        _address(f"{section.chapter}/index.html", section.id): words
        for section, words in book.search_words
    }
    records = Records(explained_terms(book), search_words)
    pages = [
        (f"{chapter.url}index.html", chapter_sections(chapter, describe))
        for chapter in book.chapters
    ]
    if book.glossary:
        summary = book.words("glossary.summary", count=len(book.glossary))
        pages.append(("glossary/index.html", tuple(glossary_sections(book, summary))))
    return tuple(records.of_page(path, sections) for path, sections in pages)


def explained_terms(book: Book) -> Mapping[str, Sequence[str]]:
    """By the address of a section: the names of the glossary's terms that it explains, the entries
    that authors have marked in it for the index, and the symbols that it introduces."""
    explained: dict[str, list[str]] = {}
    for definition in book.glossary:
        if target := definition.explained:
            address = _address(f"{target.chapter}/index.html", target.id)
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


HERE = Path(__file__).parent
SEARCH = "minisearch/dist/es/index.js"
STEMMERS = {"en": "stemmer/index.js", "de": "@orama/stemmers/dist/de.js"}
"""Shipped modules of packages, by language; they import nothing."""
PLAIN = "plain.mjs"
"""In this folder, for languages without one."""
LICENCES = {"minisearch": "LICENSE.txt", "stemmer": "license", "@orama/stemmers": "LICENSE.md"}


@dataclass(frozen=True, slots=True)
class SearchLibrary:
    """The scripts of the library by name; none where they could not be had."""

    scripts: Mapping[str, Path]
    packages: tuple[Package, ...] = ()


def fetch_library(language: str) -> SearchLibrary:
    """The library for pages in this language. Raises `NodeError` where it cannot be had."""
    packages = installed_packages(HERE) / "node_modules"
    shipped = {"minisearch.js": SEARCH, "stemmer.js": STEMMERS.get(language, PLAIN)}
    return SearchLibrary(
        {name: HERE / path if path == PLAIN else packages / path for name, path in shipped.items()},
        tuple(
            read_package(packages / name, licence)
            for name, licence in LICENCES.items()
            if any(path.startswith(f"{name}/") for path in shipped.values())
        ),
    )


NAMES = tuple(each.name for each in fields(Record))
SHARED = ("js/search/ranking.ts", "js/search/words.ts")
"""What index and page share, below ``static/``."""
PROGRAM = HERE / "index.mjs"


def index_of(records: PageRecords, library: SearchLibrary, words: Words) -> bytes:
    """The index as JSON, for pages in the language of ``words``. Raises `RuntimeError` with Node's
    words where it cannot be made."""
    lines = "\n".join(map(_line, records))
    scripts = (*library.scripts.values(), *(STATIC / name for name in SHARED))
    compared = words("script.search.stop_words"), words("script.search.synonyms")
    given = (lines, [file_hash(file) for file in (*scripts, PROGRAM)], compared)
    return cached_result("index", given, lambda: _index(lines, scripts, compared))


def _index(lines: str, scripts: Sequence[Path], compared: Sequence[str]) -> bytes:
    """``compared``: stop words and synonyms."""
    command = [str(NODE), "--no-warnings", *map(str, (PROGRAM, *scripts)), *compared]
    done = subprocess.run(command, input=lines, capture_output=True, encoding="utf-8", check=False)
    if done.returncode:
        raise RuntimeError(f"the search index could not be made: {done.stderr}")
    return done.stdout.encode()


def _line(records: Sequence[Record]) -> str:
    return json.dumps([{name: getattr(record, name) for name in NAMES} for record in records])
