"""Which characters the formulae of a book use."""

from contextlib import suppress
from xml.etree import ElementTree

from site_builder.book import Book, Chapter
from site_builder.kept.keeper import kept_as
from site_builder.markdown.text.math import UnsupportedTexError, to_mathml


def formula_characters(book: Book) -> frozenset[str]:
    """Of all chapters, as MathML has them."""
    return frozenset[str]().union(*map(_of_chapter, book.chapters))


def _of_chapter(chapter: Chapter) -> frozenset[str]:
    formulae = tuple(sorted({formula.tex for formula in chapter.formulae}))

    def gather() -> frozenset[str]:
        found: set[str] = set()
        for tex in formulae:
            with suppress(UnsupportedTexError):  # which is reported where it stands
                found.update(*ElementTree.fromstring(to_mathml(tex, display=False)).itertext())
        return frozenset(found)

    return kept_as("characters", formulae, gather)[0]
