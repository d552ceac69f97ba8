"""What chapters refer to in TOML files: terms, symbols, and the news.

``content/glossary.toml`` has a table for each term. ``says`` defines it, in one paragraph of
Markdown; ``explained`` is the target of the section that explains it, as a ``{ref}`` names it.
``also`` lists other names, ``related`` other terms. ``words`` lists what counts as a use in the
text; left out, all its names do, and their plurals.

``content/symbols.toml`` has what each symbol of the formulae means, and its unit: a table for each
chapter, by its id, with lines ``'k_1' = ["meaning", "unit"]``; a pure number has no unit. The table
``book`` has what holds in every chapter that says nothing else.

``content/news.toml`` has what changed in the book, for those who follow its feed, newest first: an
``[[entry]]`` for each change, with ``date``, ``title``, ``says``, both plain text, and ``chapter``
where it is about one.
"""

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import groupby

from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.files.text import Sources, Toml
from site_builder.languages.words import ENGLISH, Words
from site_builder.settings.declared import DAY, TEXT, Reader, key, keys_of, texts

GLOSSARY = "content/glossary.toml"
NAMES = texts('["one", "another"]')


@dataclass(frozen=True, slots=True, kw_only=True)
class Term:
    name: str
    says: str = key(TEXT)
    """Its definition, as Markdown."""
    explained: str = key(TEXT)
    """The section that explains it, as its author names it."""
    also: tuple[str, ...] = key(NAMES, default=())
    related: tuple[str, ...] = key(NAMES, default=())
    words: tuple[str, ...] = key(NAMES, default=())
    line: int = 1
    lines: Mapping[str, int] = field(default_factory=dict)
    """Of its keys."""
    endings: tuple[str, ...] = ("s", "es")
    """Endings of plurals, in the language of the book."""

    @property
    def id(self) -> str:
        """Id of its entry, among the ids of the glossary."""
        return re.sub(r"[^\w]+", "-", self.name.lower()).strip("-")

    @property
    def names(self) -> tuple[str, ...]:
        return (self.name, *self.also)

    def pattern(self) -> Iterator[str]:
        """Regular expressions of what counts as a use."""
        if self.words:
            yield from map(_spelt, self.words)
        else:
            plural = f"(?:{'|'.join(self.endings)})?"
            yield from (_spelt(name) + plural * name[-1:].isalpha() for name in self.names)


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


NO_TERMS = Glossary()


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
    toml = sources.toml(GLOSSARY)
    if toml is None:
        return NO_TERMS
    reader = Reader(GLOSSARY, toml, sources.problems)
    endings = tuple(words("language.plural_endings").split())
    terms = [
        reader.table(
            Term,
            entry,
            (name,),
            name=name,
            line=toml.line(name),
            lines={item.name: toml.line(name, item.name) for item in keys_of(Term)},
            endings=endings,
        )
        for name, entry in toml.table.items()
    ]
    terms.sort(key=lambda term: term.name.casefold())
    glossary = Glossary({term.name: term for term in terms})
    _check_names(glossary, toml, sources.problems)
    return glossary


def _check_names(glossary: Glossary, toml: Toml, problems: Diagnostics) -> None:
    """Report a name that two terms have, and related terms that there are not."""
    first: dict[str, Term] = {}
    for term in glossary.terms.values():
        for name in term.names:
            other = first.setdefault(name, term)
            if other is not term:
                message = f"{name!r} is a name of {other.name!r} too; legal: of one term"
                line = toml.line_of_text(name, term.lines["also"])
                problems.add(GLOSSARY, line, message)
        others = [name for name in glossary.terms if name != term.name]
        for name in term.related:
            if name not in others:
                message = unknown(f"term related to {term.name!r}", name, others)
                line = toml.line_of_text(name, term.lines["related"])
                problems.add(GLOSSARY, line, message)


SYMBOLS = "content/symbols.toml"
BOOK = "book"
FORM = '["meaning", "unit"]'


@dataclass(frozen=True, slots=True)
class Symbol:
    """One symbol as it is declared."""

    tex: str
    means: str
    """Markdown."""
    unit: str
    """Nothing of a pure number."""
    line: int


type Symbols = Mapping[str, tuple[Symbol, ...]]
"""Symbols by the chapter for which they are declared, or `BOOK`."""


def read_symbols(sources: Sources) -> Symbols:
    """The symbols in the file; none where there is no such file. Mistakes are reported."""
    read, problems = sources.toml(SYMBOLS), sources.problems
    if read is None:
        return {}
    found: dict[str, tuple[Symbol, ...]] = {}
    for chapter, table in read.table.items():
        if not isinstance(table, dict):
            message = f"{chapter!r} outside a table; legal: '[{BOOK}]' above it"
            problems.add(SYMBOLS, read.line(chapter), message)
            continue
        rows = [_symbol(tex, row, read.line(chapter, tex)) for tex, row in table.items()]
        for row in rows:
            if not row.means:
                problems.add(SYMBOLS, row.line, f"{row.tex!r}; legal: {FORM}")
        found[chapter] = tuple(rows)
    return found


def _symbol(tex: str, row: object, line: int) -> Symbol:
    """Without a meaning where the row is malformed."""
    texts = [item for item in row if isinstance(item, str)] if isinstance(row, list) else []
    if not isinstance(row, list) or len(row) not in (1, 2) or len(texts) != len(row):
        texts = [""]
    return Symbol(tex, texts[0], texts[1] if len(texts) > 1 else "", line)


NEWS = "content/news.toml"
ENTRY = "entry"


@dataclass(frozen=True, slots=True)
class NewsItem:
    date: str = key(DAY)
    """``2026-11-22``."""
    title: str = key(TEXT)
    says: str = key(TEXT)
    chapter: str = key(TEXT, default="")
    """Id of the chapter that it is about; nothing where it is about the book."""

    @property
    def id(self) -> str:
        """Unique in the feed, and the same as long as date and title are."""
        return f"{self.date}-{re.sub(r'[^a-z0-9]+', '-', self.title.lower()).strip('-')}"


def read_news(sources: Sources, chapters: Collection[str]) -> tuple[NewsItem, ...]:
    """All entries; none where there is no such file. Mistakes are reported."""
    toml = sources.toml(NEWS)
    if toml is None:
        return ()
    reader = Reader(NEWS, toml, sources.problems)
    news = reader.tables(NewsItem, ENTRY) or ()
    _check_news(news, chapters, reader)
    return news


def _check_news(news: Sequence[NewsItem], chapters: Collection[str], reader: Reader) -> None:
    """Report unknown chapters, entries out of order, and repeated ones."""
    for index, entry in enumerate(news):
        at, earlier = (ENTRY, index), news[:index]
        if entry.chapter and entry.chapter not in chapters:
            reader.report((*at, "chapter"), unknown("chapter", entry.chapter, chapters))
        if earlier and entry.date > earlier[-1].date:
            reader.report(at, f"{entry.date} stands below an older entry; legal: above it")
        if entry.id in [other.id for other in earlier]:
            reader.report(at, f"a second {entry.title!r} of {entry.date}; legal: one")
