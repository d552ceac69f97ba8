"""``content/references.bib``: the works that chapters cite, in BibTeX.

pybtex reads the format; what an entry must say is checked here, so that every reference can be
found by its reader.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from string import ascii_lowercase
from types import MappingProxyType
from typing import Any

from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.files.text import Sources
from site_builder.languages.words import ENGLISH, Words

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
OPTIONAL = (
    "volume", "number", "pages", "edition", "publisher", "doi", "url", "isbn", "note",
)  # fmt: skip
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
        doi = self.fields.get("doi")
        return f"https://doi.org/{doi}" if doi else self.fields.get("url", "")

    @property
    def reference(self) -> str:
        """The whole reference as a line of text."""
        parts = (f"{self.everyone} ({self.year})", self.fields.get("title", ""), self.venue)
        return f"{'. '.join(filter(None, parts))}."


type Works = Mapping[str, Work]
"""All entries by key, in the order of their authors, years and titles."""
NO_WORKS: Works = MappingProxyType({})


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
        lines = _lines(text)
        works = [_work(key, entry, lines.get(key, 1), words) for key, entry in entries.items()]
    except (PybtexError, RecursionError) as error:
        line = getattr(error, "lineno", None) or _line_of(str(error), text)
        message = f"malformed BibTeX: {error}{_advice(str(error))}"
        problems.add(FILE, line, message, spoils=("unknown work",))
        return NO_WORKS
    for work in works:
        _check(work, problems)
    return {work.key: work for work in _with_letters(sorted(works, key=_order))}


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


def _advice(message: str) -> str:
    return "; legal: names with 'and' between them" if "commas" in message else ""


def _work(key: str, entry: Any, line: int, words: Words) -> Work:
    authors = entry.persons.get("author") or entry.persons.get("editor") or ()
    names = (
        (
            " ".join([*person.first_names, *person.middle_names]),
            " ".join([*person.prelast_names, *person.last_names, *person.lineage_names]),
        )
        for person in authors
    )
    return Work(
        key=key,
        kind=entry.type,
        authors=tuple((_plain(given), _plain(family)) for given, family in names),
        fields={name.lower(): _plain(value) for name, value in entry.fields.items()},
        line=line,
        words=words,
    )


def _plain(latex: str) -> str:
    """Text without braces and accents' commands; two hyphens are a range's dash."""
    from pybtex.richtext import Text

    return str(Text.from_latex(latex)).replace("--", "–").strip()


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


def _check(work: Work, problems: Diagnostics) -> None:
    """Report unknown kinds and fields, and missing ones."""
    if work.kind not in REQUIRED:
        problems.add(FILE, work.line, unknown("kind of entry", work.kind, REQUIRED))
        return
    given = {*work.fields, *(["author"] if work.authors else [])}
    for name in REQUIRED[work.kind]:
        if name not in given:
            message = f"{work.key!r} has no {name!r}; legal: {name} = {{…}}"
            problems.add(FILE, work.line, message)
    expected = (*REQUIRED[work.kind], *OPTIONAL)
    for name in given - set(expected):
        problems.add(FILE, work.line, unknown(f"field of {work.key!r}", name, expected))
    if (doi := work.fields.get("doi")) and not re.fullmatch(r"10\.\d{4,9}/\S+", doi):
        message = f"doi {doi!r} of {work.key!r}; legal: '10.…/…', without an address"
        problems.add(FILE, work.line, message)
    if (url := work.fields.get("url")) and not re.fullmatch(r"https?://[^\s\"'<>]+", url):
        problems.add(FILE, work.line, f"url {url!r} of {work.key!r}; legal: 'https://…'")
