"""``content/glossary.toml``: the terms of the book, each with a definition and the section that
explains it.

A table for each term. ``says`` defines it, in one paragraph of Markdown; ``explained`` is a target
as a ``{ref}`` names it. ``also`` lists other names, ``related`` other terms. ``words`` lists what
counts as a use in the text; left out, all its names do, and their plurals.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import groupby

from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.files.text import Sources
from site_builder.languages.words import ENGLISH, Words
from site_builder.settings.declared import TEXT, Reader, key, texts

FILE = "content/glossary.toml"
NAMES = texts('["one", "another"]')


@dataclass(frozen=True, slots=True)
class Term:
    """One entry."""

    name: str
    says: str = key(TEXT)
    """Its definition, as Markdown."""
    explained: str = key(TEXT)
    """The section that explains it, as its author names it."""
    also: tuple[str, ...] = key(NAMES, default=())
    related: tuple[str, ...] = key(NAMES, default=())
    words: tuple[str, ...] = key(NAMES, default=())
    line: int = 1
    endings: tuple[str, ...] = ("s", "es")
    """Endings of plurals, in the language of the book."""
    original: str = ""
    """Its name in the glossary that this entry is translated from; nothing in that."""

    @property
    def id(self) -> str:
        """Id of its entry, among the ids of the glossary."""
        return re.sub(r"[^\w]+", "-", (self.original or self.name).lower()).strip("-")

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
        # Grouped by their first letters, which makes the search some twenty times as fast.
        groups = [
            rf"(?={letter})(?:{'|'.join(f'({form})' for form, _ in group)})"
            for letter, group in groupby(found, key=lambda pair: _first(pair[0]))
        ]
        whole = re.compile(rf"(?<![\w-])(?:{'|'.join(groups) or '(?!)'})(?![\w-])")
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


def _first(form: str) -> str:
    """The first letter of a form, in both cases."""
    letter = form[1] if form[:1] in "[\\" else form[:1]
    return f"[{re.escape(letter.lower())}{re.escape(letter.upper()[:1])}]"


def _spelt(name: str) -> str:
    """The pattern of a name, which may begin a sentence."""
    first, rest = re.escape(name[:1]), re.escape(name[1:])
    first = f"[{name[0]}{name[0].upper()}]" if name[:1].islower() else first
    return first + rest.replace("’", "['’]").replace(r"\ ", "[ \u00a0]")


def read_glossary(sources: Sources, words: Words = ENGLISH) -> Glossary:
    """The terms in the file; none where there is no such file. Mistakes are reported."""
    toml = sources.toml(FILE)
    if toml is None:
        return EMPTY
    reader = Reader(FILE, toml, sources.problems)
    endings = tuple(words("language.plural_endings").split())
    terms = [
        reader.table(Term, entry, (name,), name=name, line=toml.line(name), endings=endings)
        for name, entry in toml.table.items()
    ]
    terms.sort(key=lambda term: term.name.casefold())
    glossary = Glossary({term.name: term for term in terms})
    check_names(glossary, FILE, sources.problems)
    return glossary


def check_names(glossary: Glossary, path: str, problems: Diagnostics) -> None:
    """Report a name that two terms have, and related terms that there are not."""
    first: dict[str, Term] = {}
    for term in glossary.terms.values():
        for name in term.names:
            other = first.setdefault(name, term)
            if other is not term:
                message = f"{name!r} is a name of {other.name!r} too; legal: of one term"
                problems.add(path, term.line, message)
        others = [name for name in glossary.terms if name != term.name]
        for name in term.related:
            if name not in others:
                problems.add(
                    path, term.line, unknown(f"term related to {term.name!r}", name, others)
                )
