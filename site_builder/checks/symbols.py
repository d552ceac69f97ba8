"""Whether each symbol of a chapter's formulae has its one meaning there."""

from collections.abc import Iterator

from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.document.book import Book, Chapter
from site_builder.document.places import Formula
from site_builder.markdown.glossary_links.definitions import meanings_in
from site_builder.markdown.text.symbols import covers, spelt, symbols_of
from site_builder.references.symbols import BOOK, FILE


def check_symbols(book: Book, problems: Diagnostics) -> None:
    """Report symbols without a meaning and meanings of no symbol; warn of those in no formula."""
    if not book.symbols:
        return
    chapters = {chapter.id: chapter for chapter in book.chapters}
    used: set[int] = set()
    for chapter in book.chapters:
        expected = [(spelt(item.symbol.tex), item) for item in meanings_in(book, chapter)]
        for tex, formula in _first_uses(chapter):
            covering = [item for name, item in expected if covers(name, tex)]
            used |= {item.symbol.line for item in covering}
            if not covering:
                names = [name for name, _ in expected]
                message = unknown(f"symbol in {chapter.id}", tex, names)
                problems.add(chapter.path, formula.line, f"{message} (in {FILE})")
    for name, declared in book.symbols.items():
        if name != BOOK and name not in chapters:
            line = declared[0].symbol.line - 1 if declared else 1
            problems.add(FILE, line, unknown("chapter", name, [BOOK, *chapters]))
        for item in declared:
            symbol = item.symbol
            if not spelt(symbol.tex):
                problems.add(FILE, symbol.line, f"{symbol.tex!r}; legal: one symbol, such as 'k_1'")
            elif symbol.line not in used:
                problems.warn(FILE, symbol.line, f"'{symbol.tex}' is in no formula of {name}")


def _first_uses(chapter: Chapter) -> Iterator[tuple[str, Formula]]:
    seen: set[str] = set()
    for formula in chapter.formulae:
        for symbol in symbols_of(formula.tex):
            if symbol not in seen:
                seen.add(symbol)
                yield symbol, formula
