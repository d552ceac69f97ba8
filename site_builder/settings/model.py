"""The keys of ``content/book.toml``. Reading, checks and the table in the guide follow from
these classes."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from site_builder.files.text import Sources, Toml
from site_builder.settings.declared import (
    BOOLEAN,
    DAY,
    DOI,
    FACES,
    ISBN,
    LANGUAGE,
    LETTERS,
    ORIGINS,
    PREFIX,
    SITE,
    SOURCE,
    TEXT,
    Key,
    Reader,
    entries,
    key,
    keys_of,
    table,
    texts,
    whole_number,
)

FILE_NAME = "content/book.toml"
WORD = "the language's word"
ORCID = re.compile(r"\b\d{4}-\d{4}-\d{4}-\d{3}[\dX]$")
HOSTS = ("apache", "netlify", "nginx")
"""Hosts of static sites that a configuration can be written for."""


@dataclass(frozen=True, slots=True)
class BookLicence:
    """Under which terms the book is here."""

    code: str = key(TEXT, "the licence of the code, as the foot of every page names it", "MIT")
    text: str = key(TEXT, "that of text and figures", "CC BY 4.0")
    text_in_full: str = key(
        TEXT,
        "the same, as the page of licences spells it",
        "Creative Commons Attribution 4.0 International",
    )


@dataclass(frozen=True, slots=True)
class Imprint:
    """What the book is cited by."""

    authors: tuple[str, ...] = key(
        texts('["Ada Lovelace", "Name 0000-0002-1825-0097"]'),
        "its authors, an ORCID behind the name where there is one",
        (),
    )
    date: str = key(DAY, "the day on which it appeared", "", without="none")
    edition: str = key(TEXT, "which edition it is, in words", "", without="none")
    isbn: str = key(ISBN, "its number as a book", "", without="none")
    doi: str = key(DOI, "its digital object identifier", "", without="none")

    @property
    def people(self) -> tuple[tuple[str, str], ...]:
        """Name and ORCID of each author; the second is empty where there is none."""
        found = ((author, ORCID.search(author)) for author in self.authors)
        return tuple(
            (author[: orcid.start()].strip() if orcid else author, orcid[0] if orcid else "")
            for author, orcid in found
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Labels:
    """What numbered things are called; nothing where the language's own word holds."""

    chapter: str = key(TEXT, "a chapter", "", without=WORD)
    appendix: str = key(TEXT, "an appendix", "", without=WORD)
    figure: str = key(TEXT, "a figure", "", without=WORD)
    equation: str = key(TEXT, "a displayed equation", "", without=WORD)
    table: str = key(TEXT, "a table", "", without=WORD)
    example: str = key(TEXT, "a worked example", "", without=WORD)
    prediction: str = key(TEXT, "a prediction", "", without=WORD)
    question: str = key(TEXT, "a question", "", without=WORD)


@dataclass(frozen=True, slots=True)
class Publishing:
    """Files for the host of the site."""

    hosts: tuple[str, ...] = key(
        texts(f"[some of {', '.join(f'"{host}"' for host in HOSTS)}]", among=HOSTS),
        "hosts that a configuration is written for, into the site's folder",
        (),
    )
    frames: tuple[str, ...] = key(
        ORIGINS,
        "the sites whose pages may show the book and its figures in frames; `[]`: none but its own",
        ("*",),
        without="all",
    )
    compressed: bool = key(
        BOOLEAN, "whether each file has copies packed by gzip and brotli beside it", False
    )


@dataclass(frozen=True, slots=True)
class Runtime:
    """What figures are computed with."""

    packages: tuple[str, ...] = key(
        texts('["scipy", …]'),
        "packages of Pyodide's release that scenes may import besides numpy",
        (),
    )


@dataclass(frozen=True, slots=True)
class ReadingPath:
    """Sections of several chapters, in the order of a question that runs through them."""

    title: str = key(TEXT, "for whom it is", "", without="no path")
    stops: Mapping[str, str] = key(
        entries('a table of texts with places, "Why so?" = "chapter#section"'),
        "where it leads, in order",
        MappingProxyType({}),
        without="none",
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Theme:
    """How pages look."""

    accent: str = key(TEXT, "links and controls on light and dark paper", "", without="teal")
    text: str = key(FACES, "the faces of text", "", without="Source Serif")
    headings: str = key(FACES, "those of headings", "", without="as text")
    interface: str = key(FACES, "those of controls, tables and labels", "", without="Source Sans")
    code: str = key(FACES, "those of code", "", without="the reader's")
    width: int = key(LETTERS, "letters in a line of text", 66)


@dataclass(frozen=True, slots=True)
class Trust:
    """What goes from the sources into the pages unchecked."""

    raw_html: bool = key(
        BOOLEAN, "whether Markdown may hold HTML, scripts included", False, without="`false`"
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """The whole file."""

    title: str = key(TEXT, "what the book is called")
    subtitle: str = key(TEXT, "what it is about, in a sentence")
    prerequisites: str = key(TEXT, "what its reader should know")
    chapters: tuple[str, ...] = key(
        texts('["00-slug", …]', least=1), "the files of the chapters, in reading order"
    )
    appendices: tuple[str, ...] = key(texts('["00-slug", …]'), "those of the appendices", ())
    parts: Mapping[str, str] = key(
        entries('a table of titles with first chapters, "Geometry" = "chapter"'),
        "parts of the book: headings of its contents, each with the chapter that begins it",
        MappingProxyType({}),
        without="none",
    )
    hero: str = key(TEXT, "the simulation on the title page", "", without="none")
    hero_caption: str = key(TEXT, "a sentence about it", "", without="none")
    made_by: str = key(TEXT, "who made it, in a sentence for the title page", "", without="none")
    search_examples: tuple[str, ...] = key(
        texts('["one", "another"]'), "what one may search for, as the search's card says it", ()
    )
    language: str = key(
        LANGUAGE, "the language of text and interface, of the engine or `content/languages/`", "en"
    )
    first_number: int = key(whole_number(0), "the number of the first chapter", 0)
    first_pass: int = key(
        whole_number(1), "the most minutes of a chapter's first pass", 0, without="any number"
    )
    storage: str = key(
        PREFIX, "begins the names of what a browser stores", "", without="made of the title"
    )
    address: str = key(SITE, "where the book is published", "", without="unknown")
    source: str = key(
        SOURCE, "where its sources can be read, `{path}` for a file's path", "", without="unknown"
    )
    licence: BookLicence = key(
        table(BookLicence), "under which terms the book is here", BookLicence()
    )
    imprint: Imprint = key(table(Imprint), "what the book is cited by", Imprint())
    labels: Labels = key(table(Labels), "what numbered things are called", Labels())
    macros: Mapping[str, str] = key(
        entries("a table of names with TeX, R = '\\mathbb{R}'"),
        "TeX commands of the book's own, `#1` for an argument",
        MappingProxyType({}),
        without="none",
    )
    colours: Mapping[str, str] = key(
        entries('a table of names with colours on light and dark paper, heat = "#ad4209 #f79c63"'),
        "colours of the book's own ideas, for words, formulae and figures",
        MappingProxyType({}),
        without="none",
    )
    starts: Mapping[str, str] = key(
        entries('a table of texts with places, "Begin here" = "chapter#figure-id"'),
        "where the title page invites to start: chapters, sections and figures",
        MappingProxyType({}),
        without="the first chapter",
    )
    path: ReadingPath = key(table(ReadingPath), "a way through the book", ReadingPath())
    boxes: Mapping[str, str] = key(
        entries('a table of names with titles, theorem = "Theorem"'),
        "directives of the book's own, `:::{theorem} Its name`: notes that are numbered under "
        "these titles, and that a `:label:` lets references name",
        MappingProxyType({}),
        without="none",
    )
    publishing: Publishing = key(table(Publishing), "what the site's host is given", Publishing())
    runtime: Runtime = key(table(Runtime), "what figures are computed with", Runtime())
    theme: Theme = key(table(Theme), "how pages look", Theme())
    trust: Trust = key(table(Trust), "what goes into the pages unchecked", Trust())


def read_settings(sources: Sources) -> tuple[Settings, Toml]:
    """The settings and their places in the file; a mistake is reported, and its default holds."""
    read = sources.toml(FILE_NAME) if sources.has(FILE_NAME) else Toml()
    if read is None or not read.text.strip():
        if read is not None:
            required = ", ".join(item.name for item in keys_of(Settings) if item.required)
            sources.problems.add(FILE_NAME, 1, f"no outline; legal: a file with {required}")
        return Settings(title="", subtitle="", prerequisites="", chapters=()), Toml()
    return Reader(FILE_NAME, read, sources.problems).table(Settings, read.table), read


def storage_prefix(settings: Settings) -> str:
    """Begins the names of all that a browser stores for the book: books may share a host."""
    made = re.sub(r"[^a-z0-9]+", "-", settings.title.lower()).strip("-")
    return settings.storage or made or "book"


def settings_table() -> str:
    """A Markdown table with a line for each key, those of tables after their table's name."""
    rows = [f"| {name} | {doc} | {default} |" for name, doc, default in _rows(Settings, "")]
    return "\n".join(["| Key | Sets | Default |", "|---|---|---|", *rows])


def _rows(of: type[Any], prefix: str) -> Iterator[tuple[str, str, str]]:
    for item in keys_of(of):
        name = f"{prefix}{item.name}"
        if item.kind.table:
            yield from _rows(item.kind.table, f"{name}.")
        else:
            expected = item.kind.expected
            example = re.sub(", (.+ = .+)", r", `\1`", expected)
            legal = f"`{expected}`" if expected[0] in '"[' else example
            yield f"`{name}`", f"{item.doc}: {legal}", _default(item)


def _default(item: Key) -> str:
    if item.required:
        return "required"
    if item.without or item.default == ():
        return item.without or "none"
    return f"`{item.default}`"
