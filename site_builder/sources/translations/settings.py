"""``content/LANGUAGE/book.toml``: what of the outline is words, translated."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from types import MappingProxyType

from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.files.text import Toml, read_toml
from site_builder.settings.declared import Reader, key
from site_builder.settings.kinds import TEXT, entries, table, texts
from site_builder.settings.model import Labels, Settings
from site_builder.settings.reading import storage_prefix

AS_ORIGINAL = "the original's"


@dataclass(frozen=True, slots=True)
class TranslatedSettings:
    """The whole file; empty what holds as in the original."""

    title: str = key(TEXT, "what the book is called", "", without=AS_ORIGINAL)
    subtitle: str = key(TEXT, "what it is about, in a sentence", "", without=AS_ORIGINAL)
    prerequisites: str = key(TEXT, "what its reader should know", "", without=AS_ORIGINAL)
    hero_caption: str = key(
        TEXT, "a sentence about the figure of the title page", "", without=AS_ORIGINAL
    )
    made_by: str = key(TEXT, "who made it, in a sentence", "", without=AS_ORIGINAL)
    search_examples: tuple[str, ...] = key(
        texts('["one", "another"]'), "what one may search for", (), without=AS_ORIGINAL
    )
    parts: Mapping[str, str] = key(
        entries('a table of titles with first chapters, "Geometry" = "chapter"'),
        "headings of the contents, each with the chapter that begins it",
        MappingProxyType({}),
        without=AS_ORIGINAL,
    )
    labels: Labels = key(table(Labels), "what numbered things are called", Labels())
    starts: Mapping[str, str] = key(
        entries('a table of texts with places, "Begin here" = "chapter#figure-id"'),
        "where the title page invites to start",
        MappingProxyType({}),
        without=AS_ORIGINAL,
    )


def file_of(language: str) -> str:
    """
    >>> file_of("de")
    'content/de/book.toml'
    """
    return f"content/{language}/book.toml"


def translated_settings(
    root: Path, language: str, original: Settings, problems: Diagnostics
) -> tuple[Settings, Toml]:
    """The original's, with the words of the translation, and their places in its file. What a
    browser stores is the same."""
    path = file_of(language)
    toml = (read_toml(root, path, problems) if (root / path).is_file() else None) or Toml()
    own = Reader(path, toml, problems).table(TranslatedSettings, toml.table)
    given = {name: getattr(own, name) for name in TranslatedSettings.__slots__}
    settings = replace(
        original,
        **{name: value for name, value in given.items() if value and name != "labels"},
        labels=own.labels if any(asdict(own.labels).values()) else Labels(),
        language=language,
        storage=storage_prefix(original),
    )
    return settings, toml
