"""The glossary and the symbols: whether the text uses what they list, and lists what it uses."""

from collections.abc import Iterator

from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.document.book import Book, Chapter
from site_builder.document.places import Formula, Target, TermUse
from site_builder.markdown.glossary import meanings_in
from site_builder.markdown.text.symbols import covers, spelt, symbols_of
from site_builder.references.glossary import FILE as GLOSSARY
from site_builder.references.symbols import BOOK, FILE


def check_glossary(book: Book, problems: Diagnostics) -> None:
    """Report terms whose explaining section never uses them."""
    used = {(use.term, ch.id, use.section) for ch in book.chapters for use in ch.term_uses}
    for definition in book.glossary:
        term, place = definition.term, definition.explained
        if place and (term.name, place.chapter, place.id) not in used:
            sections = [
                f"{chapter}#{section}" if section else chapter
                for name, chapter, section in sorted(used)
                if name == term.name
            ]
            expected = ", ".join(sections[:6]) or "a section that does"
            message = f"{term.name!r} is not in the text of {term.explained!r}; legal: {expected}"
            problems.add(GLOSSARY, term.line, message)


def check_order(book: Book, problems: Diagnostics) -> None:
    """Warn of terms used before the section that explains them, unless the author marked the use:
    a mark shows the definition."""
    unexplained = {item.term.name: item.explained for item in book.glossary if item.explained}
    for chapter in book.chapters:
        for use in chapter.term_uses:
            place = unexplained.pop(use.term, None)
            if place and not use.by_author and not _is_in(use, chapter.id, place):
                message = f"{use.term!r} is used before {place.name}, which explains it"
                better = f"explain it here, or mark it: {{term}}`{use.term}`"
                problems.warn(chapter.path, use.line, f"{message}; better: {better}")


def _is_in(use: TermUse, chapter: str, place: Target) -> bool:
    return chapter == place.chapter and place.id in ("", use.section)


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
