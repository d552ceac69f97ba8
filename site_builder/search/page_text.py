"""What a finished page says, section by section, as the search sees it.

A page is read as its reader sees it at first: what waits for a guess or an answer is left out, and
so is what can only be pressed.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from html.parser import HTMLParser

from site_builder.kept.keeper import kept
from site_builder.search.tags import ARTICLE, INLINE, NEVER_CLOSED, Channel, channel_of, title_in

WORDS_A_MINUTE = 180
"""Of a text with formulae, read with care."""
MAIN = re.compile(r"<main\b.*?</main>", re.DOTALL)
UNREAD = re.compile(
    r"""(<(?:pre|script)\b[^>]*>|<math\b[^>]*\bdisplay="block"[^>]*>).*?(?=</(?:pre|script|math)>)""",
    re.DOTALL,
)
"""What is long, silent and never inside its like: left out before a page is taken apart."""
FORMULA = re.compile(r"(?<=<math)([^>]*>)(.*?)(?=</math>)", re.DOTALL)
"""Of its many elements nothing is asked but their text, which is all that is then left."""
TAG = re.compile(r"<[^>]*>")
FOLDED = re.compile(r"<details(?![^>]*\bopen\b).*?</details>", re.DOTALL)
LONGEST_FORMULA = 14
"""Characters of a formula in a line of text; a longer one becomes an ellipsis."""


@dataclass(frozen=True, slots=True)
class Section:
    """A heading and what stands below it, up to the next."""

    anchor: str
    """Element id of the heading; nothing for what stands before the first."""
    title: str
    terms: tuple[str, ...]
    """Words that are introduced here: set in bold, or defined."""
    text: str
    figures: str
    """Titles, descriptions and captions of figures."""
    questions: str
    """What is asked, never what is right."""


@dataclass(slots=True)
class _Draft:
    anchor: str = ""
    parts: dict[Channel, list[str]] = field(default_factory=dict)

    def add(self, channel: Channel, text: str) -> None:
        self.parts.setdefault(channel, []).append(text)

    def finished(self) -> Section:
        return Section(
            anchor=self.anchor,
            title=self._text("title"),
            terms=tuple(dict.fromkeys(self._terms())),
            text=self._text("text"),
            figures=self._text("figure"),
            questions=self._text("question"),
        )

    def _terms(self) -> Iterator[str]:
        return (" ".join(term.split()).rstrip(".,:;?") for term in self.parts.get("term", ()))

    def _text(self, channel: Channel) -> str:
        return " ".join("".join(self.parts.get(channel, ())).split())


@kept
def read_sections(html: str) -> tuple[Section, ...]:
    """The sections of the page's article, in order; those that say nothing are left out."""
    reader = _Reader()
    main = MAIN.search(html)  # the contents around it are as long as the book
    shown = UNREAD.sub(r"\1", main[0] if main else html)
    reader.feed(FORMULA.sub(lambda found: found[1] + TAG.sub("", found[2]), shown))
    reader.close()
    return tuple(section for section in reader.sections() if section.title or section.text)


@kept
def reading_minutes(body: str) -> int:
    """How long an article's body takes to read: its text, captions and questions. What is folded
    is opened, and figures are played with, by those who like."""
    shown = FOLDED.sub("", body)
    sections = read_sections(f"<article {ARTICLE}>{shown}</article>")
    words = sum(len(f"{s.title} {s.text} {s.figures} {s.questions}".split()) for s in sections)
    return max(1, round(words / WORDS_A_MINUTE))


@dataclass(slots=True)
class _Element:
    tag: str
    channel: Channel
    started: int
    """Where its text starts in what was read before."""


class _Reader(HTMLParser):
    """Walks the page; each element hands its channel on to those inside."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self._drafts = [_Draft()]
        self._open: list[_Element] = []
        self._words: list[str] = []
        """All that was read, whatever its channel: bold words and formulae are taken from here."""

    def sections(self) -> Iterator[Section]:
        return (draft.finished() for draft in self._drafts)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        attributes = {name: value or "" for name, value in attrs}
        outer: Channel = self._open[-1].channel if self._open else "outside"
        channel = channel_of(tag, attributes, outer)
        if channel == "title" and outer != "title" and tag != "h1":
            self._drafts.append(_Draft(attributes.get("id", "")))
        if title := title_in(tag, attributes, outer):
            self._drafts[-1].add("figure", f"{title.rstrip('.')}. ")
        if tag not in NEVER_CLOSED:
            self._open.append(_Element(tag, channel, len(self._words)))

    def handle_endtag(self, tag: str) -> None:
        if not any(element.tag == tag for element in self._open):
            return
        while self._open:
            element = self._open.pop()
            self._finish(element)
            if element.tag == tag:
                return

    def handle_data(self, data: str) -> None:
        channel: Channel = self._open[-1].channel if self._open else "outside"
        if channel in ("outside", "hidden"):
            return
        self._words.append(data)
        if not any(element.tag == "math" for element in self._open):
            self._drafts[-1].add("text" if channel == "term" else channel, data)

    def _finish(self, element: _Element) -> None:
        said = "".join(self._words[element.started :])
        outer: Channel = self._open[-1].channel if self._open else "outside"
        if element.channel == "term" and outer != "term":
            self._drafts[-1].add("term", said)
        elif element.tag == "math" and element.channel != "hidden":
            formula = "".join(said.split())
            shown = formula if len(formula) <= LONGEST_FORMULA else "…"
            self._drafts[-1].add("text" if element.channel == "term" else element.channel, shown)
        elif element.tag not in INLINE and element.channel in ("text", "figure", "question"):
            self._drafts[-1].add(element.channel, " ")
