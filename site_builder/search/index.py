"""The index of the search, made under Node by the library that the page searches with."""

import json
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path

from site_builder.cache.results import cached_result
from site_builder.document.book import Book
from site_builder.files.engine import STATIC
from site_builder.files.folders import file_hash
from site_builder.languages.words import Words
from site_builder.programs.node import NODE, Package, installed_packages, read_package
from site_builder.render.sections import Describe
from site_builder.search.records import PageRecords, Record, make_records, translated_records

HERE = Path(__file__).parent
SEARCH = "minisearch/dist/es/index.js"
STEMMERS = {"en": "stemmer/index.js", "de": "@orama/stemmers/dist/de.js"}
"""Shipped modules of packages, by language; they import nothing."""
LICENCES = {
    "minisearch": "LICENSE.txt",
    "stemmer": "license",
    "@orama/stemmers": "LICENSE.md",
}


@dataclass(frozen=True, slots=True)
class SearchLibrary:
    """The scripts of the library by name; none where they could not be had."""

    scripts: Mapping[str, Path]
    packages: tuple[Package, ...] = ()
    stemmers: Mapping[str, str] = field(default_factory=dict)
    """Names of scripts by language."""


def fetch_library(*languages: str) -> SearchLibrary:
    """The library for pages in these. Raises `NodeError` where it cannot be had."""
    packages = installed_packages(HERE) / "node_modules"
    stemmers = {language: f"stemmer-{language}.js" for language in languages}
    shipped = {
        "minisearch.js": SEARCH,
        **{name: STEMMERS[language] for language, name in stemmers.items()},
    }
    return SearchLibrary(
        {name: packages / path for name, path in shipped.items()},
        tuple(
            read_package(packages / name, licence)
            for name, licence in LICENCES.items()
            if any(path.startswith(f"{name}/") for path in shipped.values())
        ),
        stemmers,
    )


NAMES = tuple(each.name for each in fields(Record))
SHARED = ("js/search/ranking.ts", "js/search/words.ts")
"""What index and page share, below ``static/``."""
PROGRAM = HERE / "index.mjs"


@dataclass(frozen=True, slots=True)
class Means:
    """What an index is made with."""

    scripts: tuple[Path, ...]
    compared: tuple[str, str]
    """Stop words and synonyms."""


def make_indices(
    book: Book, translations: Sequence[Book], describe: Describe, library: SearchLibrary
) -> Iterator[tuple[str, bytes]]:
    """Path and index of the book, and of each translation what it has of its own: `search/de.json`.
    Pages look for them there; they are made of the pages, which cannot carry a hash of them."""
    yield "search/index.json", index_of(make_records(book, describe), indexing(library, book.words))
    for each in translations:
        records, means = translated_records(each, describe), indexing(library, each.words)
        yield f"search/{each.words.language}.json", index_of(records, means)


def indexing(library: SearchLibrary, words: Words) -> Means:
    """For pages in the language of ``words``."""
    names = ("minisearch.js", library.stemmers[words.language])
    return Means(
        (*(library.scripts[name] for name in names), *(STATIC / name for name in SHARED)),
        (words("script.search.stop_words"), words("script.search.synonyms")),
    )


def index_of(records: PageRecords, means: Means) -> bytes:
    """The index as JSON. Raises `RuntimeError` with Node's words where it cannot be made."""
    lines = "\n".join(map(_line, records))
    scripts = [file_hash(file) for file in (*means.scripts, PROGRAM)]
    given = (lines, scripts, means.compared)
    return cached_result("index", given, lambda: _index(lines, means))


def _index(lines: str, means: Means) -> bytes:
    scripts = map(str, (PROGRAM, *means.scripts))
    command = [str(NODE), "--no-warnings", *scripts, *means.compared]
    done = subprocess.run(command, input=lines, capture_output=True, encoding="utf-8", check=False)
    if done.returncode:
        raise RuntimeError(f"the search index could not be made: {done.stderr}")
    return done.stdout.encode()


def _line(records: Sequence[Record]) -> str:
    return json.dumps([{name: getattr(record, name) for name in NAMES} for record in records])
