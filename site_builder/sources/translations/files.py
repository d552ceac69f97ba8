"""The files of a translation beside its chapters: settings, glossary, and the labels of figures."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, replace
from difflib import get_close_matches
from pathlib import Path

from site_builder.diagnostics.diagnostic import unknown
from site_builder.document.book import Languages
from site_builder.document.places import chapter_id
from site_builder.files.text import Sources, Toml
from site_builder.languages.words import Words, languages
from site_builder.references.terms import NAMES, Glossary, check_names
from site_builder.references.terms import NO_TERMS as EMPTY
from site_builder.settings.declared import TEXT, Reader, key, keys_of
from site_builder.settings.model import Labels, Settings, storage_prefix


def find_languages(root: Path, settings: Settings) -> Languages:
    """A folder that is called as a language holds its translation."""
    names = (*settings.chapters, *settings.appendices)
    found = {
        tag: frozenset(
            chapter_id(name) for name in names if (root / f"content/{tag}/{name}.md").is_file()
        )
        for tag in languages(root)
        if tag != settings.language and (root / "content" / tag).is_dir()
    }
    return {settings.language: frozenset(map(chapter_id, names)), **found} if found else {}


def folder_of(language: str) -> str:
    return f"{language}/"


NUMBER = re.compile(r"[−-]?\d+(?:\.\d+)?")
LABELLED = re.compile(r"(?<=>)[^<>]+(?=<)")
UNFIT = re.compile(r'[<>&"\\]')
"""In a label: it becomes part of markup and of data."""
SPOKEN = re.compile(
    r'((?:aria-(?:label|description|valuetext)|alt|data-hint|"label"):?[= ]")([^"]+)(?=")'
)
"""Attributes of elements, and labels in the data of a figure."""


def read_labels(sources: Sources, language: str) -> Mapping[str, str]:
    path = file_of(language, "labels.toml")
    toml = sources.toml(path)
    labels: dict[str, str] = {}
    for text, label in toml.table.items() if toml else ():
        if NUMBER.search(text):
            expected = f"{NUMBER.sub('#', text)!r}, '#' for each number"
        elif not isinstance(label, str) or label.count("#") != text.count("#"):
            expected = f"a text with {text.count('#')} '#'"
        elif UNFIT.search(label):
            expected = 'a text without < > & " \\'
        else:
            labels[text] = label
            continue
        sources.problems.add(path, toml.line(text) if toml else 1, f"{text!r}; legal: {expected}")
    return labels


def check_labels(sources: Sources, words: Words, said: Iterable[str]) -> None:
    """Warn of a label that no figure has as it starts, where one has nearly the same."""
    path, known = file_of(words.language, "labels.toml"), {NUMBER.sub("#", s.strip()) for s in said}
    strange = [text for text in words.figures if text not in known]
    toml = sources.aside().toml(path) if strange else None
    for text in strange:
        near = get_close_matches(text, sorted(known - {*words.figures}), n=1, cutoff=0.8)
        if near and toml:
            message = f"{text!r} is in no figure as it starts; better: {near[0]!r}"
            sources.problems.warn(path, toml.line(text), message)


def figure_text(text: str, words: Words) -> str:
    """In the language of the page, where that has it."""
    label = words.figures.get(NUMBER.sub("#", text.strip()))
    if label is None:
        return text
    numbers = iter(NUMBER.findall(text))
    return re.sub("#", lambda _: words.numeral(next(numbers)), label)


def figure_markup(html: str, words: Words) -> str:
    """A figure with its texts and spoken names in the language of the page."""
    if not words.figures:
        return html
    html = LABELLED.sub(lambda found: figure_text(found[0], words), html)
    return SPOKEN.sub(lambda found: found[1] + figure_text(found[2], words), html)


@dataclass(frozen=True, slots=True)
class TranslatedTerm:
    name: str = key(TEXT)
    says: str = key(TEXT)
    """Its definition, as Markdown."""
    also: tuple[str, ...] = key(NAMES, default=())
    words: tuple[str, ...] = key(NAMES, default=())


def translated_glossary(sources: Sources, words: Words, original: Glossary) -> Glossary:
    """The terms that the file translates; the others, as no definition is translated by itself,
    are unknown to the translation."""
    path = file_of(words.language, "glossary.toml")
    toml, problems = sources.toml(path), sources.problems
    if toml is None:
        return EMPTY
    reader, terms = Reader(path, toml, problems), []
    endings = tuple(words("language.plural_endings").split())
    for name, entry in toml.table.items():
        line, term = toml.line(name), original.terms.get(name)
        if term is None:
            problems.add(path, line, unknown("term", name, original.terms))
        else:
            own = asdict(reader.table(TranslatedTerm, entry, (name,)))
            terms.append(
                replace(term, **own, related=(), line=line, endings=endings, original=name)
            )
    glossary = Glossary({term.name: term for term in terms})
    check_names(glossary, path, problems)
    return glossary


TRANSLATED = (
    "title", "subtitle", "prerequisites", "hero_caption", "made_by", "search_examples", "parts",
    "labels", "starts", "path",
)  # fmt: skip
"""Keys of the outline that a translation may have; what it leaves out is the original's."""


def file_of(language: str, name: str = "book.toml") -> str:
    return f"content/{language}/{name}"


def translated_settings(
    sources: Sources, language: str, original: Settings
) -> tuple[Settings, Toml]:
    """The original's, with the words of the translation, and their places in its file. What a
    browser stores is the same."""
    path = file_of(language)
    toml = sources.toml(path) or Toml()
    keys = (replace(item, default="") for item in keys_of(Settings) if item.name in TRANSLATED)
    own = Reader(path, toml, sources.problems).values(keys, toml.table)
    given = {"labels": Labels(), **{name: value for name, value in own.items() if value}}
    storage = storage_prefix(original)
    return replace(original, **given, language=language, storage=storage), toml
