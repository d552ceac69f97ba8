"""Which characters the formulae of a book use."""

from contextlib import suppress
from xml.etree import ElementTree

from site_builder.book import Book, Chapter
from site_builder.kept.keeper import kept_as
from site_builder.markdown.text.formula_breaks import displayed_parts
from site_builder.markdown.text.math import UnsupportedTexError, to_mathml


def formula_characters(book: Book) -> frozenset[str]:
    """Of all chapters, as MathML has them."""
    return frozenset[str]().union(*map(_of_chapter, book.chapters))


def _of_chapter(chapter: Chapter) -> frozenset[str]:
    formulae = tuple(sorted({(each.tex.strip(), each.displayed) for each in chapter.formulae}))

    def gather() -> frozenset[str]:
        found: set[str] = set()
        for tex, displayed in formulae:
            for part in (displayed_parts(tex) if displayed else [tex]) or [tex]:
                with suppress(UnsupportedTexError):  # which is reported where it stands
                    set_already = to_mathml(part, display=displayed)
                    found.update(*ElementTree.fromstring(set_already).itertext())
        return frozenset(found)

    return kept_as("characters", formulae, gather)[0]
