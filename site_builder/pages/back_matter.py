"""The pages that follow the chapters: a book has those that it has something for."""

from collections.abc import Iterable
from typing import Any

from site_builder.document.book import Book
from site_builder.languages.words import Words
from site_builder.pages.views.glossary import view_glossary
from site_builder.pages.views.index import view_index
from site_builder.pages.views.references import cited_works
from site_builder.pages.views.symbols import view_symbols

BACK_MATTER = {
    "glossary": "glossary.title",
    "symbols": "symbols.title",
    "references": "references.title",
    "index-of-terms": "index.title",
    "lecture-plan": "plan.title",
}
"""By address, the keys of their titles."""


def back_matter_pages(book: Book) -> dict[str, dict[str, Any]]:
    """The contexts of the templates of the pages after the chapters, by address."""
    found: dict[str, dict[str, Any]] = {
        "glossary": {"letters": view_glossary(book)} if book.glossary else {},
        "symbols": {"chapters": view_symbols(book)} if book.symbols else {},
        "references": {"works": cited_works(book)} if book.bibliography.works else {},
        "index-of-terms": {"letters": letters} if (letters := view_index(book)) else {},
        "lecture-plan": {"plan": book.lecture_plan} if book.lecture_plan else {},
    }
    return {name: context for name, context in found.items() if context}


def titled(addresses: Iterable[str], words: Words) -> list[tuple[str, str]]:
    """Addresses and titles, for the contents."""
    return [(address, words(BACK_MATTER[address])) for address in addresses]
