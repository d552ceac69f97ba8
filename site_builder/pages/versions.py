"""A page in the languages in which it can be read, and links from a translation to pages that are
not translated."""

import re
from dataclasses import dataclass

from site_builder.document.book import Book, Chapter
from site_builder.languages.words import load_words
from site_builder.sources.translations.files import folder_of

ANOTHER_PAGE = re.compile(r'href="\.\./([^"/]+)/([^"]*)"')


@dataclass(frozen=True, slots=True)
class Version:
    """A page in one language."""

    language: str
    name: str
    """Name of the language, in itself."""
    url: str
    """Relative to the site's root."""


def versions_of(book: Book, chapter: Chapter | None) -> tuple[Version, ...]:
    """Versions of a chapter, or of the title page, the original first; none of only one."""
    found = tuple(
        _version(language, folder_of(language) if place else "", chapter)
        for place, (language, translated) in enumerate(book.languages.items())
        if chapter is None or chapter.id in translated
    )
    return found if len(found) > 1 else ()


def _version(language: str, folder: str, chapter: Chapter | None) -> Version:
    name = load_words(language)("language.name")
    return Version(language, name, folder + (f"{chapter.id}/" if chapter else ""))


def original_of(book: Book) -> Version | None:
    """The original of a translation, for links to what is not translated; None in the original."""
    return _version(next(iter(book.languages)), "", None) if book.folder else None


def original_page(book: Book, url: str) -> Version | None:
    """The original, where a translation lacks the page at ``url``; None for all other pages."""
    return None if url.startswith(book.folder) else original_of(book)


def lead_to_original(html: str, book: Book) -> str:
    """Links of a text with those to pages that are not translated as the original's."""
    original = original_of(book)
    translated = book.languages.get(book.words.language, frozenset())

    def link(found: re.Match[str]) -> str:
        page, rest = found.groups()
        if original is None or page in translated:
            return found[0]
        return f'href="../../{page}/{rest}" hreflang="{original.language}"'

    return ANOTHER_PAGE.sub(link, html)
