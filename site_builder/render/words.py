"""Passages as plain words, for the search and for lengths as they are read; and the book in plain
words, section by section, as the search sees it.

Answers, and what is hidden until a guess, are left out of sections.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from xml.etree import ElementTree

from markdown_it.token import Token

from site_builder.cache.results import cached
from site_builder.document.blocks import Block, Deeper, Prose, Simulation
from site_builder.document.book import Book, Chapter
from site_builder.document.places import Channel, Passage
from site_builder.markdown.directives import DIRECTIVES

LONGEST_FORMULA = 14
"""Characters of a formula that the search shows; a longer one becomes an ellipsis."""
LEFT_OUT = ("fence", "code_block", "math_block", "math_block_label", "html_block", "html_inline")


@dataclass(frozen=True, slots=True)
class Piece:
    text: str
    term: str = ""
    """What they end: words that are emphasised, which is how terms are introduced."""
    heading: str | None = None
    """Element id of the heading that they belong to; None for other words."""


def plain_words(passage: Passage) -> str:
    """All of it but code and displayed formulae."""
    return " ".join("".join(piece.text for piece in pieces(passage, 10**6)).split())


def pieces(passage: Passage, longest_formula: int = LONGEST_FORMULA) -> Iterator[Piece]:
    """Its words in order. A space ends each paragraph, list item and cell."""
    heading: str | None = None
    for token in passage.tokens:
        if token.type == "heading_open":
            heading = str(token.attrGet("id"))
        elif token.type == "heading_close":
            heading = None
        elif token.type == "inline":
            yield from _inline_pieces(token.children or (), heading, longest_formula)
        elif token.nesting <= 0 and token.type not in LEFT_OUT:
            yield Piece(" ")


def _inline_pieces(
    children: Sequence[Token], heading: str | None, longest_formula: int
) -> Iterator[Piece]:
    emphasised: list[str] = []
    depth = 0
    for child in children:
        if child.type in ("strong_open", "em_open"):
            depth += 1
        elif child.type in ("strong_close", "em_close"):
            depth -= 1
            if not depth:
                yield Piece("", term="".join(emphasised))
                emphasised.clear()
        elif text := _text(child, longest_formula):
            if depth:
                emphasised.append(text)
            yield Piece(text, heading=heading)


def _text(token: Token, longest_formula: int) -> str:
    if token.type in ("softbreak", "hardbreak"):
        return " "
    if token.type in LEFT_OUT:
        return ""
    if token.type == "math_inline":
        formula = _formula(str(token.meta.get("mathml", "")))
        shown = formula if len(formula) <= longest_formula else "…"
        return str(token.meta.get("before", "")) + shown + str(token.meta.get("after", ""))
    if token.children:
        return "".join(_text(child, longest_formula) for child in token.children)
    return token.content


def _formula(mathml: str) -> str:
    """The letters of a formula, without spaces."""
    return "".join("".join(ElementTree.fromstring(f"<m>{mathml}</m>").itertext()).split())


PLAIN = {directive.template: directive.plain for directive in DIRECTIVES}
"""Functions that give the plain text of a directive, by its template."""
type Describe = Callable[[Simulation], str]
"""What a figure shows at first, in a sentence."""


@dataclass(slots=True)
class SectionText:
    """A heading and what stands below it, up to the next."""

    anchor: str
    """Element id of the heading; nothing for what stands before the first."""
    title: str = ""
    terms: list[str] = field(default_factory=list)
    """Words that are introduced here: set in bold or italics."""
    texts: dict[Channel, list[str]] = field(default_factory=dict)
    """By channel: text; titles, descriptions and captions of figures; questions without answers."""

    def add(self, channel: Channel, text: str) -> None:
        self.texts.setdefault(channel, []).append(text)

    def text(self, channel: Channel) -> str:
        return " ".join("".join(self.texts.get(channel, ())).split())


def sections_of(
    blocks: Iterable[Block], describe: Describe, first: SectionText | None = None
) -> tuple[SectionText, ...]:
    """What stands before the first heading, and each section; empty ones are left out."""
    reader = _SectionReader(describe, [first or SectionText("")])
    reader.read(blocks)
    return reader.finished()


def chapter_sections(chapter: Chapter, describe: Describe) -> tuple[SectionText, ...]:
    """With the chapter's title and summary at the head of the first."""
    return _chapter_sections(chapter, _descriptions(chapter, describe))


def _descriptions(chapter: Chapter, describe: Describe) -> dict[str, str]:
    return {figure.id: describe(figure) for figure in chapter.simulations}


@cached
def _chapter_sections(chapter: Chapter, descriptions: Mapping[str, str]) -> tuple[SectionText, ...]:
    describe: Describe = lambda figure: descriptions[figure.id]  # noqa: E731
    first = SectionText("", chapter.title, texts={"text": [f"{chapter.summary} "]})
    return sections_of(chapter.body, describe, first)


def glossary_sections(book: Book, summary: str) -> Iterator[SectionText]:
    """One for each term."""
    yield SectionText("", book.words("glossary.title"), texts={"text": [summary]})
    for definition in book.glossary:
        term = definition.term
        entry = SectionText(term.id, term.name)
        reader = _SectionReader(lambda _figure: "", [entry])
        reader.add_words(definition.words, "text")
        if term.also:
            entry.add("text", f" {book.words('glossary.also')} {', '.join(term.also)}.")
            entry.terms += term.also
        yield from reader.finished()


@dataclass(slots=True)
class _SectionReader:
    describe: Describe
    drafts: list[SectionText]

    def read(self, blocks: Iterable[Block]) -> None:
        for block in blocks:
            if isinstance(block.content, Prose):
                self.add_words(block.content.words, "text")
            elif isinstance(block.content, Deeper):
                heading = block.content.heading
                self.drafts.append(SectionText(heading.id, plain_words(heading.words)))
                self.read(block.inside)
            elif plain := PLAIN[block.template]:
                content = plain(block.content)
                if block.target and content.channel != "question":
                    self.drafts[-1].add(content.channel, f"{block.target.name} ")
                if isinstance(block.content, Simulation) and not block.content.leader:
                    self.drafts[-1].add("figure", f"{self.describe(block.content)} ")
                for words in content.words:
                    self.add_words(words, content.channel)
                self.read(block.inside)

    def add_words(self, words: str | Passage, channel: Channel) -> None:
        if isinstance(words, str):
            if words:
                self.drafts[-1].add(channel, f"{words.rstrip('.')}. ")
            return
        for piece in pieces(words):
            if piece.heading is not None:
                if piece.heading != self.drafts[-1].anchor:
                    self.drafts.append(SectionText(piece.heading))
                self.drafts[-1].title += piece.text
            elif piece.term:
                if channel == "text":
                    self.drafts[-1].terms.append(piece.term)
            else:
                self.drafts[-1].add(channel, piece.text)
        self.drafts[-1].add(channel, " ")

    def finished(self) -> tuple[SectionText, ...]:
        for draft in self.drafts:
            draft.title = " ".join(draft.title.split())
            terms = (" ".join(term.split()).rstrip(".,:;?") for term in draft.terms)
            draft.terms = [*dict.fromkeys(terms)]
        return tuple(draft for draft in self.drafts if draft.title or draft.text("text"))
