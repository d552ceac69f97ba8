"""The glossary's definitions and the meanings of symbols, set as the text of the chapters is."""

from collections.abc import Mapping, Sequence

from site_builder.beside.glossary import Glossary, Term
from site_builder.beside.symbols import BOOK, Symbol, Symbols
from site_builder.book import Book, Chapter
from site_builder.markdown.inline import inline_html
from site_builder.markdown.reading import Reading
from site_builder.markdown.text.symbols import spelt
from site_builder.page_model.places import Definition, Meaning


def read_definitions(glossary: Glossary, reading: Reading) -> tuple[Definition, ...]:
    """All of them; ``reading`` is of the glossary's file."""
    return tuple(_definition(term, reading) for term in glossary.terms.values())


def _definition(term: Term, reading: Reading) -> Definition:
    html = inline_html(term.says, term.line, reading)
    if reading.citations or reading.links:
        legal = "a {ref}, or a citation in the section that explains it"
        reading.problem(
            term.line, f"link or citation in the definition of {term.name!r}; legal: {legal}"
        )
        reading.citations.clear()
        reading.links.clear()
    try:
        explained = (
            reading.targets.find(term.explained, reading.chapter) if term.explained else None
        )
    except LookupError as error:
        reading.problem(term.line, str(error.args[0]))
        explained = None
    if explained and explained.kind not in ("Section", "Chapter", "Appendix"):
        legal = "a section, 'CHAPTER#ID', or a chapter"
        reading.problem(term.line, f"{term.name!r} explained by {explained.name}; legal: {legal}")
    return Definition(term, html, explained)


def read_meanings(symbols: Symbols, reading: Reading) -> Mapping[str, tuple[Meaning, ...]]:
    """All of them, by chapter; ``reading`` is of the file that declares them."""
    return {
        chapter: tuple(_meaning(symbol, reading) for symbol in declared)
        for chapter, declared in symbols.items()
    }


def _meaning(symbol: Symbol, reading: Reading) -> Meaning:
    html = inline_html(f"${symbol.tex}$", symbol.line, reading)
    means_html = inline_html(symbol.means, symbol.line, reading)
    if reading.links or reading.citations:
        message = f"link or citation in the meaning of {symbol.tex!r}; legal: a {{ref}}"
        reading.problem(symbol.line, message)
        reading.links.clear()
        reading.citations.clear()
    return Meaning(symbol, html, means_html)


def meanings_in(book: Book, chapter: Chapter) -> Sequence[Meaning]:
    """Those of a chapter: its own, then those of the book that it leaves as they are."""
    own = book.symbols.get(chapter.id, ())
    taken = {spelt(item.symbol.tex) for item in own}
    shared = book.symbols.get(BOOK, ())
    return [*own, *(item for item in shared if spelt(item.symbol.tex) not in taken)]
