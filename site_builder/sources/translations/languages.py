"""Which languages a book can be read in, and which of its chapters."""

from pathlib import Path

from site_builder.document.book import Languages
from site_builder.document.places import chapter_id
from site_builder.languages.words import languages
from site_builder.settings.model import Settings


def find_languages(root: Path, settings: Settings) -> Languages:
    """A folder that is called as a language holds its translation."""
    names = (*settings.chapters, *settings.appendices)
    found = {
        tag: frozenset(
            chapter_id(name) for name in names if (root / f"content/{tag}/{name}.md").is_file()
        )
        for tag in languages()
        if tag != settings.language and (root / "content" / tag).is_dir()
    }
    return {settings.language: frozenset(map(chapter_id, names)), **found} if found else {}


def folder_of(language: str) -> str:
    """
    >>> folder_of("de")
    'de/'
    """
    return f"{language}/"
