"""The glossary's definitions and the meanings of symbols, set as the text of the chapters is."""

from collections.abc import Mapping, Sequence

from site_builder.book import Book, Chapter
from site_builder.markdown.inline import inline_passage
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.text.symbols import spelt
from site_builder.page_model.places import Definition, Meaning
from site_builder.references.glossary import Glossary, Term
from site_builder.references.symbols import BOOK, Symbol, Symbols


def read_definitions(glossary: Glossary, context: ParseContext) -> tuple[Definition, ...]:
    """All of them; ``reading`` is of the glossary's file."""
    return tuple(_definition(term, context) for term in glossary.terms.values())


def _definition(term: Term, context: ParseContext) -> Definition:
    words = inline_passage(term.says, term.line, context)
    if context.citations or context.links:
        expected = "a {ref}, or a citation in the section that explains it"
        context.problem(
            term.line, f"link or citation in the definition of {term.name!r}; legal: {expected}"
        )
        context.citations.clear()
        context.links.clear()
    try:
        explained = (
            context.targets.find(term.explained, context.chapter) if term.explained else None
        )
    except LookupError as error:
        context.problem(term.line, str(error.args[0]))
        explained = None
    if explained and explained.kind not in ("Section", "Chapter", "Appendix"):
        expected = "a section, 'CHAPTER#ID', or a chapter"
        context.problem(
            term.line, f"{term.name!r} explained by {explained.name}; legal: {expected}"
        )
    return Definition(term, words, explained)


def read_meanings(symbols: Symbols, context: ParseContext) -> Mapping[str, tuple[Meaning, ...]]:
    """All of them, by chapter; ``reading`` is of the file that declares them."""
    return {
        chapter: tuple(_meaning(symbol, context) for symbol in declared)
        for chapter, declared in symbols.items()
    }


def _meaning(symbol: Symbol, context: ParseContext) -> Meaning:
    formula = inline_passage(f"${symbol.tex}$", symbol.line, context)
    means = inline_passage(symbol.means, symbol.line, context)
    if context.links or context.citations:
        message = f"link or citation in the meaning of {symbol.tex!r}; legal: a {{ref}}"
        context.problem(symbol.line, message)
        context.links.clear()
        context.citations.clear()
    return Meaning(symbol, formula, means)


def meanings_in(book: Book, chapter: Chapter) -> Sequence[Meaning]:
    """Those of a chapter: its own, then those of the book that it leaves as they are."""
    own = book.symbols.get(chapter.id, ())
    taken = {spelt(item.symbol.tex) for item in own}
    shared = book.symbols.get(BOOK, ())
    return [*own, *(item for item in shared if spelt(item.symbol.tex) not in taken)]
