"""The book in plain words, section by section, as the search sees it.

Answers, and what is hidden until a guess, are left out.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field

from site_builder.document.blocks import Block, Prose, Simulation
from site_builder.document.book import Book, Chapter
from site_builder.document.passage import Channel, Passage
from site_builder.markdown.directives import DIRECTIVES
from site_builder.render.words import pieces

PLAIN = {directive.template: directive.plain for directive in DIRECTIVES}
"""What each directive is in plain words, by its template."""
type Describe = Callable[[Simulation], str]
"""What a figure shows at first, in a sentence."""


@dataclass(frozen=True, slots=True)
class Section:
    """A heading and what stands below it, up to the next."""

    anchor: str
    """Element id of the heading; nothing for what stands before the first."""
    title: str
    terms: tuple[str, ...]
    """Words that are introduced here: set in bold or italics."""
    text: str
    figures: str
    """Titles, descriptions and captions of figures."""
    questions: str
    """Without their answers."""

    def count_words(self) -> int:
        return sum(
            len(text.split()) for text in (self.title, self.text, self.figures, self.questions)
        )


@dataclass(slots=True)
class _Draft:
    anchor: str
    title: str = ""
    terms: list[str] = field(default_factory=list)
    texts: dict[Channel, list[str]] = field(default_factory=dict)

    def add(self, channel: Channel, text: str) -> None:
        self.texts.setdefault(channel, []).append(text)

    def finished(self) -> Section:
        terms = (" ".join(term.split()).rstrip(".,:;?") for term in self.terms)
        return Section(
            self.anchor,
            " ".join(self.title.split()),
            tuple(dict.fromkeys(terms)),
            *(self._text(channel) for channel in ("text", "figure", "question")),
        )

    def _text(self, channel: Channel) -> str:
        return " ".join("".join(self.texts.get(channel, ())).split())


def sections_of(blocks: Iterable[Block], describe: Describe) -> tuple[Section, ...]:
    """What stands before the first heading, and each section; empty ones are left out."""
    reader = _Reader(describe)
    reader.read(blocks)
    return tuple(reader.finished())


def chapter_sections(chapter: Chapter, describe: Describe) -> tuple[Section, ...]:
    """With the chapter's title and summary at the head of the first."""
    reader = _Reader(describe)
    reader.drafts[0].title = chapter.title
    reader.drafts[0].add("text", f"{chapter.summary} ")
    reader.read(chapter.body)
    return tuple(reader.finished())


def glossary_sections(book: Book, summary: str) -> Iterator[Section]:
    """One for each term."""
    yield Section("", book.words("glossary.title"), (), summary, "", "")
    for definition in book.glossary:
        reader, term = _Reader(lambda _figure: ""), definition.term
        reader.drafts[0] = _Draft(term.id, term.name)
        reader.add_words(definition.words, "text")
        if term.also:
            reader.drafts[0].add("text", f" {book.words('glossary.also')} {', '.join(term.also)}.")
            reader.drafts[0].terms += term.also
        yield from reader.finished()


@dataclass(slots=True)
class _Reader:
    describe: Describe
    drafts: list[_Draft] = field(default_factory=lambda: [_Draft("")])

    def read(self, blocks: Iterable[Block]) -> None:
        for block in blocks:
            if isinstance(block.content, Prose):
                self.add_words(block.content.words, "text")
            elif plain := PLAIN[block.template]:
                content = plain(block.content)
                if block.target and content.channel != "question":
                    self.drafts[-1].add(content.channel, f"{block.target.name} ")
                if isinstance(block.content, Simulation):
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
                    self.drafts.append(_Draft(piece.heading))
                self.drafts[-1].title += piece.text
            elif piece.term:
                if channel == "text":
                    self.drafts[-1].terms.append(piece.term)
            else:
                self.drafts[-1].add(channel, piece.text)
        self.drafts[-1].add(channel, " ")

    def finished(self) -> Iterator[Section]:
        for draft in self.drafts:
            section = draft.finished()
            if section.title or section.text:
                yield section
