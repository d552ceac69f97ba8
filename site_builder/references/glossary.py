"""``content/glossary.toml``: the terms of the book, each with a definition and the section that
explains it.

A table for each term. ``says`` defines it, in one paragraph of Markdown; ``explained`` is a target
as a ``{ref}`` names it. ``also`` lists other names, ``related`` other terms. ``words`` lists what
counts as a use in the text; left out, all its names do, and their plurals.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import groupby
from pathlib import Path

from site_builder.diagnostics import Diagnostics, unknown
from site_builder.languages.words import ENGLISH, Words
from site_builder.source_text import read_toml

FILE = "content/glossary.toml"
TEXTS = ("says", "explained")
LISTS = ("also", "related", "words")


@dataclass(frozen=True, slots=True)
class Term:
    """One entry."""

    name: str
    says: str
    """Its definition, as Markdown."""
    explained: str
    """The section that explains it, as its author names it."""
    also: tuple[str, ...] = ()
    related: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    line: int = 1
    endings: tuple[str, ...] = ("s", "es")
    """Of plurals, in the language of the book."""

    @property
    def id(self) -> str:
        """Of its entry, among the ids of the glossary."""
        return re.sub(r"[^\w]+", "-", self.name.lower()).strip("-")

    @property
    def names(self) -> tuple[str, ...]:
        return (self.name, *self.also)

    def pattern(self) -> Iterator[str]:
        """Regular expressions of what counts as a use."""
        if self.words:
            yield from map(_spelt, self.words)
        else:
            yield from (_spelt(name) + self._plural(name) for name in self.names)

    def _plural(self, name: str) -> str:
        return f"(?:{'|'.join(self.endings)})?" if name[-1:].isalpha() else ""


@dataclass(frozen=True)
class Glossary:
    """All terms by name, in alphabetical order."""

    terms: Mapping[str, Term] = field(default_factory=dict)

    @cached_property
    def _uses(self) -> tuple[re.Pattern[str], tuple[Term, ...]]:
        found = [(form, term) for term in self.terms.values() for form in term.pattern()]
        found.sort(key=lambda pair: len(pair[0]), reverse=True)  # of two names the longer
        found.sort(key=lambda pair: _first(pair[0]))
        # By their first letters: of a word that begins otherwise no form of them is tried.
        groups = [
            rf"(?={letter})(?:{'|'.join(f'({form})' for form, _ in group)})"
            for letter, group in groupby(found, key=lambda pair: _first(pair[0]))
        ]
        whole = re.compile(rf"(?<![\w-])(?:{'|'.join(groups)})(?![\w-])" if groups else r"(?!)")
        return whole, tuple(term for _, term in found)

    def uses(self, text: str) -> Iterator[tuple[Term, int, int]]:
        """Terms in running text, each with where it starts and ends."""
        pattern, terms = self._uses
        for match in pattern.finditer(text):
            yield terms[(match.lastindex or 1) - 1], match.start(), match.end()

    def find(self, name: str) -> Term:
        """The term of that name. Raises `LookupError`."""
        for term in self.terms.values():
            if name in term.names:
                return term
        names = [name for term in self.terms.values() for name in term.names]
        raise LookupError(unknown("term", name, names))


EMPTY = Glossary()


def _spelt(name: str) -> str:
    """As it stands in a text, where a sentence may begin with it."""
    first, rest = re.escape(name[:1]), re.escape(name[1:])
    first = f"[{name[0]}{name[0].upper()}]" if name[:1].islower() else first
    return first + rest.replace("’", "['’]").replace(r"\ ", "[ \u00a0]")


def _first(form: str) -> str:
    """What a form begins with, in both cases."""
    letter = form[1] if form[:1] in "[\\" else form[:1]
    return f"[{re.escape(letter.lower())}{re.escape(letter.upper()[:1])}]"


def read_glossary(root: Path, problems: Diagnostics, words: Words = ENGLISH) -> Glossary:
    """What the file holds; nothing where there is none. Mistakes go to ``problems``."""
    if not (root / FILE).is_file():
        return EMPTY
    read = read_toml(root, FILE, problems)
    if read is None:
        return EMPTY
    endings = tuple(words("language.plural_endings").split())
    terms = [
        replace(_term(name, entry, read.line(name), problems), endings=endings)
        for name, entry in read.table.items()
    ]
    terms.sort(key=lambda term: term.name.casefold())
    glossary = Glossary({term.name: term for term in terms})
    _check_names(glossary, problems)
    return glossary


def _term(name: str, table: object, line: int, problems: Diagnostics) -> Term:
    given = table if isinstance(table, dict) else {}
    for key in given:
        if key not in (*TEXTS, *LISTS):
            problems.add(FILE, line, unknown(f"key of {name!r}", key, (*TEXTS, *LISTS)))
    texts, lists = {}, {}
    for key in TEXTS:
        texts[key] = value = given.get(key, "")
        if not (isinstance(value, str) and value.strip()):
            problems.add(FILE, line, f'{name!r} has no {key!r}; legal: {key} = "some text"')
            texts[key] = ""
    for key in LISTS:
        value = given.get(key, [])
        if not (isinstance(value, list) and all(isinstance(item, str) and item for item in value)):
            problems.add(FILE, line, f'{key!r} of {name!r}; legal: ["one", "another"]')
            value = []
        lists[key] = tuple(value)
    return Term(name, texts["says"].strip(), texts["explained"], **lists, line=line)


def _check_names(glossary: Glossary, problems: Diagnostics) -> None:
    """Report a name that two terms have, and related terms that there are not."""
    first: dict[str, Term] = {}
    for term in glossary.terms.values():
        for name in term.names:
            other = first.setdefault(name, term)
            if other is not term:
                message = f"{name!r} is a name of {other.name!r} too; legal: of one term"
                problems.add(FILE, term.line, message)
        others = [name for name in glossary.terms if name != term.name]
        for name in term.related:
            if name not in others:
                problems.add(
                    FILE, term.line, unknown(f"term related to {term.name!r}", name, others)
                )
