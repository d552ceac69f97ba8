"""What a finished page says, section by section, as the search sees it.

A page is read as its reader sees it at first: what waits for a guess or an answer is left out, and
so is what can only be pressed.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from html import unescape
from typing import NamedTuple

from site_builder.kept.keeper import kept
from site_builder.search.tags import ARTICLE, INLINE, NEVER_CLOSED, Channel, channel_of, title_in

WORDS_A_MINUTE = 180
"""Of a text with formulae, read with care."""
UNREAD = re.compile(
    r"""(<(?:pre|script|nav)\b[^>]*>|<math\b[^>]*\bdisplay="block"[^>]*>).*?(?=</(?:pre|script|nav|math)>)""",
    re.DOTALL,
)
"""What is long, silent and never inside its like: left out before a page is taken apart."""
FORMULA = re.compile(r"<math([^>]*>)(.*?)(?=</math>)", re.DOTALL)
"""Of its many elements nothing is asked but their text, which is all that is then left."""
TAG = re.compile(r"<[^>]*>")
FOLDED = re.compile(r"<details(?![^>]*\bopen\b).*?</details>", re.DOTALL)
PART = re.compile(
    r"""([^<]+|<(?![/!a-zA-Z]))|<!--.*?-->|"""
    r"""<(/?)([a-zA-Z][^\s/>]*)((?:[^>"']++|"[^"]*"|'[^']*')*)>""",
    re.DOTALL,
)
"""Text, a comment, or the beginning or end of an element: `html.parser`, which reads what nobody
should write as well, takes four times as long for the pages that we write."""
ATTRIBUTE = re.compile(r"""([^\s"'=/>]+)(?:\s*=\s*(?:"([^"]*)"|'([^']*)'|([^\s"'>]+)))?""")
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

    @property
    def is_silent(self) -> bool:
        said = (*self.parts.get("title", ()), *self.parts.get("text", ()))
        return not any(part.strip() for part in said)

    def count_words(self) -> int:
        """Of title, text, figures and questions."""
        channels: tuple[Channel, ...] = ("title", "text", "figure", "question")
        return sum(len("".join(self.parts.get(channel, ())).split()) for channel in channels)

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
    """The sections of a page's article, in order; those that say nothing are left out."""
    return _sections(html)


def _sections(html: str) -> tuple[Section, ...]:
    return tuple(draft.finished() for draft in _drafts(html))


def _drafts(html: str) -> Iterator[_Draft]:
    """Those that say something."""
    reader = _Reader()
    shown = UNREAD.sub(r"\1", html)
    reader.read(FORMULA.sub(lambda found: f"<math{found[1]}{TAG.sub('', found[2])}", shown))
    return (draft for draft in reader.drafts if not draft.is_silent)


def reading_minutes(body: str) -> int:
    """How long an article's body takes to read: its text, captions and questions. What is folded
    is opened, and figures are played with, by those who like. It is not kept: to look for it takes
    as long."""
    shown = FOLDED.sub("", body)
    drafts = _drafts(f"<article {ARTICLE}>{shown}</article>")
    return max(1, round(sum(draft.count_words() for draft in drafts) / WORDS_A_MINUTE))


@dataclass(slots=True)
class _Reader:
    """Walks the page; each element hands its channel on to those inside."""

    drafts: list[_Draft] = field(default_factory=lambda: [_Draft()])
    _open: list["_Opened"] = field(default_factory=list)
    _started: list[int] = field(default_factory=list)
    """Where the text of each of these starts in what was read before."""
    _words: list[str] = field(default_factory=list)
    """All that was read, whatever its channel: bold words and formulae are taken from here."""
    _formulae: int = 0
    """Of those that are open."""

    def read(self, html: str) -> None:
        for text, closes, tag, attributes in PART.findall(html):
            if text:
                self._say(unescape(text) if "&" in text else text)
            elif tag and closes:
                self._close(tag.lower())
            elif tag:
                self._begin(tag.lower(), attributes)
                if attributes.endswith("/"):
                    self._close(tag.lower())

    def _begin(self, tag: str, attributes: str) -> None:
        opened = _opened(tag, attributes, self._open[-1].channel if self._open else "outside")
        if opened.section is not None:
            self.drafts.append(_Draft(opened.section))
        if opened.said:
            self.drafts[-1].add("figure", opened.said)
        if tag not in NEVER_CLOSED:
            self._open.append(opened)
            self._started.append(len(self._words))
            self._formulae += tag == "math"

    def _close(self, tag: str) -> None:
        if not any(element.tag == tag for element in reversed(self._open)):
            return
        while self._open:
            element, started = self._open.pop(), self._started.pop()
            self._formulae -= element.tag == "math"
            self._finish(element, started)
            if element.tag == tag:
                return

    def _say(self, text: str) -> None:
        channel: Channel = self._open[-1].channel if self._open else "outside"
        if channel in ("outside", "hidden"):
            return
        self._words.append(text)
        if not self._formulae:
            self.drafts[-1].add("text" if channel == "term" else channel, text)

    def _finish(self, element: "_Opened", started: int) -> None:
        outer: Channel = self._open[-1].channel if self._open else "outside"
        if element.channel == "term" and outer != "term":
            self.drafts[-1].add("term", "".join(self._words[started:]))
        elif element.tag == "math" and element.channel != "hidden":
            formula = "".join("".join(self._words[started:]).split())
            shown = formula if len(formula) <= LONGEST_FORMULA else "…"
            self.drafts[-1].add("text" if element.channel == "term" else element.channel, shown)
        elif element.tag not in INLINE and element.channel in ("text", "figure", "question"):
            self.drafts[-1].add(element.channel, " ")


class _Opened(NamedTuple):
    """An element, and what its beginning does."""

    tag: str
    channel: Channel
    section: str | None
    """Id of the section that it begins."""
    said: str
    """What its attributes say of a figure."""


@lru_cache(maxsize=4096)
def _opened(tag: str, written: str, outer: Channel) -> _Opened:
    attributes = {
        name.lower(): unescape(quoted or single or bare)
        for name, quoted, single, bare in ATTRIBUTE.findall(written)
    }
    channel = channel_of(tag, attributes, outer)
    begins = channel == "title" and outer != "title" and tag != "h1"
    title = title_in(tag, attributes, outer)
    said = f"{title.rstrip('.')}. " if title else ""
    return _Opened(tag, channel, attributes.get("id", "") if begins else None, said)
