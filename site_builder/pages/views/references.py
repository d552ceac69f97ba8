"""The list of references as its template needs it: each work with the places that cite it."""

from site_builder.beside.bibliography import Work
from site_builder.book import Book
from site_builder.pages.places import Card, card

type Places = list[tuple[Card, list[str]]]


def cited_works(book: Book) -> list[tuple[Work, Places]]:
    """Each work with, by chapter, the element ids of its citations."""
    return [(work, _places(key, book)) for key, work in book.bibliography.works.items()]


def _places(key: str, book: Book) -> Places:
    by_chapter = (
        (chapter, [citation.id for citation in chapter.citations if citation.key == key])
        for chapter in book.chapters
    )
    return [(card(chapter), ids) for chapter, ids in by_chapter if ids]
