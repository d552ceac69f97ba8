"""The list of references as its template needs it: each work with the places that cite it."""

from site_builder.document.book import Book
from site_builder.pages.term_lists import Card, card
from site_builder.references.bibliography import Work

type Places = list[tuple[Card, list[str]]]


def cited_works(book: Book) -> list[tuple[Work, Places]]:
    """Each work with, by chapter, the element ids of its citations."""
    places: dict[str, Places] = {key: [] for key in book.bibliography.works}
    for chapter in book.chapters:
        ids: dict[str, list[str]] = {}
        for citation in chapter.citations:
            ids.setdefault(citation.key, []).append(citation.id)
        for key, found in ids.items():
            places.setdefault(key, []).append((card(chapter), found))
    return [(work, places[key]) for key, work in book.bibliography.works.items()]
