"""What a page is to the world outside: its address, its card, the file that it is made from."""

from site_builder.document.book import OUTLINE, Book, Chapter
from site_builder.references.bibliography import FILE as BIBLIOGRAPHY
from site_builder.references.glossary import FILE as GLOSSARY
from site_builder.references.symbols import FILE as SYMBOLS
from site_builder.settings.addresses import PATH
from site_builder.sources.lecture_plan import FILE as LECTURE_PLAN

BOOK_CARD = "card.png"
CARDS = "cards"
MODULES = "source/"
MADE_FROM = {
    "index.html": OUTLINE,
    "licences/index.html": "LICENSE",
    "references/index.html": BIBLIOGRAPHY,
    "lecture-plan/index.html": LECTURE_PLAN,
    "glossary/index.html": GLOSSARY,
    "symbols/index.html": SYMBOLS,
    "index-of-terms/index.html": GLOSSARY,
}
"""Pages other than those of chapters and modules, and their source files."""


def page_address(path: str) -> str:
    """Of a file of the site, from the site's root: ``lens-distortion/``."""
    return path.removesuffix("index.html")


def card_path(chapter: Chapter | None) -> str:
    """Where the card of a chapter is, from the site's root; the book's for what is no chapter."""
    return f"{CARDS}/{chapter.id}.png" if chapter else BOOK_CARD


def origin(book: Book, path: str, chapter: Chapter | None) -> str:
    """Where the source of a page can be read; nothing where that is not known."""
    if chapter:
        file = chapter.path
    elif path.startswith(MODULES):
        file = f"{path.removeprefix(MODULES).removesuffix('/index.html')}.py"
    else:
        file = MADE_FROM.get(path, "")
    return book.source.replace(PATH, file) if file else ""
