"""``content/references.bib``: the works that chapters cite, in BibTeX.

pybtex reads the format and `references/latex.py` its texts; what an entry must say is checked here,
so that every reference can be found by its reader. Exports of reference managers are taken as they
are: biblatex's names of fields and kinds are read, fields that no reference shows are ignored.
"""

import re
from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, replace
from functools import partial
from string import ascii_lowercase
from types import MappingProxyType
from typing import Any

from site_builder.diagnostics.diagnostic import Diagnostics, nearest, unknown
from site_builder.files.text import Sources
from site_builder.languages.words import ENGLISH, Words
from site_builder.references.latex import text_of_latex, web_address

FILE = "content/references.bib"
REQUIRED: Mapping[str, tuple[str, ...]] = {
    "article": ("author", "title", "journal", "year"),
    "inproceedings": ("author", "title", "booktitle", "year"),
    "incollection": ("author", "title", "booktitle", "year"),
    "book": ("author", "title", "publisher", "year"),
    "techreport": ("author", "title", "institution", "year"),
    "phdthesis": ("author", "title", "school", "year"),
    "misc": ("author", "title", "year"),
}
"""Kinds of entry, and what each must say."""
KINDS = {
    "conference": "inproceedings", "inbook": "incollection", "inreference": "incollection",
    "mastersthesis": "phdthesis", "thesis": "phdthesis", "report": "techreport",
    "collection": "book", "proceedings": "misc", "online": "misc", "manual": "misc",
    "dataset": "misc",
}  # fmt: skip
"""Kinds that are read as another one; so are all that are unknown, as ``misc``."""
FIELDS = {"journaltitle": "journal", "date": "year", "organization": "publisher"}
"""Fields that are read as another one, where that is missing."""
OPTIONAL = (
    "volume", "number", "pages", "edition", "publisher", "doi", "url", "isbn", "note",
    "howpublished",
)  # fmt: skip
IGNORED = (
    "editor", "editora", "issn", "month", "annote", "subtitle", "booksubtitle", "maintitle",
    "numpages", "origyear", "origtitle", "urlyear", "shorttitle", "titleaddon",
)  # fmt: skip
"""Fields that no reference shows and that resemble one that it does."""
MISSPELT = 0.75
"""How alike the names of two fields or kinds are, from 0 to 1, where one was meant."""
FIELD = re.compile(r"\s*[\w-]+\s*=")
ENTRY = re.compile(r"\s*@(\w+)\s*\{\s*([^,\s]+)\s*,")


@dataclass(frozen=True, slots=True, kw_only=True)
class Work:
    key: str
    kind: str
    """``article``, ``book``, …"""
    authors: tuple[tuple[str, str], ...]
    """Given names and family name; an institution has the latter only."""
    fields: Mapping[str, str]
    """All others, as plain text."""
    line: int
    letter: str = ""
    """Tells works apart that have the same authors and year: ``a``."""
    words: Words = ENGLISH
    """Words of the book that cites it."""

    @property
    def year(self) -> str:
        return f"{self.fields.get('year', '')}{self.letter}"

    @property
    def who(self) -> str:
        """Its authors as a citation names them: ``Kannala and Brandt``, ``Wang et al.``"""
        names = [family for _, family in self.authors]
        return self._and(names) if len(names) < 3 else f"{names[0]} {self._et_al}"

    @property
    def everyone(self) -> str:
        """``Zhang, Z.``; ``Kannala, J. and Brandt, S. S.``; ``Cook, R. L., Porter, T. and …``"""
        initials = partial(re.sub, r"(\w)[\w’']*\.?", r"\1.")
        names = [
            f"{family}, {initials(given)}" if given else family for given, family in self.authors
        ]
        if names[-1:] == ["others"]:
            return f"{', '.join(names[:-1])} {self._et_al}"
        return self._and([*filter(None, [", ".join(names[:-1])]), *names[-1:]])

    @property
    def venue(self) -> str:
        """Where it appeared: journal, volume and pages; publisher; …"""
        said = self.fields.get
        match self.kind:
            case "article":
                volume, number, pages = said("volume", ""), said("number", ""), said("pages", "")
                issue = f"{volume}({number})" if number else volume
                return _listed(f"{said('journal', '')} {issue}".strip(), pages)
            case "inproceedings" | "incollection":
                pages = said("pages", "")
                return _listed(
                    self.words("references.in", title=said("booktitle", "")),
                    pages and self.words("references.pages", pages=pages),
                    said("publisher"),
                )
            case "phdthesis":
                return _listed(self.words("references.thesis"), said("school"))
            case _:
                edition = said("edition", "")
                return _listed(
                    edition and self.words("references.edition", name=edition),
                    said("publisher") or said("institution"),
                    said("number"),
                    said("howpublished"),
                    said("note"),
                )

    def _and(self, names: Sequence[str]) -> str:
        return f" {self.words('references.and')} ".join(names)

    @property
    def _et_al(self) -> str:
        return self.words("references.et_al")

    @property
    def address(self) -> str:
        """Where it is found; nothing where it has no address."""
        doi = re.sub(r"https?://(dx\.)?doi\.org/", "", self.fields.get("doi", ""))
        return f"https://doi.org/{doi}" if doi else self.fields.get("url", "")

    @property
    def reference(self) -> str:
        """The whole reference as a line of text."""
        parts = (f"{self.everyone} ({self.year})", self.fields.get("title", ""), self.venue)
        return " ".join(part + full_stop(part) for part in parts if part)


type Works = Mapping[str, Work]
"""All entries by key, in the order of their authors, years and titles."""
NO_WORKS: Works = MappingProxyType({})


def full_stop(text: str) -> str:
    """What ends a sentence with this text: nothing behind ``Elsevier Inc.``"""
    return "" if text.endswith((".", "?", "!", "…")) else "."


def _listed(*parts: str | None) -> str:
    return ", ".join(part for part in parts if part)


def read_bibliography(sources: Sources, words: Words = ENGLISH) -> Works:
    """The works in the file; none where there is no such file. Mistakes are reported."""
    if not sources.has(FILE):
        return NO_WORKS
    # Here and below: slow to import, and not needed while the bibliography is cached.
    from pybtex.database import parse_string
    from pybtex.exceptions import PybtexError

    text, problems = sources.text(FILE), sources.problems
    try:
        entries = parse_string(text, "bibtex").entries
    except (PybtexError, RecursionError) as error:
        line, said = _unclosed(text)
        if not said:
            line = getattr(error, "lineno", None) or _line_of(str(error), text)
            advice = "; legal: names with 'and' between them" if "commas" in str(error) else ""
            advice = "; legal: a comma behind each field" if "expected" in str(error) else advice
            said = re.sub(r" in line \d+", "", str(error)) + advice
        problems.add(FILE, line, f"malformed BibTeX: {said}", spoils=("unknown work",))
        return NO_WORKS
    lines = _lines(text)
    works = [
        _work(key, entry, lines.get(key, 1), words, problems) for key, entry in entries.items()
    ]
    return {work.key: work for work in _with_letters(sorted(works, key=_order))}


def _unclosed(text: str) -> tuple[int, str]:
    """The line of a brace that is never closed, and what is wrong there; nothing without one."""
    key, depth, field, opened = "", 0, 0, 0
    for number, line in enumerate([*text.split("\n"), "@end{end,"], start=1):
        if entry := ENTRY.match(line):
            if depth:
                return opened or field, f"a brace of {key!r} is never closed; legal: '{{…}}'"
            key, field, opened = entry[2], number, 0
        elif FIELD.match(line):
            opened = opened or (field if depth > 1 else 0)
            field = number
        depth += line.count("{") - line.count("}")
    return 1, ""


def _lines(text: str) -> dict[str, int]:
    """Where each entry begins."""
    found = ((ENTRY.match(line), number) for number, line in enumerate(text.split("\n"), start=1))
    return {match[2]: number for match, number in found if match}


def _line_of(message: str, text: str) -> int:
    """Line of what the message quotes, or of the last entry whose key it names."""
    _, mark, quoted = message.partition("'")
    place = text.find(quoted.removesuffix("'")) if mark else -1
    if place >= 0:
        return text.count("\n", 0, place) + 1
    named = [line for key, line in _lines(text).items() if key in message]
    return max(named, default=1)


def _work(key: str, entry: Any, line: int, words: Words, problems: Diagnostics) -> Work:
    """The work that an entry describes. Mistakes are reported."""

    def plain(name: str, latex: str) -> str:
        try:
            return web_address(latex) if name in ("url", "doi") else text_of_latex(latex)
        except ValueError as error:
            what, _, legal = str(error).partition("; ")
            problems.add(FILE, line, f"{what} in {name!r} of {key!r}; {legal}")
            return latex

    given = {name.lower(): value for name, value in entry.fields.items()}
    for other, name in FIELDS.items():
        if other in given:
            given.setdefault(name, given[other][:4] if other == "date" else given[other])
    authors = entry.persons.get("author") or entry.persons.get("editor") or ()
    names = (
        (
            " ".join([*person.first_names, *person.middle_names]),
            " ".join([*person.prelast_names, *person.last_names, *person.lineage_names]),
        )
        for person in authors
    )
    kind = entry.type if entry.type in REQUIRED else KINDS.get(entry.type, "misc")
    if kind in ("phdthesis", "techreport") and "institution" in given:
        given.setdefault("school", given["institution"])
    shown = {*REQUIRED[kind], *OPTIONAL}
    work = Work(
        key=key,
        kind=kind,
        authors=tuple((plain("author", first), plain("author", last)) for first, last in names),
        fields={name: plain(name, value) for name, value in given.items() if name in shown},
        line=line,
        words=words,
    )
    _check(work, entry.type, {*given, *(["author"] if authors else [])}, problems)
    return work


def _order(work: Work) -> tuple[str, ...]:
    names = [f"{family} {given}" for given, family in work.authors]
    return (*(name.casefold() for name in names[:1]), work.fields.get("year", ""), work.key)


def _with_letters(works: list[Work]) -> list[Work]:
    """Works of the same authors and year get letters that tell them apart."""
    labels = [(work.who, work.year) for work in works]
    return [
        replace(work, letter=_letters(labels[:at].count(label)))
        if labels.count(label) > 1
        else work
        for at, (work, label) in enumerate(zip(works, labels, strict=True))
    ]


def _letters(place: int) -> str:
    """
    >>> [_letters(place) for place in (0, 25, 26, 53)]
    ['a', 'z', 'aa', 'bb']
    """
    round_, last = divmod(place, len(ascii_lowercase))
    return (_letters(round_ - 1) if round_ else "") + ascii_lowercase[last]


def _check(work: Work, kind: str, given: Set[str], problems: Diagnostics) -> None:
    """Report missing fields, addresses that lead nowhere, and misspelt names of fields and kinds.
    The fields ``given`` include those that no reference shows."""
    if kind not in {*REQUIRED, *KINDS} and nearest(kind, {*REQUIRED, *KINDS}, MISSPELT):
        problems.add(FILE, work.line, unknown("kind of entry", kind, [*REQUIRED, *KINDS]))
        return
    required = REQUIRED[work.kind]
    known = {*required, *OPTIONAL, *(("author", "title", "year", *FIELDS))}
    misspelt = {
        name: near
        for name in given - known - {*IGNORED}
        if (near := nearest(name, known - given, MISSPELT))
    }
    for name in misspelt:
        problems.add(FILE, work.line, unknown(f"field of {work.key!r}", name, known))
    for name in required:
        if name not in given and name not in misspelt.values():
            message = f"{work.key!r} has no {name!r}; legal: {name} = {{…}}"
            problems.add(FILE, work.line, message)
    if (doi := work.fields.get("doi")) and not re.fullmatch(
        r"(https?://(dx\.)?doi\.org/)?10\.\d{4,9}/\S+", doi
    ):
        problems.add(FILE, work.line, f"doi {doi!r} of {work.key!r}; legal: '10.…/…'")
    if (url := work.fields.get("url")) and not re.fullmatch(r"https?://[^\s\"'<>]+", url):
        problems.add(FILE, work.line, f"url {url!r} of {work.key!r}; legal: 'https://…'")
