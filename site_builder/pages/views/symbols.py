"""The symbols as their template needs them: by chapter, each with its first section."""

from dataclasses import dataclass

from site_builder.document.book import Book, Chapter
from site_builder.document.places import Meaning
from site_builder.markdown.glossary_links.definitions import meanings_in
from site_builder.markdown.text.symbols import covers, spelt, symbols_of
from site_builder.pages.term_lists import Atlas, Card, Place, atlas


@dataclass(frozen=True, slots=True)
class Row:
    """A symbol, what it means, and the section in which it is introduced."""

    meaning: Meaning
    introduced: Place


def view_symbols(book: Book) -> list[tuple[Card, list[Row]]]:
    """The meanings of each chapter's symbols, in the order of their first use."""
    chapters = ((atlas(chapter), introductions(book, chapter)) for chapter in book.chapters)
    return [
        (places.card, [_row(item, section, places) for item, section in rows])
        for places, rows in chapters
        if rows
    ]


def _row(meaning: Meaning, section: str, places: Atlas) -> Row:
    return Row(meaning, places.place(section, section))


def introductions(book: Book, chapter: Chapter) -> list[tuple[Meaning, str]]:
    """Each meaning, and the section in which its symbol is first used."""
    rows: dict[str, tuple[Meaning, str]] = {}
    seen: set[str] = set()
    expected = [(spelt(item.symbol.tex), item) for item in meanings_in(book, chapter)]
    for formula in sorted(chapter.formulae, key=lambda formula: formula.line):
        for symbol in symbols_of(formula.tex):
            if symbol in seen:
                continue
            seen.add(symbol)
            # Its own meaning before that of a symbol without the index.
            found = sorted(expected, key=lambda pair: pair[0] != symbol)
            item = next((item for name, item in found if covers(name, symbol)), None)
            if item:
                rows.setdefault(item.symbol.tex, (item, formula.section))
    return list(rows.values())
