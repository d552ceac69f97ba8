"""The symbols as their template needs them: chapter by chapter, each where it first stands."""

from dataclasses import dataclass

from site_builder.book import Book, Chapter
from site_builder.markdown.text.symbols import covers, spelt, symbols_of
from site_builder.markdown.vocabulary.definitions import meanings_in
from site_builder.page_model.places import Meaning
from site_builder.pages.places import Card, Place, card, place


@dataclass(frozen=True, slots=True)
class Row:
    """A symbol, what it means, and the section in which it is introduced."""

    meaning: Meaning
    introduced: Place


def view_symbols(book: Book) -> list[tuple[Card, list[Row]]]:
    """What each chapter's formulae say, in the order in which they say it."""
    chapters = ((chapter, _rows(book, chapter)) for chapter in book.chapters)
    return [(card(chapter), rows) for chapter, rows in chapters if rows]


def _rows(book: Book, chapter: Chapter) -> list[Row]:
    rows: dict[str, Row] = {}
    legal = [(spelt(item.symbol.tex), item) for item in meanings_in(book, chapter)]
    for formula in sorted(chapter.formulae, key=lambda formula: formula.line):
        for symbol in symbols_of(formula.tex):
            # Its own meaning before that of a symbol without the index.
            found = sorted(legal, key=lambda pair: pair[0] != symbol)
            item = next((item for name, item in found if covers(name, symbol)), None)
            if item and item.symbol.tex not in rows:
                where = place(chapter, formula.section, formula.section)
                rows[item.symbol.tex] = Row(item, where)
    return list(rows.values())
