"""``content/LANGUAGE/glossary.toml``: terms translated, each in a table named as the original's."""

from dataclasses import dataclass, replace
from pathlib import Path

from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.files.text import read_toml
from site_builder.languages.words import Words
from site_builder.references.glossary import EMPTY, NAMES, Glossary, Term, check_names
from site_builder.settings.declared import Reader, key
from site_builder.settings.kinds import TEXT


@dataclass(frozen=True, slots=True)
class TranslatedTerm:
    """One entry."""

    name: str = key(TEXT)
    says: str = key(TEXT)
    """Its definition, as Markdown."""
    also: tuple[str, ...] = key(NAMES, default=())
    words: tuple[str, ...] = key(NAMES, default=())


def glossary_of(language: str) -> str:
    """
    >>> glossary_of("de")
    'content/de/glossary.toml'
    """
    return f"content/{language}/glossary.toml"


def translated_glossary(
    root: Path, words: Words, original: Glossary, problems: Diagnostics
) -> Glossary:
    """The terms that the file translates; the others, as no definition is translated by itself,
    are unknown to the translation."""
    path = glossary_of(words.language)
    toml = read_toml(root, path, problems) if (root / path).is_file() else None
    if toml is None:
        return EMPTY
    reader, terms = Reader(path, toml, problems), []
    for name, entry in toml.table.items():
        line, term = toml.line(name), original.terms.get(name)
        if term is None:
            problems.add(path, line, unknown("term", name, original.terms))
        else:
            own = reader.table(TranslatedTerm, entry, (name,))
            terms.append(_translated(term, own, line, words))
    glossary = Glossary({term.name: term for term in terms})
    check_names(glossary, path, problems)
    return glossary


def _translated(term: Term, own: TranslatedTerm, line: int, words: Words) -> Term:
    return replace(
        term,
        name=own.name,
        says=own.says,
        also=own.also,
        words=own.words,
        related=(),
        line=line,
        endings=tuple(words("language.plural_endings").split()),
        original=term.name,
    )
