"""The glossary's definitions and the meanings of symbols, set as the text of the chapters is."""

from collections.abc import Mapping, Sequence

from site_builder.document.book import Book, Chapter
from site_builder.document.passage import Passage
from site_builder.document.places import Definition, Meaning
from site_builder.markdown.inline import inline_passage
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.text.symbols import spelt
from site_builder.references.glossary import Term
from site_builder.references.symbols import BOOK, Symbol, Symbols


def read_definitions(context: ParseContext) -> tuple[Definition, ...]:
    """All of the glossary, by the context of its file."""
    return tuple(_definition(term, context) for term in context.shared.glossary.terms.values())


def _definition(term: Term, context: ParseContext) -> Definition:
    words = _without_links(term.says, term.line, f"the definition of {term.name!r}", context)
    try:
        found = context.targets.find(term.explained, context.chapter) if term.explained else None
    except LookupError as error:
        context.problem(term.line, str(error.args[0]))
        found = None
    if found and found.kind not in ("Section", "Chapter", "Appendix"):
        expected = "a section, 'CHAPTER#ID', or a chapter"
        message = f"{term.name!r} explained by {found.name}; legal: {expected}"
        context.problem(term.line, message)
    return Definition(term, words, found)


def read_meanings(symbols: Symbols, context: ParseContext) -> Mapping[str, tuple[Meaning, ...]]:
    """All of them, by chapter, by the context of the file that declares them."""
    return {
        chapter: tuple(_meaning(symbol, context) for symbol in declared)
        for chapter, declared in symbols.items()
    }


def _meaning(symbol: Symbol, context: ParseContext) -> Meaning:
    formula = inline_passage(f"${symbol.tex}$", symbol.line, context)
    what = f"the meaning of {symbol.tex!r}"
    return Meaning(symbol, formula, _without_links(symbol.means, symbol.line, what, context))


def _without_links(markdown: str, line: int, what: str, context: ParseContext) -> Passage:
    """Words that are shown on many pages, where a link would lead elsewhere."""
    words = inline_passage(markdown, line, context)
    if context.links or context.citations:
        context.problem(line, f"link or citation in {what}; legal: a {{ref}}")
        context.links.clear()
        context.citations.clear()
    return words


def meanings_in(book: Book, chapter: Chapter) -> Sequence[Meaning]:
    """Those of a chapter: its own, then those of the book that it leaves as they are."""
    own = book.symbols.get(chapter.id, ())
    taken = {spelt(item.symbol.tex) for item in own}
    shared = book.symbols.get(BOOK, ())
    return [*own, *(item for item in shared if spelt(item.symbol.tex) not in taken)]
