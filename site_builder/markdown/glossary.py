"""The glossary's definitions and the meanings of symbols, set as the text of the chapters is."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from markdown_it.token import Token

from site_builder.document.book import Book, Chapter
from site_builder.document.places import Definition, IndexMark, Meaning, Passage, TermUse
from site_builder.markdown.annotation import inline_passage
from site_builder.markdown.directive import Directive, DirectiveCall
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.roles.references import term_link
from site_builder.markdown.text.symbols import spelt
from site_builder.markdown.text.tokens import located
from site_builder.references.terms import BOOK, Symbol, Symbols, Term


def read_definitions(context: ParseContext) -> tuple[Definition, ...]:
    """All of the glossary, by the context of its file."""
    return tuple(_definition(term, context) for term in context.shared.glossary.terms.values())


def _definition(term: Term, context: ParseContext) -> Definition:
    words = _without_links(
        term.says, term.lines["says"], f"the definition of {term.name!r}", context
    )
    try:
        found = context.targets.find(term.explained, context.chapter) if term.explained else None
    except LookupError as error:
        context.problem(term.lines["explained"], str(error.args[0]))
        found = None
    if found and found.kind not in ("Section", "Chapter", "Appendix"):
        expected = "a section, 'CHAPTER#ID', or a chapter"
        message = f"{term.name!r} explained by {found.name}; legal: {expected}"
        context.problem(term.lines["explained"], message)
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
    """Meanings in a chapter: its own, then those of the book that it leaves as they are."""
    own = book.symbols.get(chapter.id, ())
    taken = {spelt(item.symbol.tex) for item in own}
    shared = book.symbols.get(BOOK, ())
    return [*own, *(item for item in shared if spelt(item.symbol.tex) not in taken)]


QUESTIONS = ("quiz", "predict")
"""Directives whose words are no uses, since they state what is wrong, too."""
HIDDEN = ("answer",)


def mark_terms(tokens: Sequence[Token], context: ParseContext) -> None:
    """Note every use of a term with its section, and mark the first of each."""
    walk = _Walk(context)
    previous = ""
    for token in tokens:
        match token.type:
            case "heading_open":
                walk.section = str(token.attrGet("id"))
            case "directive_open":
                walk.enter(token)
            case "directive_close":
                walk.open.pop()
            case "inline":
                walk.paragraph(token, running=previous == "paragraph_open")
        previous = token.type


class _Walk:
    def __init__(self, context: ParseContext) -> None:
        self.context = context
        self.section = ""
        self.open: list[tuple[str, bool]] = []
        """Directives around this place: name, and whether it is made of blocks."""
        self.marked: set[str] = set()

    def enter(self, token: Token) -> None:
        directive: Directive[Any] | None = token.meta["directive"]
        call: DirectiveCall = token.meta["call"]
        self.open.append((call.name, directive is not None and directive.body.nests))

    def paragraph(self, inline: Token, *, running: bool) -> None:
        if any(name in QUESTIONS for name, _ in self.open):
            return
        marks = running and all(nests and name not in HIDDEN for name, nests in self.open)
        inline.children = list(self._marked(inline, marks=marks))

    def _marked(self, inline: Token, *, marks: bool) -> Iterator[Token]:
        linked, previous = 0, ""
        for token, line in located([inline]):
            if token is inline:
                continue
            if token.type in ("link_open", "role_open") and token.tag == "a":
                self._note_marked(token, line)
                linked += 1
            elif token.type in ("link_close", "role_close") and token.tag == "a":
                linked -= 1
            if token.type == "text" and not linked:
                # **Focal length** may be a slider; **Pose.** opens a paragraph; **pose** is a term.
                name = token.content[:1].isupper() and token.content[-1:] not in ".:"
                control = previous == "strong_open" and name
                yield from self._text(token, line, marks=marks, control=control)
            else:
                yield token
            previous = token.type

    def _note_marked(self, token: Token, line: int) -> None:
        """A term that its author marked, or an entry of the index."""
        if term := token.meta.get("term"):
            self.marked.add(term.name)
            self._note(term, line, str(token.attrGet("id")), by_author=True)
        elif entry := token.meta.get("index"):
            mark = IndexMark(entry, self.section, str(token.attrGet("id")))
            self.context.index_marks.append(mark)

    def _text(self, token: Token, line: int, *, marks: bool, control: bool) -> Iterator[Token]:
        """The text, in pieces where a term in it is marked. The name of a control is marked only
        where it is the term that the section explains."""
        text, done = token.content, 0
        for term, start, end in self.context.shared.glossary.uses(text):
            here = f"{self.context.chapter}#{self.section}"
            if not marks or term.name in self.marked or (control and term.explained != here):
                self._note(term, line)
                continue
            self.marked.add(term.name)
            attributes = term_link(term, line, self.context)
            self._note(term, line, attributes["id"])
            yield Token("text", "", 0, content=text[done:start])
            yield Token("link_open", "a", 1, attrs={**attributes})
            yield Token("text", "", 0, content=text[start:end])
            yield Token("link_close", "a", -1)
            done = end
        yield token if not done else Token("text", "", 0, content=text[done:])

    def _note(self, term: Term, line: int, element: str = "", *, by_author: bool = False) -> None:
        call = TermUse(term.name, self.section, element, line, by_author)
        self.context.term_uses.append(call)
