"""Pages beside those of the chapters: in the languages in which a chapter can be read, and for each
figure with nothing else on it, for frames in other pages.

A figure has the page ``embed/<chapter>/<id of the figure>/``, as the same scene may stand in
several chapters with other settings.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from markdown_it.token import Token

from site_builder.document.blocks import Block, Simulation, walk
from site_builder.document.book import Book, Chapter
from site_builder.document.places import Passage
from site_builder.languages.words import Words
from site_builder.sources.translations.files import folder_of

ANOTHER_PAGE = re.compile(r'href="\.\./([^"/]+)/([^"]*)"')


@dataclass(frozen=True, slots=True)
class Version:
    language: str
    name: str
    """Name of the language, in itself."""
    direction: str
    """In which it is read, as the attribute ``dir``."""
    url: str
    """Relative to the site's root."""


def versions_of(book: Book, chapter: Chapter | None) -> tuple[Version, ...]:
    """Versions of a chapter, or of the title page, the original first; none of only one."""
    found = tuple(
        _version(book.words_of[language], folder_of(language) if place else "", chapter)
        for place, (language, translated) in enumerate(book.languages.items())
        if chapter is None or chapter.id in translated
    )
    return found if len(found) > 1 else ()


def _version(words: Words, folder: str, chapter: Chapter | None) -> Version:
    name, direction = words("language.name"), words("language.direction")
    return Version(words.language, name, direction, folder + (f"{chapter.id}/" if chapter else ""))


def original_of(book: Book) -> Version | None:
    """The original of a translation, for links to what is not translated; None in the original."""
    return _version(book.words_of[next(iter(book.languages))], "", None) if book.folder else None


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


EMBED_FOLDER = "embed/"
ROOT_OF_EMBED = "../../../"
"""The root of the site, from such a page."""


def embed_address(chapter: Chapter, figure: str) -> str:
    """Address of the page of a figure, by its element id, from the site's root."""
    return f"{EMBED_FOLDER}{chapter.url}{figure}/"


def embeds(chapter: Chapter) -> Iterator[tuple[str, Block]]:
    """Path and figure of each, the links of its words leading to the chapter and from there."""
    for block in walk(chapter.body):
        if isinstance(figure := block.content, Simulation):
            words = (
                Passage(_from_outside(part.tokens, f"{ROOT_OF_EMBED}{chapter.url}", figure.id))
                for part in (figure.caption, figure.about)
            )
            caption, about = words
            content = replace(figure, caption=caption, about=about)
            yield f"{embed_address(chapter, figure.id)}index.html", replace(block, content=content)


def _from_outside(tokens: Sequence[Token], chapter: str, figure: str) -> tuple[Token, ...]:
    def moved(token: Token) -> Token:
        attrs = dict(token.attrs)
        if token.type == "link_open":
            address = str(attrs["href"])
            if address.startswith((".", "#", "?")):
                attrs["href"] = chapter + address
            attrs["target"] = "_blank"
            attrs.pop("aria-describedby", None)  # the definition of a term, which the chapter has
            if attrs.get("data-figure", figure) != figure:
                del attrs["class"]  # it sets a figure that is not here
        children = token.children and list(_from_outside(token.children, chapter, figure))
        return replace(token, attrs=attrs, children=children)

    return tuple(map(moved, tokens))
